#include "recognition_demo/contest_report.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "support/csv.hpp"
#include "support/table.hpp"
#include "version.hpp"

namespace sigmax::apps {

std::vector<std::size_t> shown_reports(std::size_t reports) {
  std::vector<std::size_t> shown;
  for (std::size_t decade = 1; decade < reports; decade *= 10)
    for (const std::size_t digit : {1U, 2U, 5U})
      if (digit * decade < reports) shown.push_back(digit * decade);
  shown.push_back(reports);
  return shown;
}

void print_scores(const std::vector<Score>& scores, const std::string& what_is_counted) {
  const auto shown = shown_reports(scores.front().accuracy.size());
  std::vector<TextTable::Column> columns = {{fmt::format("right, % after {}:", what_is_counted), Align::left}};
  for (const std::size_t k : shown) columns.push_back({fmt::format("{}", k)});
  columns.push_back({"last − the first row's, points"});
  columns.push_back({"ties, %"});
  columns.push_back({"p or π of truth"});
  columns.push_back({"N of truth"});
  TextTable table(columns);
  bool refused = false;
  for (const Score& score : scores) {
    std::vector<std::string> cells = {score.name};
    for (const std::size_t k : shown) cells.push_back(percent(score.accuracy[k - 1]));
    const bool first = &score == &scores.front();
    cells.push_back(first || score.final_credits.size() < 2 ? "" : points(paired_difference(score, scores.front())));
    cells.push_back(percent(score.ties));
    cells.push_back(fmt::format("{:.3f}", score.belief_in_truth));
    cells.push_back(score.fuzzy ? fmt::format("{:.3f}", score.necessity_of_truth) : "");
    table.row(cells);
    refused = refused || score.refused > 0;
  }
  table.print();
  fmt::print("(Ties share the credit. Differences ± 95 % by paired runs. Means over the runs.)\n");
  if (!refused) return;
  for (const Score& score : scores)
    if (score.refused > 0)
      fmt::print("{}: {} reports excluded every pattern that was left and were passed over\n", score.name,
                 score.refused);
}

AtomicFile curves_file(const std::vector<Score>& scores, const OutputDirectory& directory) {
  AtomicFile file = directory.file("curves.csv");
  file.write("report,classifier,accuracy\n");
  for (const Score& score : scores)
    for (std::size_t k = 0; k < score.accuracy.size(); ++k)
      file.print("{},{},{}\n", k + 1, csv_field(score.name), shortest(score.accuracy[k]));
  return file;
}

Json as_json(const Interval& interval) {
  return {{"mean", interval.mean}, {"lower", interval.lower()}, {"upper", interval.upper()}};
}

Json as_json(const std::vector<Score>& scores) {
  Json all;
  for (const Score& score : scores) {
    Json one = {{"accuracy", score.accuracy.back()}, {"ties", score.ties}};
    one[score.fuzzy ? "mean_possibility_of_truth" : "mean_probability_of_truth"] = score.belief_in_truth;
    if (score.fuzzy) one["mean_necessity_of_truth"] = score.necessity_of_truth;
    if (score.refused > 0) one["reports_passed_over"] = score.refused;
    if (&score != &scores.front() && score.final_credits.size() > 1)
      one["accuracy_minus_that_of_the_first"] = as_json(paired_difference(score, scores.front()));
    all[score.name] = one;
  }
  return all;
}

Json summary_of(const std::string& command) { return {{"version", version}, {"command", command}}; }

AtomicFile summary_file(const Json& summary, const OutputDirectory& directory) {
  AtomicFile file = directory.file("summary.json");
  file.write(summary.dump(2) + "\n");
  return file;
}

void print_written(const std::vector<std::string>& files, const std::string& directory) {
  std::string list = files.front();
  for (std::size_t i = 1; i < files.size(); ++i) list += (i + 1 == files.size() ? " and " : ", ") + files[i];
  fmt::print("\nWrote {} to {}\n", list, directory);
}

}  // namespace sigmax::apps
