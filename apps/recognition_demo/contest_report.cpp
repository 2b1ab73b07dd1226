#include "recognition_demo/contest_report.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "support/command_line.hpp"

namespace sigmax::apps {
namespace {

/// Some of 1 … reports to show: 1, 2, 5, 10, 20, … and the last.
std::vector<std::size_t> shown_reports(std::size_t reports) {
  std::vector<std::size_t> shown;
  for (std::size_t decade = 1; decade < reports; decade *= 10)
    for (const std::size_t digit : {1U, 2U, 5U})
      if (digit * decade < reports) shown.push_back(digit * decade);
  shown.push_back(reports);
  return shown;
}

/// A cell of the column for one kind of contestants.
Cell only_if(bool holds, double value) { return holds ? Cell(value) : Cell(); }

}  // namespace

void add_draws(CLI::App& app, DrawOptions& options) {
  Subcommand(app).option("--runs", options.runs, "Simulated runs").in(2, 100000000).shows_default();
  add_seed(app, options.seed);
  add_threads(app, options.threads);
  add_output(app, options.output);
}

ResultTable scores_table(const std::vector<Score>& scores, const std::string& what_is_counted) {
  const auto shown = shown_reports(scores.front().accuracy.size());
  std::vector<ResultColumn> columns = {
      {.key = "classifier", .header = fmt::format("right, % after {}:", what_is_counted), .align = Align::left}};
  for (const std::size_t k : shown) columns.push_back({.header = fmt::format("{}", k), .digits = 1, .scale = 100.0});
  const std::vector<ResultColumn> others = {
      {.key = "accuracy"},
      {.key = "accuracy_minus_that_of_the_first",
       .header = "last, more than row 1",
       .unit = "points",
       .scale = 100.0,
       .sign = true,
       .interval = true},
      {.key = "ties", .header = "ties", .unit = "%", .digits = 1, .scale = 100.0},
      {.key = "mean_probability_of_truth"},
      {.key = "mean_possibility_of_truth"},
      {.header = "p or π of truth", .digits = 3},
      {.key = "mean_necessity_of_truth", .header = "necessity of truth", .digits = 3},
      {.key = "reports_passed_over"}};
  columns.insert(columns.end(), others.begin(), others.end());
  ResultTable table(std::move(columns));
  for (const Score& score : scores) {
    std::vector<Cell> cells = {score.name};
    for (const std::size_t k : shown) cells.emplace_back(score.accuracy[k - 1]);
    const bool first = &score == &scores.front();
    const std::vector<Cell> rest = {score.accuracy.back(),
                                    first ? Cell() : Cell(score.minus_first.interval()),
                                    score.ties,
                                    only_if(!score.fuzzy, score.belief_in_truth),
                                    only_if(score.fuzzy, score.belief_in_truth),
                                    score.belief_in_truth,
                                    only_if(score.fuzzy, score.necessity_of_truth),
                                    score.refused > 0 ? Cell(score.refused) : Cell()};
    cells.insert(cells.end(), rest.begin(), rest.end());
    table.row(std::move(cells));
  }
  return table;
}

Result result_of_contest(std::string title, const OutputOptions& output, const std::vector<Contestant>& contestants) {
  constexpr std::size_t widest_words = 120;  // longer lines are hard to read
  Result result(output);
  result.words_width = output.wide ? widest_words : terminal_width;
  result.page.title = std::move(title);
  for (const Contestant& contestant : contestants) result.page.groups.push_back({.name = contestant.name});
  return result;
}

void add_scores(Result& result, const std::vector<Score>& scores, const std::string& what_is_counted) {
  result.add(scores_table(scores, what_is_counted),
             {.summary = {"classifiers"}, .title = "Right decisions", .note = "Differences ± 95 % by paired runs."});
  result.say(
      "(Ties share the credit. Differences ± 95 % by paired runs. Means over the runs. Necessity: 1 − the possibility "
      "of the best other.)");
  for (const Score& score : scores)
    if (score.refused > 0)
      result.say(fmt::format("{}: {} reports excluded every pattern that was left and were passed over", score.name,
                             score.refused));
  ResultTable curves({{.key = "report"}, {.key = "classifier"}, {.key = "accuracy"}});
  for (const Score& score : scores)
    for (std::size_t k = 0; k < score.accuracy.size(); ++k) curves.row({k + 1, score.name, score.accuracy[k]});
  result.add(curves, {.printed = false, .csv = "curves.csv"});
}

}  // namespace sigmax::apps
