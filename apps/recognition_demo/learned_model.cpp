#include "recognition_demo/learned_model.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include <sigmax/recognition/dominance.hpp>

namespace sigmax::apps {
namespace {

Discretization fitted(const DataColumn& column, std::span<const std::size_t> rows, const LearningOptions& options) {
  std::vector<double> numbers;
  for (const std::size_t row : rows)
    if (!std::isnan(column.numbers[row])) numbers.push_back(column.numbers[row]);
  const auto [least, greatest] = std::minmax_element(numbers.begin(), numbers.end());
  if (numbers.empty() || *least == *greatest) return Discretization{{}};  // these rows cannot tell anything apart
  return options.equal_width ? equal_width(numbers, options.bins) : equal_frequency(numbers, options.bins);
}

/// p(reading|feature): right with probability 1 − misread, else any other value.
Relation<Random, Random> sensor(const RandomVariable& feature, double misread) {
  const std::size_t n = feature.size();
  std::vector<std::vector<double>> rows(n, std::vector<double>(n, misread / static_cast<double>(n - 1)));
  for (std::size_t f = 0; f < n; ++f) rows[f][f] = 1.0 - misread;
  return {feature, feature, rows};
}

bool is_read(const LearnedModel& model, const RandomVariable& feature) {
  return model.options.misread > 0.0 && feature.size() > 1;
}

Contestant sigma(const LearnedModel& model) {
  std::vector<FeatureModel<Random, Random>> features;
  for (auto& relation : learned_relations(model.counts, model.options.smoothing)) {
    if (is_read(model, relation.to()))
      features.emplace_back(relation, sensor(relation.to(), model.options.misread));
    else
      features.emplace_back(std::move(relation));
  }
  const auto prior = model.options.equal_prior ? uninformative(model.counts.pattern()) : pattern_prior(model.counts);
  return {"sigma", SigmaClassifier{prior, std::move(features)}};
}

template <PossibilityTransform Method>
Contestant fuzzy(const LearnedModel& model, const std::string& name, const Method& method, bool random_sensor) {
  std::vector<FeatureModel<Fuzzy, Fuzzy>> features;
  for (auto& relation : learned_relations(model.counts, model.options.smoothing, method)) {
    const RandomVariable feature = as_random(relation.to());
    if (!is_read(model, feature))
      features.emplace_back(std::move(relation));
    else if (random_sensor)
      features.emplace_back(relation, with_fuzzy_condition(sensor(feature, model.options.misread)));
    else
      features.emplace_back(relation,
                            with_fuzzy_condition(to_possibility(sensor(feature, model.options.misread), method)));
  }
  const auto prior = model.options.equal_prior ? uninformative(as_fuzzy(model.counts.pattern()))
                                               : to_possibility(pattern_prior(model.counts), method);
  return {name, MaxClassifier{prior, std::move(features)}};
}

}  // namespace

LearnedModel learn(const DataTable& data, std::span<const std::size_t> rows, const LearningOptions& options) {
  std::vector<FeatureCode> codes;
  std::vector<RandomVariable> variables;
  for (const auto& column : data.columns) {
    FeatureCode code{column.name, column.values, std::nullopt};
    if (column.numeric) code.bins = fitted(column, rows, options);
    variables.emplace_back(column.name, code.labels());
    codes.push_back(std::move(code));
  }
  Counts counts{RandomVariable{data.label, data.classes}, std::move(variables)};
  LearnedModel model{data.label, {}, std::move(codes), std::move(counts), options};
  Readings readings;
  for (const std::size_t row : rows) {
    read(model, data, row, readings);
    model.counts.observe(data.labels[row], readings);
  }
  return model;
}

void read(const LearnedModel& model, const DataTable& data, std::size_t row, Readings& readings) {
  readings.clear();
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    const DataColumn& column = data.columns[i];
    if (column.numeric)
      readings.push_back(model.features[i].bins->bin(column.numbers[row]));
    else
      readings.push_back(column.codes[row] == missing_code ? missing : column.codes[row]);
  }
}

