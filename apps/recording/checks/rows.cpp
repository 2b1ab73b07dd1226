// Checks of rows beside each other: several targets, held and interpolated rows, the unit of times.

#include "recording/checks/records.hpp"
#include "support/text.hpp"

namespace sigmax::apps::checks {
namespace {

double apart(const Record* one, const Record* other) { return (one->at - other->at).norm(); }

/// A row's own velocity, along the ground.
double speed_of(const Record* row) { return std::hypot(row->velocity[0], row->velocity[1]); }

}  // namespace

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
                                                                   : "tell them apart with --track-id COLUMN")});
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
      different.insert(std::lround(1000.0 * std::log(way)));
    }
    const double usual = median_of(ways), moving = std::max(1.0, 0.3 * quantile_of(speeds, 0.9));
    std::size_t held = 0, frozen = 0, line = 0, runs = 0, by_jumps = 0;
    std::set<long> jumps;
    for (std::size_t k = 1, end = 1; k < rows.size(); k = end + 1) {
      for (end = k; end < rows.size() && rows[end]->at.head<2>() == rows[k - 1]->at.head<2>();) ++end;
      if (end == k) continue;
      const Record *const first = rows[k - 1], *const last = rows[end - 1];
      // Its own velocity says that it moves, or it stops at once for good, or comes from afar and goes on by a jump.
      const double told = std::min(speed_of(first), speed_of(last));
      const double came = k > 1 ? apart(first, rows[k - 2]) : 0.0;
      const bool moves = told > moving && told * (last->time - first->time) > 5.0 * usual;
      const bool stops =
          end == rows.size() && end - k >= few && came > 0.5 * usual && 2 * different.size() > ways.size();
      const double jump = end < rows.size() ? apart(rows[end], last) : 0.0;
      if (moves || stops) {
        held += end - k;
        if (end - k >= 2 * few && frozen == 0) frozen = rows[k]->line;
      } else if (jump > 0.5 * usual && came > 0.0 && (came > 0.5 * usual || jump > 1.7 * came)) {
        ++runs;
        by_jumps += end - k;
        jumps.insert(std::lround(1000.0 * std::log(jump)));
      } else {
        continue;
      }
      if (line == 0) line = rows[k]->line;
    }
    if (jumps.size() > few && 2 * jumps.size() > runs) held += by_jumps;
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
    for (std::size_t k = 1; k < rows.size(); ++k) way += apart(rows[k], rows[k - 1]);
    if (rows.size() < 10 || apart(rows.front(), rows.back()) < 0.5 * way) return;
    const double T = rows.back()->time - rows.front()->time, step = T / static_cast<double>(rows.size() - 1);
    const std::string_view unit = way < 0.05 * T                   ? (step > 1e5     ? "time_us"
                                                                      : step > 2.5e3 ? ""
                                                                      : step > 1e2   ? "time_ms"
                                                                                     : "")
                                  : way < 1500.0 * T || step > 0.2 ? ""
                                  : step > 5e-3                    ? "time_min"
                                                                   : "time_days";
    if (unit.empty()) return;
    findings.push_back({name, rows.front()->line,
                        fmt::format("the unit of times: steps of {:.3g} s at a speed of {:.2g} m/s look like {}; give "
                                    "--columns {}={}",
                                    step, way / T, unit, unit, typed(records.recording.time_header()))});
  });
}

}  // namespace sigmax::apps::checks
