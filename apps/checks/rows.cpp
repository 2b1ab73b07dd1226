// Checks of columns (two that are one, numbers that stand for none) and of rows beside each other (several targets,
// held and interpolated rows, the unit of times).

#include "checks/checks.hpp"

namespace sigmax::apps::checks {
namespace {

double apart(const Record* one, const Record* other) { return (one->at - other->at).norm(); }

/// A row's own velocity, along the ground.
double speed_of(const Record* row) { return std::hypot(row->velocity[0], row->velocity[1]); }

}  // namespace

void check_columns(const Records& records, Findings& findings) {
  constexpr std::size_t few = 10;
  const RecordingReader& recording = records.recording;
  const std::size_t n = records.columns.size(), line = records.tracks.begin()->second.rows.front().line;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      const std::string &one = recording.header_of(records.columns[a]),
                        &other = recording.header_of(records.columns[b]);
      std::size_t both = 0, equal = 0;
      std::set<double> different;
      for (const auto& [name, track] : records.tracks)
        for (std::size_t row = 0; row < track.written.size(); row += n) {
          const double x = track.written[row + a], y = track.written[row + b];
          both += std::isnan(x + y) ? 0U : 1U;
          if (x != y) continue;
          ++equal;
          if (different.size() < few) different.insert(x);
        }
      if (different.size() < few || 20 * equal < 19 * both) continue;
      const std::string words =
          fmt::format("equal columns, {} and {}: one number in {} of {} rows", one, other, equal, both);
      if (quantities[records.columns[b]].role == Role::truth)
        throw InputError("{}:{}: {}: what was measured is no truth; rename the columns of the truth", recording.file(),
                         line, words);
      findings.push_back({"", line, words + "; map the right column to each name with --columns"});
    }
}

void check_sentinels(const Records& records, Findings& findings) {
  constexpr std::size_t again = 3, few = 20;
  for (std::size_t n = 0; n < records.columns.size(); ++n) {
    const std::size_t q = records.columns[n];
    const Quantity& quantity = quantities[q];
    if (quantity.role == Role::truth || quantity.stems[0] == "azimuth" || quantity.stems[0] == "track") continue;
    // A number at one end of the column, or 0, or the most frequent one, that rows jump to and from.
    std::vector<std::pair<double, std::size_t>> column;  // and lines
    std::map<double, std::size_t> counts;
    for (const auto& [name, track] : records.tracks)
      for (std::size_t row = 0; row < track.rows.size(); ++row)
        if (const double cell = track.written[row * records.columns.size() + n]; !std::isnan(cell)) {
          column.emplace_back(cell, track.rows[row].line);
          ++counts[cell];
        }
    if (counts.size() < few) continue;
    const double most = std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; })->first;
    for (const double number : std::set{0.0, counts.begin()->first, counts.rbegin()->first, most}) {
      std::vector<double> steps, jumps;
      for (std::size_t k = 1; k < column.size(); ++k)
        if (const double last = column[k - 1].first, now = column[k].first; last != now)
          (now == number || last == number ? jumps : steps).push_back(std::abs(now - last));
      if (counts[number] < again || jumps.size() < again || steps.size() < few ||
          quantile_of(jumps, 0.4) < 10.0 * quantile_of(steps, 0.9))
        continue;
      const std::size_t line = std::ranges::find(column, number, [](const auto& cell) { return cell.first; })->second;
      const std::string &header = records.recording.header_of(q), found = shortest(number);
      // A row without a latitude, or of a radar without a range, is refused.
      const bool is_place = quantity.role == Role::place && q < place_of(Role::place) + 2;
      const std::string remedy =
          is_place || quantity.role == Role::polar
              ? fmt::format("drop these rows: awk -F'[,;\\t]' '${} != {}' {} > rest.csv",
                            records.recording.csv().column(header) + 1, found, typed(records.recording.file()))
              : "if it stands for no number, give --missing=" + found;
      const std::string what = is_place ? fmt::format("a sentinel, or held at one place: {} is", header)
                                        : fmt::format("a sentinel, or one number held, in {}:", header);
      findings.push_back(
          {"", line, fmt::format("{} {} in {} rows, far from those beside; {}", what, found, counts[number], remedy)});
    }
  }
}

void check_targets(const Records& records, Findings& findings) {
  constexpr std::size_t before = 12, few = 20;
  constexpr double near = 0.05, fast_mps = 30.0;
  for_each_path(records, [&](const std::string& name, const std::vector<const Record*>& rows) {
    std::size_t returns = 0, line = 0;
    for (std::size_t k = 2; k < rows.size(); ++k) {
      const double jump = apart(rows[k], rows[k - 1]);
      if (!(jump > fast_mps * std::max(rows[k]->time - rows[k - 1]->time, 0.1))) continue;
      double nearest = infinity;
      for (std::size_t ago = 2; ago <= std::min(before, k); ++ago)
        nearest = std::min(nearest, apart(rows[k], rows[k - ago]));
      if (nearest < near * jump && returns++ == 0) line = rows[k]->line;
    }
    if (rows.size() < few || 7 * returns < rows.size()) return;
    findings.push_back({name, line,
                        fmt::format("several targets or false detections are mixed: {} of {} rows go back to where "
                                    "another one was; track does not associate them: {}",
                                    returns, rows.size(),
                                    records.recording.has_tracks() ? "give each target an identifier of its own"
                                                                   : fmt::format("himm_demo associate {} does",
                                                                                 in_shell(records.recording.file())))});
  });
}