void add_learning(CLI::App& app, std::string& file, DataOptions& data, LearningOptions& learning) {
  const auto add_list = [&](const char* name, std::vector<std::string>& words, const char* help, const char* type) {
    app.add_option(name, words, help)
        ->type_name(type)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  app.add_option("data", file, "A headed CSV file, or - for the standard input; empty cells and ? are missing values")
      ->required()
      ->type_name("DATA");
  app.add_option("--label", data.label, "The column with the class")->required()->type_name("COLUMN");
  add_list("--categorical", data.categorical, "Columns to take as words although they hold numbers, or all",
           "COLUMN,…|all");
  add_list("--ignore", data.ignore, "Columns to leave out", "COLUMN,…");
  add_list("--missing", data.missing,
           "Words that are missing values; - NA N/A nan null inf are so in columns of numbers", "WORD,…");
  app.add_option("--bins", learning.bins, "Bins of a numeric column")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--equal-width", learning.equal_width, "Bins of equal width instead of equal frequency");
  app.add_option("--smoothing", learning.smoothing, "What is added to every count; 1 is Laplace's rule")
      ->check(number_in(0.0, 1e9))
      ->capture_default_str();
  app.add_option("--misread", learning.misread,
                 "Probability that a reading is not the feature's value but one of the others")
      ->check(number_in(0.0, 0.999))
      ->capture_default_str();
  app.add_flag("--equal-prior", learning.equal_prior,
               "Every class is equally plausible before, whatever its share of the rows");
}

void print_warnings(const DataTable& data) {
  for (const auto& warning : data.warnings)
    std::fputs(fmt::format("recognition_demo: warning: {}\n", warning).c_str(), stderr);
}

std::string described(const DataTable& data) {
  const auto numeric = std::count_if(data.columns.begin(), data.columns.end(), [](const auto& c) { return c.numeric; });
  return fmt::format("{} rows, {} classes, {} features ({} categorical, {} numeric)", data.labels.size(),
                     data.classes.size(), data.columns.size(), static_cast<long>(data.columns.size()) - numeric,
                     numeric);
}

std::string described(const LearningOptions& options) {
  std::string text = options.smoothing == 1.0 ? std::string("counts smoothed by Laplace's rule")
                                              : fmt::format("{} added to every count", options.smoothing);
  text += options.equal_prior ? "; every class equally plausible before" : "; prior by the classes' shares of the rows";
  if (options.misread > 0.0) text += fmt::format("; a reading is wrong with probability {}", options.misread);
  return text;
}

std::vector<Contestant> classifiers(const LearnedModel& model, std::span<const std::string> kinds) {
  const auto wanted = [&](std::string_view kind) { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); };
  std::vector<Contestant> all;
  if (wanted("sigma")) all.push_back(sigma(model));
  for (const bool random_sensor : {false, true}) {
    const std::string kind = random_sensor ? "sigma-max" : "max";
    if (!wanted(kind)) continue;
    all.push_back(fuzzy(model, kind + ", ratio scale", RatioScale{}, random_sensor));
    all.push_back(fuzzy(model, kind + ", Dubois-Prade", DuboisPrade{}, random_sensor));
  }
  return all;
}

std::vector<std::string> warnings(const std::vector<Contestant>& classifiers) {
  std::vector<std::string> result;
  for (const Contestant& contestant : classifiers)
    std::visit(
        [&](const auto& classifier) {
          const auto& pattern = classifier.prior().variable();
          for (const Dominance& found : dominated_patterns(classifier))
            result.push_back(fmt::format("{} can never prefer {}: whatever is read, {} is at least as possible",
                                         contestant.name, in_quotes(pattern.label(found.pattern)),
                                         in_quotes(pattern.label(found.dominator))));
        },
        contestant.classifier);
  return result;
}

}  // namespace sigmax::apps
