#include "recognition_demo/world.hpp"

#include <sigmax/recognition/decision.hpp>

#include "study/study.hpp"

namespace sigmax::apps {
namespace {

/// A run as the row of a cell: the truth; of each contestant its credits, its belief and what it refused. Before
/// each list stands how long it is.
Study::Row row_of(const Drawn& drawn, const std::vector<Contestant>& contestants) {
  Study::Row row = {static_cast<double>(drawn.truth)};
  const auto add = [&](const std::vector<double>& numbers) {
    row.push_back(static_cast<double>(numbers.size()));
    row.insert(row.end(), numbers.begin(), numbers.end());
  };
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const Trace trace = follow(contestants[i], drawn.truth, drawn.reports);
    add(trace.credit);
    add(trace.belief);
    row.push_back(static_cast<double>(trace.refused));
  }
  return row;
}

SeenRun run_of(const Study::Row& row, std::size_t condition, std::size_t run, std::size_t contestants) {
  auto at = row.begin();
  const auto number = [&] { return static_cast<std::size_t>(*at++); };
  const auto numbers = [&] {
    const auto first = at + 1;
    at = first + static_cast<std::ptrdiff_t>(*at);
    return std::vector<double>(first, at);
  };
  SeenRun seen{condition, run, number(), {}};
  for (std::size_t i = 0; i < contestants; ++i) seen.traces.push_back({numbers(), numbers(), number()});
  return seen;
}

/// Adds up runs in their order; their number is all that it keeps of them.
class Scoreboard {
 public:
  explicit Scoreboard(const std::vector<Contestant>& contestants) {
    for (const Contestant& contestant : contestants) {
      same_.emplace_back(sums_.size(), true);
      sums_.push_back({contestant.name, contestant.fuzzy(), contestant.has_possibilities});
    }
  }

  void add(const SeenRun& run) {
    const auto last = [&](std::size_t i) { return run.traces[i].credit.back(); };
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const Trace& trace = run.traces[i];
      Score& sum = sums_[i];
      sum.accuracy.resize(trace.credit.size(), 0.0);
      for (std::size_t k = 0; k < trace.credit.size(); ++k) sum.accuracy[k] += trace.credit[k];
      sum.minus_first.add(last(i) - last(0));
      sum.belief_in_truth += trace.belief[run.truth];
      sum.necessity_of_truth += 1.0 - greatest_other(trace.belief, run.truth);
      const double greatest = std::log(*std::ranges::max_element(trace.belief));
      if (std::ranges::count_if(trace.belief, [&](double one) { return ties(std::log(one), greatest); }) > 1)
        sum.ties += 1.0;
      sum.refused += trace.refused;
      for (std::size_t j = 0; j < i; ++j)
        if (last(j) != last(i)) same_[i][j] = false;
    }
    ++runs_;
  }

  Scores scores() const {
    Scores scores = sums_;
    const auto n = static_cast<double>(runs_);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      Score& score = scores[i];
      for (double& value : score.accuracy) value /= n;
      for (double* value : {&score.belief_in_truth, &score.necessity_of_truth, &score.ties}) *value /= n;
      score.same_as = static_cast<std::size_t>(std::ranges::find(same_[i], true) - same_[i].begin());
    }
    return scores;
  }

 private:
  Scores sums_;
  std::vector<std::vector<bool>> same_;  // by contestant, then by one before it
  std::size_t runs_ = 0;
};

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

std::size_t draw_index(RandomStream& random, std::size_t size) {
  return std::min(size - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(size)));
}

std::size_t draw(RandomStream& random, std::span<const double> probabilities) {
  const double u = random.uniform();
  double sum = 0.0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    if (probabilities[i] <= 0.0) continue;
    last = i;
    sum += probabilities[i];
    if (u < sum) break;
  }
  return last;
}

void add_draws(Subcommand app, DrawOptions& options, const std::string& command, std::size_t runs) {
  options.runs = runs;
  app.option("--runs", options.runs, "Simulated runs").in(2, 100000000);
  add_seed(app, options.seed);
  add_threads(app, options.threads);
  add_results(app, options.output, command);
}

