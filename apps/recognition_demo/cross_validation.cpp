#include "recognition_demo/cross_validation.hpp"

#include "shell/parallel.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

/// The scores in one fold, by classifier; who was right is noted.
std::vector<Outcome> classify_fold(const DataTable& data, const Folds& folds, std::size_t fold,
                                   const LearningOptions& options, Right& right) {
  const TaughtFold taught_fold = taught(data, folds, fold, options);
  std::vector<Outcome> outcomes;
  for (const Contestant& contestant : taught_fold.contestants)
    of_kind(contestant.classifier, [&](const auto& by) {
      outcomes.push_back({contestant.name, Evaluation{by.prior().variable()}});
    });
  classify_rows(data, folds, taught_fold, 0, outcomes.size(), [&](std::size_t row, std::size_t i, const Judged& by) {
    of_kind(by.belief, [&]<class Kind>(const Belief<Kind>& belief) {
      const bool is_right = std::get<Evaluation<Kind>>(outcomes[i].evaluation).add(data.labels[row], belief) > 0.0;
      const unsigned bits = (i == 0 ? 0U : right[row]) | (is_right ? 1U << i : 0U);
      right[row] = static_cast<std::uint8_t>(bits);
      outcomes[i].reliability.add(data.labels[row], belief);
    });
    if (by.excluded) ++outcomes[i].excluded;
  });
  return outcomes;
}

}  // namespace

void Results::add(std::vector<Outcome> fold) {
  if (outcomes.empty()) {
    outcomes = std::move(fold);
    return;
  }
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    outcomes[i].excluded += fold[i].excluded;
    outcomes[i].reliability.add(fold[i].reliability);
    of_kind(outcomes[i].evaluation, [&]<class Kind>(Evaluation<Kind>& evaluation) {
      evaluation.add(std::get<Evaluation<Kind>>(fold[i].evaluation));
    });
  }
}

void Results::add(const Right& right) {
  times_right.resize(right.size());
  for (std::size_t row = 0; row < right.size(); ++row)
    for (std::size_t i = 0; i < outcomes.size(); ++i) times_right[row][i] += right[row] >> i & 1U;
}

Interval Results::minus_first(std::size_t i, std::size_t foldings) const {
  RunningMean by_row, by_group;
  std::vector<std::pair<double, double>> sums;  // of a group's differences, and its rows
  for (std::size_t row = 0; row < times_right.size(); ++row) {
    const TimesRight& times = times_right[row];
    const double difference =
        (static_cast<double>(times[i]) - static_cast<double>(times[0])) / static_cast<double>(foldings);
    by_row.add(difference);
    if (!groups) continue;
    const std::size_t group = (*groups)[row];
    if (group >= sums.size()) sums.resize(group + 1);
    sums[group].first += difference;
    sums[group].second += 1.0;
  }
  const double groups_a_row = static_cast<double>(sums.size()) / static_cast<double>(times_right.size());
  for (const auto& [sum, rows] : sums) by_group.add(by_row.mean() + groups_a_row * (sum - rows * by_row.mean()));
  return groups ? by_group.interval() : by_row.interval();
}

Results cross_validated(const DataTable& data, const Deal& deal, const EvaluateOptions& options) {
  Results results;
  Right right(data.size());
  const int threads = threads_or_all(options.threads);
  Progress progress("folds", options.folds * options.foldings, options.output.quiet);
  std::mt19937_64 generator(options.seed);
  for (std::size_t folding = 0; folding < options.foldings; ++folding) {
    const Folds folds = deal(generator);
    for_each_run(
        options.folds, threads,
        [&](std::size_t fold) { return classify_fold(data, folds, fold, options.learning, right); },
        [&](std::size_t, std::vector<Outcome> fold) {
          progress.advance();
          results.add(std::move(fold));
        },
        2 * static_cast<std::size_t>(threads));
    results.add(right);
  }
  progress.finish();
  return results;
}

}  // namespace sigmax::apps
