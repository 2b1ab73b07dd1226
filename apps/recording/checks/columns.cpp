// Checks of single columns: how azimuths run, columns that are one, numbers that stand for none.

#include "recording/checks/records.hpp"
#include "support/text.hpp"

namespace sigmax::apps::checks {

void check_azimuths(const Records& records, Findings& findings) {
  const RecordingReader& recording = records.recording;
  if (recording.says_azimuth_from() || !(recording.polar() || recording.bearings())) return;
  findings.push_back(
      {"", 1,
       "azimuths are read counter-clockwise from x (east), as nobody said from where they count; compass "
       "azimuths: --azimuth-from north, clockwise from ahead (x): --azimuth-from ahead"});
}

void check_columns(const Records& records, Findings& findings) {
  constexpr std::size_t few = 10;
  const auto& columns = records.columns;
  for (std::size_t a = 0; a < columns.size(); ++a)
    for (std::size_t b = a + 1; b < columns.size(); ++b) {
      std::size_t both = 0, equal = 0, line = 0;
      std::set<double> different;
      for (const auto& [name, track] : records.tracks)
        for (std::size_t row = 0; row < track.rows.size(); ++row) {
          const double one = records.cell(track, row, a), other = records.cell(track, row, b);
          if (std::isnan(one + other)) continue;
          ++both;
          if (one != other) continue;
          if (equal++ == 0) line = track.rows[row].line;
          if (different.size() < few) different.insert(one);
        }
      if (different.size() < few || 20 * equal < 19 * both) continue;
      const std::string words = fmt::format("equal columns: {} and {} have the same number in {} of {} rows",
                                            records.header(a), records.header(b), equal, both);
      if (quantities[columns[b]].role == Role::truth)
        throw InputError("{}:{}: {}: what was measured is no truth; rename the columns of the truth",
                         records.recording.file(), line, words);
      findings.push_back({"", line, words + "; see which one was written twice, and map the right one with --columns"});
    }
}

void check_sentinels(const Records& records, Findings& findings) {
  constexpr std::size_t again = 3, few = 20;
  for (std::size_t n = 0; n < records.columns.size(); ++n) {
    const Quantity& quantity = quantities[records.columns[n]];
    if (quantity.role == Role::truth || quantity.stems[0] == "azimuth" || quantity.stems[0] == "track") continue;
    // A number at one end of the column, or 0, or the most frequent one, that rows jump to and from.
    std::map<double, std::size_t> counts;
    for (const auto& [name, track] : records.tracks)
      for (std::size_t row = 0; row < track.rows.size(); ++row)
        if (const double number = records.cell(track, row, n); !std::isnan(number)) ++counts[number];
    if (counts.size() < few) continue;
    const double most = std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; })->first;
    for (const double number : std::set{0.0, counts.begin()->first, counts.rbegin()->first, most}) {
      const auto found = counts.find(number);
      if (found == counts.end() || found->second < again) continue;
      std::vector<double> steps, jumps;
      std::size_t line = 0;
      for (const auto& [name, track] : records.tracks) {
        double last = nan;
        for (std::size_t row = 0; row < track.rows.size(); ++row) {
          const double now = records.cell(track, row, n);
          if (std::isnan(now)) continue;
          if (now == number && line == 0) line = track.rows[row].line;
          if (now != last && !std::isnan(last))
            (now == number || last == number ? jumps : steps).push_back(std::abs(now - last));
          last = now;
        }
      }
      if (jumps.size() < again || steps.size() < few || quantile_of(jumps, 0.4) < 10.0 * quantile_of(steps, 0.9))
        continue;
      findings.push_back(
          {"", line,
           fmt::format("a sentinel, or one number held: {} is {} in {} rows, far from those beside; if it stands "
                       "for no number, give --missing={}",
                       records.header(n), shortest(number), found->second, shortest(number))});
    }
  }
}

}  // namespace sigmax::apps::checks
