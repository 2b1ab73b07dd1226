#include "recognition_demo/world.hpp"

#include <sigmax/recognition/decision.hpp>

#include "study/study.hpp"

namespace sigmax::apps {
namespace {

/// What a contestant made of one run.
struct Trace {
  /// After each report: 1 if the truth alone is the most likely pattern, 1/n if it is one of n, else 0.
  std::vector<double> credit;
  /// Probability or possibility of every pattern after the last report.
  std::vector<double> belief;
  /// Reports that would have excluded every pattern; the classifier passed over them.
  std::size_t refused = 0;
};

/// The contestant's classifier, from its prior on, over the reports of a run.
Trace follow(const NamedClassifier& contestant, const Drawn& drawn) {
  Trace trace;
  const auto see = [&](const auto& belief) {
    trace.credit.push_back(credit(belief, drawn.truth));
    if (trace.credit.size() == drawn.reports.size()) trace.belief = degrees_of(belief);
  };
  const auto observe = [&](const auto& classifier) {
    Belief belief{classifier.prior()};
    for (const Readings& report : drawn.reports) {
      try {
        classifier.observe(belief, InOrder{report});
      } catch (const std::domain_error&) {
        ++trace.refused;
      }
      if constexpr (std::is_same_v<decltype(belief), Belief<Random>>)
        if (const auto& patterns = contestant.pattern_given_state) {
          see(Belief<Random>{compose(*patterns, belief.distribution())});
          continue;
        }
      see(belief);
    }
  };
  std::visit(observe, contestant.classifier);
  return trace;
}

/// A run as the row of a cell: the truth, the number of reports; of each contestant what it refused, its credits and
/// its belief.
Study::Row row_of(const Drawn& drawn, const std::vector<NamedClassifier>& contestants) {
  Study::Row row = {static_cast<double>(drawn.truth), static_cast<double>(drawn.reports.size())};
  for (const NamedClassifier& contestant : contestants) {
    const Trace trace = follow(contestant, drawn);
    row.push_back(static_cast<double>(trace.refused));
    row.insert(row.end(), trace.credit.begin(), trace.credit.end());
    row.insert(row.end(), trace.belief.begin(), trace.belief.end());
  }
  return row;
}

/// Adds a run from such a row.
void add(Scores& scores, const Study::Row& row) {
  const auto truth = static_cast<std::size_t>(row[0]), reports = static_cast<std::size_t>(row[1]);
  const std::size_t size = (row.size() - 2) / scores.size();
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const auto own = std::span(row).subspan(2 + i * size, size), credit = own.subspan(1, reports);
    const auto belief = own.subspan(1 + reports);
    Score& score = scores[i];
    score.right.resize(reports);
    for (std::size_t k = 0; k < reports; ++k) score.right[k].add(credit[k]);
    score.minus_first.add(credit.back() - row[2 + reports]);
    score.belief_in_truth.add(belief[truth]);
    score.necessity_of_truth.add(1.0 - greatest_other(belief, truth));
    const double greatest = std::log(*std::ranges::max_element(belief));
    const auto is_best = [&](double one) { return ties(std::log(one), greatest); };
    score.ties.add(std::ranges::count_if(belief, is_best) > 1 ? 1.0 : 0.0);
    score.refused += static_cast<std::size_t>(own[0]);
  }
}

/// Some of 1 … reports to show: 1, 2, 5, 10, 20, … and the last.
std::vector<std::size_t> shown_reports(std::size_t reports) {
  std::vector<std::size_t> shown;
  for (std::size_t decade = 1; decade < reports; decade *= 10)
    for (const std::size_t digit : {1U, 2U, 5U})
      if (digit * decade < reports) shown.push_back(digit * decade);
  shown.push_back(reports);
  return shown;
}

}  // namespace

void run_world(const World& world, const DrawOptions& options, ResultFiles& files) {
  auto scores = each(world.conditions, [](const Condition& condition) {
    return each(condition.contestants, [](const NamedClassifier& one) {
      return Score{one.name, std::holds_alternative<Classifier<Fuzzy, Fuzzy>>(one.classifier), one.has_possibilities};
    });
  });
  const Study study{"runs", options.runs * world.conditions.size(), [&](std::size_t cell) {
                      const Condition& condition = world.conditions[cell / options.runs];
                      const Drawn drawn = condition.draw(cell % options.runs);
                      return row_of(drawn, drawn.contestants.empty() ? condition.contestants : drawn.contestants);
                    }};
  const auto add_row = [&](std::size_t cell, const Study::Row& row) { add(scores[cell / options.runs], row); };
  if (!run(study, {.threads = options.threads}, options.output, add_row)) return;
  Result result = comparison_result(world.title, options.output, each(scores.front(), &Score::name));
  world.tell(scores, result);
  result.publish(files);
}

ResultTable scores_table(const Scores& scores) {
  ResultTable table;
  for (const Score& score : scores) {
    std::vector<Field> row = {{of_words("classifier", "right, % after reports:"), score.name}};
    for (const std::size_t k : shown_reports(score.right.size()))
      row.push_back({{.header = fmt::format("{}", k), .digits = 1, .scale = 100.0}, score.right[k - 1].mean()});
    row.insert(
        row.end(),
        {{{.key = "accuracy"}, score.accuracy()},
         {of_points("accuracy_minus_that_of_the_first", "last, more than row 1"),
          &score == &scores.front() ? Cell() : Cell(score.minus_first.interval())},
         {{.key = "ties", .header = "ties", .unit = "%", .digits = 1, .scale = 100.0}, score.ties.mean()},
         {{.key = "mean_degree_of_truth", .header = "p or π of truth", .digits = 3}, score.belief_in_truth.mean()},
         {{.key = "mean_necessity_of_truth", .header = "necessity of truth", .digits = 3},
          score.fuzzy ? Cell(score.necessity_of_truth.mean()) : Cell()},
         {{.key = "reports_passed_over"}, score.refused > 0 ? Cell(score.refused) : Cell()}});
    table.row_of(row);
  }
  return table;
}

void add_scores(Result& result, const Scores& scores) {
  result.add(scores_table(scores),
             {.summary = {"classifiers"}, .title = "Right decisions", .note = "Differences ± 95 % by paired runs."});
  result.say(
      "(Ties share the credit. Differences ± 95 % by paired runs. Means over the runs. Necessity: 1 − the possibility "
      "of the best other.)");
  LineChart chart{.title = "Right decisions",
                  .x_label = "reports",
                  .y_label = "share of the runs that are right; ties share the credit"};
  auto curves = ResultTable::of_keys({"report", "classifier", "accuracy"});
  for (std::size_t k = 0; k < scores.front().right.size(); ++k) chart.x.push_back(static_cast<double>(k + 1));
  for (const Score& score : scores) {
    if (score.refused > 0)
      result.say("{}: {} reports excluded every pattern that was left and were passed over", score.name, score.refused);
    chart.curves.push_back({score.name, score.name, each(score.right, &RunningMean::mean)});
    for (std::size_t k = 0; k < score.right.size(); ++k) curves.row({k + 1, score.name, score.right[k].mean()});
  }
  result.page.panels.emplace_back(std::move(chart));
  result.add(curves, {.printed = false, .csv = "curves.csv"});
}

}  // namespace sigmax::apps
