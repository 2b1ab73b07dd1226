#include "recognition_demo/learning.hpp"

#include <sigmax/recognition/folds.hpp>

#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

/// The scores in one fold, by classifier; of each row who was right is counted.
std::vector<Outcome> classify_fold(const LabelledTable& data, const Folds& folds, std::size_t fold,
                                   const TableOptions& options, std::vector<Results::TimesRight>& times_right) {
  const auto all = taught(data, folds, fold, options);
  std::vector<Outcome> outcomes;
  for (const TableClassifier& one : all)
    std::visit(
        [&](const auto& by) {
          outcomes.push_back({std::string(one.name()), Evaluation{by.prior().variable()}});
        },
        one.classifier());
  for (std::size_t row = 0; row < data.size(); ++row) {
    if (folds[row] != fold) continue;
    const auto readings = all.front().readings(data.columns, row);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const TablePrediction prediction = all[i].predict(readings);
      if (prediction.excluded) ++outcomes[i].excluded;
      std::visit(
          [&]<class Kind>(const Belief<Kind>& belief) {
            auto& evaluation = std::get<Evaluation<Kind>>(outcomes[i].evaluation);
            times_right[row][i] += evaluation.add(data.labels[row], belief) > 0.0 ? 1U : 0U;
            outcomes[i].reliability.add(data.labels[row], belief);
          },
          prediction.belief);
    }
  }
  return outcomes;
}

void add(std::vector<Outcome>& outcomes, std::vector<Outcome> fold) {
  if (outcomes.empty()) outcomes.swap(fold);
  for (std::size_t i = 0; i < fold.size(); ++i) {
    outcomes[i].excluded += fold[i].excluded;
    outcomes[i].reliability.add(fold[i].reliability);
    std::visit([&]<class Kind>(Evaluation<Kind>& sum) { sum.add(std::get<Evaluation<Kind>>(fold[i].evaluation)); },
               outcomes[i].evaluation);
  }
}

}  // namespace

Folds divided(const LabelledTable& data, std::size_t folds, std::mt19937_64& generator) try {
  return data.groups.empty() ? stratified_folds(data.labels, folds, generator)
                             : grouped_folds(data.labels, data.groups, folds, generator);
} catch (const std::invalid_argument& error) {
  throw InputError("{}: {}; give fewer --folds", data.file, error.what());
}

Interval Results::minus_first(std::size_t i) const {
  RunningMean by_row, by_group;
  std::vector<std::pair<double, double>> sums;  // of a group's differences, and its rows
  for (std::size_t row = 0; row < times_right.size(); ++row) {
    const TimesRight& times = times_right[row];
    const double difference = of_a_folding(static_cast<double>(times[i]) - static_cast<double>(times[0]));
    by_row.add(difference);
    if (groups.empty()) continue;
    sums.resize(std::max(sums.size(), groups[row] + 1));
    sums[groups[row]].first += difference;
    sums[groups[row]].second += 1.0;
  }
  const double groups_a_row = static_cast<double>(sums.size()) / static_cast<double>(times_right.size());
  for (const auto& [sum, rows] : sums) by_group.add(by_row.mean() + groups_a_row * (sum - rows * by_row.mean()));
  return groups.empty() ? by_row.interval() : by_group.interval();
}

std::vector<TableClassifier> taught(const LabelledTable& data, const Folds& folds, std::size_t fold,
                                    const TableOptions& options) {
  return classifiers(TableModel::fit(data.columns, {data.label, data.classes}, data.labels, options,
                                     [&](std::size_t row) { return folds[row] != fold; }));
}

Results cross_validated(const LabelledTable& data, const EvaluateOptions& options) {
  Results results{{}, std::vector<Results::TimesRight>(data.size()), data.groups, options.foldings};
  const int threads = threads_or_all(options.threads);
  Progress progress("folds", options.folds * options.foldings, options.output.quiet);
  std::mt19937_64 generator(options.seed);
  for (std::size_t folding = 0; folding < options.foldings; ++folding) {
    const Folds folds = divided(data, options.folds, generator);
    for_each_run(
        options.folds, threads,
        [&](std::size_t fold) { return classify_fold(data, folds, fold, options.learning, results.times_right); },
        [&](std::size_t, std::vector<Outcome> fold) {
          progress.advance();
          add(results.outcomes, std::move(fold));
        },
        2 * static_cast<std::size_t>(threads));
  }
  progress.finish();
  return results;
}

}  // namespace sigmax::apps
