// Checks of single columns: columns that are one, numbers that stand for none.

#include "recording/checks/records.hpp"
#include "support/text.hpp"

namespace sigmax::apps::checks {
namespace {

/// The numbers of a column and the lines that they are on, track by track.
std::vector<std::pair<double, std::size_t>> column_of(const Records& records, std::size_t n) {
  std::vector<std::pair<double, std::size_t>> column;
  for (const auto& [name, track] : records.tracks)
    for (std::size_t row = 0; row < track.rows.size(); ++row)
      column.emplace_back(track.written[row * records.columns.size() + n], track.rows[row].line);
  return column;
}

}  // namespace

void check_columns(const Records& records, Findings& findings) {
  constexpr std::size_t few = 10;
  const RecordingReader& recording = records.recording;
  for (std::size_t a = 0; a < records.columns.size(); ++a)
    for (std::size_t b = a + 1; b < records.columns.size(); ++b) {
      const auto one = column_of(records, a), other = column_of(records, b);
      std::size_t both = 0, equal = 0;
      std::set<double> different;
      for (std::size_t k = 0; k < one.size(); ++k) {
        both += std::isnan(one[k].first + other[k].first) ? 0U : 1U;
        if (one[k].first != other[k].first) continue;
        ++equal;
        if (different.size() < few) different.insert(one[k].first);
      }
      if (different.size() < few || 20 * equal < 19 * both) continue;
      const std::string words =
          fmt::format("equal columns: {} and {} have the same number in {} of {} rows",
                      recording.header_of(records.columns[a]), recording.header_of(records.columns[b]), equal, both);
      const std::size_t line = one.front().second;
      if (quantities[records.columns[b]].role == Role::truth)
        throw InputError("{}:{}: {}: what was measured is no truth; rename the columns of the truth", recording.file(),
                         line, words);
      findings.push_back({"", line, words + "; see which one was written twice, and map the right one with --columns"});
    }
}

void check_sentinels(const Records& records, Findings& findings) {
  constexpr std::size_t again = 3, few = 20;
  for (std::size_t n = 0; n < records.columns.size(); ++n) {
    const Quantity& quantity = quantities[records.columns[n]];
    if (quantity.role == Role::truth || quantity.stems[0] == "azimuth" || quantity.stems[0] == "track") continue;
    // A number at one end of the column, or 0, or the most frequent one, that rows jump to and from.
    auto column = column_of(records, n);
    std::erase_if(column, [](const auto& cell) { return std::isnan(cell.first); });
    std::map<double, std::size_t> counts;
    for (const auto& cell : column) ++counts[cell.first];
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
      findings.push_back({"", line,
                          fmt::format("a sentinel, or one number held: {} is {} in {} rows, far from those beside; if "
                                      "it stands for no number, give --missing={}",
                                      records.recording.header_of(records.columns[n]), shortest(number), counts[number],
                                      shortest(number))});
    }
  }
}

}  // namespace sigmax::apps::checks