void check_held(const Records& records, Findings& findings) {
  constexpr std::size_t few = 5;
  for_each_path(records, [&](const std::string& name, const std::vector<const Record*>& rows) {
    std::vector<double> ways, speeds;
    std::set<long> different;  // ways, as logarithms: few where numbers are rounded
    for (std::size_t k = 1; k < rows.size(); ++k) {
      speeds.push_back(speed_of(rows[k]));
      const double way = apart(rows[k], rows[k - 1]);
      if (way == 0.0) continue;
      ways.push_back(way);
      different.insert(std::lround(1e4 * std::log(way)));
    }
    const double usual = median_of(ways), moving = std::max(1.0, 0.3 * quantile_of(speeds, 0.9));
    const bool is_rounded = 2 * different.size() <= ways.size();
    std::size_t held = 0, frozen = 0, line = 0;
    for (std::size_t k = 1, end = 1; k < rows.size(); k = end + 1) {
      for (end = k; end < rows.size() && rows[end]->at.head<2>() == rows[k - 1]->at.head<2>();) ++end;
      if (end == k) continue;
      const Record *const first = rows[k - 1], *const last = rows[end - 1];
      // Its own velocity says that it moves, or it stops at once for good, or comes from afar and goes on by a jump.
      const double reported = std::min(speed_of(first), speed_of(last));
      const double came = k > 1 ? apart(first, rows[k - 2]) : 0.0;
      const bool moves = reported > moving && reported * (last->time - first->time) > 5.0 * usual;
      const bool stops = end == rows.size() && end - k >= few && came > 0.5 * usual;
      const double jump = end < rows.size() ? apart(rows[end], last) : 0.0;
      const bool leaps = jump > 0.5 * usual && came > 0.0 && (came > 0.5 * usual || jump > 1.7 * came);
      if (!moves && (is_rounded || !(stops || leaps))) continue;
      held += end - k;
      if ((moves || stops) && end - k >= 2 * few && frozen == 0) frozen = rows[k]->line;
      if (line == 0) line = rows[k]->line;
    }
    if (20 * held < rows.size() || (frozen == 0 && (held < 2 * few || 10 * held < rows.size()))) return;
    findings.push_back({name, frozen > 0 ? frozen : line,
                        fmt::format("held (frozen, repeated) positions: {} rows repeat the one before although the "
                                    "target moves, and count as new measurements: drop them, or empty their cells",
                                    held)});
  });
}

void check_interpolated(const Records& records, Findings& findings) {
  constexpr std::size_t few = 20;
  for_each_path(records, [&](const std::string& name, const std::vector<const Record*>& rows) {
    std::vector<double> offs, ways;
    for (std::size_t k = 2; k < rows.size(); ++k) {
      const Record &a = *rows[k - 2], &b = *rows[k - 1], &c = *rows[k];
      if (!(c.time > a.time) || c.at == b.at || b.at == a.at) continue;
      offs.push_back((b.at - a.at - (b.time - a.time) / (c.time - a.time) * (c.at - a.at)).norm());
      ways.push_back((c.at - a.at).norm());
    }
    const double usual = quantile_of(offs, 0.95);
    std::size_t straight = 0;
    std::set<long> others;  // as logarithms, few where all is rounded
    for (std::size_t k = 0; k < offs.size(); ++k)
      if (offs[k] < std::min(0.02 * usual, 5e-4 * ways[k]))
        ++straight;
      else
        others.insert(std::lround(1000.0 * std::log(offs[k])));
    if (2 * straight < offs.size() || others.size() < few) return;
    findings.push_back({name, rows.front()->line,
                        fmt::format("interpolated positions: {} of {} rows are on the line between the rows beside "
                                    "them, and are no new measurements: leave the measured rows alone",
                                    straight, offs.size())});
  });
}

void check_times(const Records& records, Findings& findings) {
  if (!records.recording.times_are_seconds()) return;
  for_each_path(records, [&](const std::string& name, const std::vector<const Record*>& rows) {
    double way = 0.0;
    std::vector<double> steps;
    for (std::size_t k = 1; k < rows.size(); ++k) {
      way += apart(rows[k], rows[k - 1]);
      steps.push_back(rows[k]->time - rows[k - 1]->time);
    }
    if (rows.size() < 10 || !(apart(rows.front(), rows.back()) > 0.5 * way)) return;
    const double speed = way / (rows.back()->time - rows.front()->time), step = median_of(steps);
    const bool is_slow = speed < 0.05 && std::fmod(step, 60.0) != 0.0;  // whole minutes are no ms
    const std::string_view unit = is_slow && step > 1e5                    ? "time_us"
                                  : is_slow && step > 1e2 && step <= 2.5e3 ? "time_ms"
                                  : speed < 1500.0 || step > 0.2           ? ""
                                  : step > 5e-3                            ? "time_min"
                                                                           : "time_days";
    if (unit.empty()) return;
    findings.push_back(
        {name, rows.front()->line,
         fmt::format("the unit of times: steps of {:.3g} s at a speed of {:.2g} m/s look like {}; give --columns {}={}",
                     step, speed, unit, unit, typed(records.recording.time_header()))});
  });
}

}  // namespace sigmax::apps::checks
