#include "recognition_demo/learned_model.hpp"

#include <algorithm>
#include <cmath>

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

/// The line of the first row of a class.
std::size_t line_of_class(const DataTable& data, std::size_t c) {
  const auto row = std::find(data.labels.begin(), data.labels.end(), c) - data.labels.begin();
  return data.lines[static_cast<std::size_t>(row)];
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
  LearnedModel model{data.label, std::move(codes), std::move(counts), options};
  for (const std::size_t row : rows) model.counts.observe(data.labels[row], readings(model, data, row));
  for (std::size_t c = 0; c < data.classes.size(); ++c)
    if (model.counts.rows(c) == 0.0)
      throw InputError(
          message({.where = fmt::format("{}:{}", data.file, line_of_class(data, c)),
                   .what = fmt::format("class {} of column {}", in_quotes(data.classes[c]), in_quotes(data.label)),
                   .found = "no row to learn from",
                   .expected = "at least two in the file",
                   .remedy = "add rows, or remove those of the class"}));
  return model;
}

Readings readings(const LearnedModel& model, const DataTable& data, std::size_t row) {
  Readings result;
  for (std::size_t i = 0; i < data.columns.size(); ++i)
    result.push_back(data.columns[i].numeric ? model.features[i].bins->bin(data.columns[i].numbers[row])
                                             : data.columns[i].codes[row]);
  return result;
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
