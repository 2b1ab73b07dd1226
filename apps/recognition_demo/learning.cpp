#include "recognition_demo/learning.hpp"

#include <sigmax/core/transform.hpp>
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

Result comparison_result(std::string title, const OutputOptions& output, const std::vector<std::string>& contestants) {
  constexpr std::size_t widest_words = 120;  // longer lines are hard to read
  Result result(output);
  result.words_width = output.wide ? widest_words : terminal_width;
  result.page.title = std::move(title);
  for (const std::string& name : contestants) result.page.groups.push_back({.name = name});
  return result;
}

std::vector<Panel> relation_maps(const TableModel& model) {
  constexpr std::ptrdiff_t most = 6;
  // How far the patterns differ about a feature: the mean distance of two patterns' distributions.
  const auto telling = [](const Relation<Random, Random>& relation) {
    double distance = 0.0;
    for (std::size_t a = 0; a < relation.from().size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (std::size_t value = 0; value < relation.to().size(); ++value)
          distance += std::abs(relation(a, value) - relation(b, value));
    return distance;
  };
  auto all = learned_relations(model.counts, model.options.smoothing);
  std::erase_if(all, [](const auto& one) {
    constexpr std::size_t most_values = 30;  // of a feature, and classes
    return std::max(one.to().size(), one.from().size()) > most_values;
  });
  std::ranges::stable_sort(all, std::greater{}, telling);
  if (std::ssize(all) > most) all.erase(all.begin() + most, all.end());
  return each(all, [](const auto& relation) {
    HeatMap map{.title = "What was learned of " + relation.to().name(),
                .row_label = relation.from().name(),
                .column_label = relation.to().name(),
                .rows = labels_of(relation.from()),
                .columns = labels_of(relation.to()),
                .value_label = "probability of the value, given the class"};
    const auto possible = to_possibility(relation, RatioScale{});
    map.fill([&](std::size_t c, std::size_t value) {
      return HeatMap::Cell{relation(c, value),
                           fmt::format("possibility {} on the ratio scale", sized_text(possible(c, value), 2))};
    });
    return Panel(std::move(map));
  });
}

std::vector<TableClassifier> classifiers(TableModel model, std::span<const std::string> kinds) {
  using enum TableInference;
  const double misread = model.options.misread;
  for (const TableFeature& feature : model.features)
    if (const auto n = static_cast<double>(feature.size()); n > 1.0 && n * misread > n - 1.0)
      throw UsageError(
          "--misread {0}: feature {1} has {2} values, so that each other one would be read more often than the right "
          "one: give at most {3:.2f}",
          misread, in_quotes(feature.name), n, std::floor(100.0 * (n - 1.0) / n) / 100.0);
  const auto wanted = [&](std::string_view kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
  const TableClassifier first{std::move(model)};
  std::vector<TableClassifier> all;
  if (wanted("sigma")) all.push_back(first);
  if (wanted("max")) all.insert(all.end(), {first.by(max_by_ratio), first.by(max_by_dubois_prade)});
  if (wanted("sigma-max") && !wanted("max")) all.push_back(first.by(sigma_max_by_ratio));
  if (wanted("sigma-max") && !(wanted("max") && misread == 0.0)) all.push_back(first.by(sigma_max_by_dubois_prade));
  return all;
}

void add_learning(Subcommand app, std::string& file, TableReading& data, TableOptions& learning) {
  app.option("data", file, "A headed CSV file, or - for the standard input; empty cells and ? are missing values")
      .required()
      .type("DATA");
  app.option("--label", data.label, "The column with the class").required().type("COLUMN");
  app.list("--categorical", data.categorical, "Columns to take as words although they hold numbers, or all")
      .type("COLUMN,…|all");
  app.list("--ignore", data.ignore, "Columns to leave out").type("COLUMN,…");
  app.list("--missing", data.missing,
           "Words that are missing values; - NA N/A nan null inf are so in columns of numbers")
      .type("WORD,…");
  app.list("--missing-value", data.missing_value, "Columns whose missing cells are a value of their own")
      .type("COLUMN,…");
  app.option("--bins", learning.bins, "Bins of a numeric column").in(1, 1000);
  app.flag("--equal-width", learning.equal_width, "Bins of equal width instead of equal frequency");
  app.option("--smoothing", learning.smoothing, "What is added to every count; 1 is Laplace's rule")
      .number_in(0.0, 1e9);
  app.option("--misread", learning.misread, "Probability that a sensor reads another value than the feature's")
      .number_in(0.0, 0.999);
  app.flag("--equal-prior", learning.equal_prior,
           "Every class is equally plausible before, whatever its share of the rows");
}

std::string described(const LabelledTable& data) {
  const auto features = data.columns.size();
  const auto numeric = std::ranges::count_if(data.columns, [](const auto& c) { return c.numeric(); });
  return fmt::format("{} rows, {} classes, {} {} ({} categorical, {} numeric)", data.size(), data.classes.size(),
                     features, features == 1 ? "feature" : "features", static_cast<long>(features) - numeric, numeric);
}

std::string described(const TableOptions& options) {
  std::string text = options.smoothing == 1.0 ? std::string("counts smoothed by Laplace's rule")
                                              : fmt::format("{} added to every count", options.smoothing);
  text += options.equal_prior ? "; every class equally plausible before" : "; prior by the classes' shares of the rows";
  if (options.misread > 0.0) text += fmt::format("; a reading is wrong with probability {}", options.misread);
  return text;
}

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