void run_world(const World& world, const DrawOptions& options, ResultFiles& files) {
  auto boards = each(world.conditions, [](const Condition& one) { return Scoreboard(one.contestants); });
  const Study study{"runs", options.runs * world.conditions.size(), [&](std::size_t cell) {
                      const Condition& condition = world.conditions[cell / options.runs];
                      const Drawn drawn = condition.draw(cell % options.runs);
                      return row_of(drawn, drawn.contestants.empty() ? condition.contestants : drawn.contestants);
                    }};
  std::vector<View> views;
  const auto add = [&](std::size_t cell, const Study::Row& row) {
    const std::size_t condition = cell / options.runs;
    const SeenRun seen = run_of(row, condition, cell % options.runs, world.conditions[condition].contestants.size());
    boards[condition].add(seen);
    if (world.see) world.see(seen);
    if (seen.run < world.runs_in_page && files.report_wanted()) views.push_back(world.view(seen));
  };
  if (!run(study, {.threads = options.threads}, options.output, add)) return;
  Result result = result_of_contest(world.title, options.output, world.conditions.front().contestants);
  if (world.view) {
    result.page.chooser = "Show";
    result.page.views.push_back({fmt::format("all {} runs", options.runs), {}});
  }
  world.tell(each(boards, &Scoreboard::scores), result);
  std::ranges::move(views, std::back_inserter(result.page.views));
  result.publish(files);
}

ResultTable scores_table(const Scores& scores, const std::string& what_is_counted) {
  ResultTable table;
  for (const Score& score : scores) {
    const bool first = &score == &scores.front();
    std::vector<Field> row = {{of_words("classifier", fmt::format("right, % after {}:", what_is_counted)), score.name}};
    for (const std::size_t k : shown_reports(score.accuracy.size()))
      row.push_back({{.header = fmt::format("{}", k), .digits = 1, .scale = 100.0}, score.accuracy[k - 1]});
    row.insert(row.end(), {{{.key = "accuracy"}, score.accuracy.back()},
                           {of_points("accuracy_minus_that_of_the_first", "last, more than row 1"),
                            first ? Cell() : Cell(score.minus_first.interval())},
                           {{.key = "ties", .header = "ties", .unit = "%", .digits = 1, .scale = 100.0}, score.ties},
                           {{.key = "mean_probability_of_truth"}, only_if(!score.fuzzy, score.belief_in_truth)},
                           {{.key = "mean_possibility_of_truth"}, only_if(score.fuzzy, score.belief_in_truth)},
                           {{.header = "p or π of truth", .digits = 3}, score.belief_in_truth},
                           {{.key = "mean_necessity_of_truth", .header = "necessity of truth", .digits = 3},
                            only_if(score.fuzzy, score.necessity_of_truth)},
                           {{.key = "reports_passed_over"}, score.refused > 0 ? Cell(score.refused) : Cell()}});
    table.row_of(row);
  }
  return table;
}

void add_scores(Result& result, const Scores& scores, const std::string& what_is_counted) {
  result.add(scores_table(scores, what_is_counted),
             {.summary = {"classifiers"}, .title = "Right decisions", .note = "Differences ± 95 % by paired runs."});
  result.say(
      "(Ties share the credit. Differences ± 95 % by paired runs. Means over the runs. Necessity: 1 − the possibility "
      "of the best other.)");
  for (const Score& score : scores)
    if (score.refused > 0)
      result.say("{}: {} reports excluded every pattern that was left and were passed over", score.name, score.refused);
  auto curves = ResultTable::of_keys({"report", "classifier", "accuracy"});
  for (const Score& score : scores)
    for (std::size_t k = 0; k < score.accuracy.size(); ++k) curves.row({k + 1, score.name, score.accuracy[k]});
  result.add(curves, {.printed = false, .csv = "curves.csv"});
}

LineChart accuracy_chart(const Scores& scores, const std::string& what_is_counted) {
  LineChart chart{.title = "Right decisions",
                  .x_label = what_is_counted,
                  .y_label = "share of the runs that are right; ties share the credit",
                  .x = counted_from(1, scores.front().accuracy.size())};
  for (const Score& score : scores) chart.curves.push_back({score.name, score.name, score.accuracy});
  return chart;
}

std::vector<std::string> with_beliefs(std::vector<std::string> keys, const std::vector<Contestant>& contestants,
                                      const std::vector<std::string>& patterns) {
  for (const Contestant& contestant : contestants)
    for (const std::string& pattern : patterns) keys.push_back(contestant.name + ": " + pattern);
  return keys;
}

std::vector<Cell> with_beliefs(std::vector<Cell> cells, const SeenRun& run) {
  for (const Trace& trace : run.traces) cells.insert(cells.end(), trace.belief.begin(), trace.belief.end());
  return cells;
}

}  // namespace sigmax::apps
