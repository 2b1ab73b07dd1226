#include <sigmax/recognition/table_classifier.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <sigmax/core/transform.hpp>

namespace sigmax {
namespace {

/// By relations that were learned. A feature that may be misread has p(reading|feature) as its sensor, in the form that
/// `as_sensor` gives it.
template <Uncertainty Kind, class AsSensor>
AnyClassifier made(const TableModel& model, const Distribution<Kind>& prior,
                   std::vector<Relation<Kind, Kind>> relations, const AsSensor& as_sensor) {
  const double misread = model.options.misread;
  std::vector<FeatureModel<Kind, Kind>> features;
  for (auto& relation : relations) {
    const RandomVariable feature = as_random(relation.to());
    if (misread > 0.0 && feature.size() > 1)
      features.emplace_back(relation, as_sensor(symmetric_sensor(feature, feature, 1.0 - misread, misread)));
    else
      features.emplace_back(std::move(relation));
  }
  return Classifier<Kind, Kind>{prior, std::move(features)};
}

AnyClassifier sigma(const TableModel& model) {
  const auto& [features, counts, options] = model;
  return made(model, options.equal_prior ? uninformative(counts.pattern()) : pattern_prior(counts),
              learned_relations(counts, options.smoothing), std::identity{});
}

template <PossibilityTransform Method>
AnyClassifier max(const TableModel& model, const Method& method, bool random_sensor) {
  const auto& [features, counts, options] = model;
  const auto prior =
      options.equal_prior ? uninformative(as_fuzzy(counts.pattern())) : to_possibility(pattern_prior(counts), method);
  auto relations = learned_relations(counts, options.smoothing, method);
  if (random_sensor)
    return made(model, prior, std::move(relations), [](const auto& sensor) { return with_fuzzy_condition(sensor); });
  return made(model, prior, std::move(relations),
              [&](const auto& sensor) { return with_fuzzy_condition(to_possibility(sensor, method)); });
}

AnyClassifier made(const TableModel& model, TableInference inference) {
  switch (inference) {
    case TableInference::sigma:
      return sigma(model);
    case TableInference::max_by_ratio:
      return max(model, RatioScale{}, false);
    case TableInference::max_by_dubois_prade:
      return max(model, DuboisPrade{}, false);
    case TableInference::sigma_max_by_ratio:
      return max(model, RatioScale{}, true);
    case TableInference::sigma_max_by_dubois_prade:
      return max(model, DuboisPrade{}, true);
  }
  throw std::invalid_argument("there is no such inference");
}

}  // namespace

std::vector<double> degrees_of(const AnyBelief& belief) {
  const auto degrees = [](const auto& one) { return std::vector<double>(one.distribution().values()); };
  return std::visit(degrees, belief);
}

std::string_view name_of(TableInference inference) {
  constexpr std::array names = {"sigma", "max, ratio scale", "max, Dubois-Prade", "sigma-max, ratio scale",
                                "sigma-max, Dubois-Prade"};
  return names.at(static_cast<std::size_t>(inference));
}

TableClassifier TableClassifier::fit(const std::vector<TableColumn>& columns, const TableColumn& label,
                                     const TableOptions& options, TableInference inference) {
  std::vector<std::size_t> classes;
  for (const double place : label.cells)
    classes.push_back(std::isnan(place) ? missing : static_cast<std::size_t>(place));
  const auto labelled = [&](std::size_t row) { return classes[row] != missing; };
  return TableClassifier{TableModel::fit(columns, {label.name, label.words}, classes, options, labelled), inference};
}

TableClassifier::TableClassifier(TableModel model, TableInference inference)
    : TableClassifier(std::make_shared<const TableModel>(std::move(model)), inference) {}

TableClassifier::TableClassifier(std::shared_ptr<const TableModel> model, TableInference inference)
    : model_(std::move(model)), inference_(inference), classifier_(made(*model_, inference)) {}

TablePrediction TableClassifier::predict(std::span<const std::size_t> readings) const {
  return std::visit(
      [&](const auto& classifier) {
        Belief belief{classifier.prior()};
        bool excluded = false;
        try {
          classifier.observe(belief, InOrder{readings});
        } catch (const std::domain_error&) {
          excluded = true;
        }
        const Decision decision = decide(belief);
        return TablePrediction{decision, belief.variable().label(decision.pattern), std::move(belief), excluded};
      },
      classifier_);
}

PatternExplanation TableClassifier::explain(std::span<const std::size_t> readings) const {
  const TablePrediction prediction = predict(readings);
  const auto best = std::visit([](const auto& belief) { return best_patterns(belief, 2); }, prediction.belief);
  return std::visit(
      [&](const auto& classifier) {
        return sigmax::explain(classifier, classifier.report(InOrder{readings}), best.front(), best.back());
      },
      classifier_);
}

std::vector<std::size_t> TableClassifier::readings(const std::vector<TableCell>& row) const {
  const auto& features = model_->features;
  if (row.size() != features.size())
    throw std::invalid_argument("the row has " + std::to_string(row.size()) + " cells, but the table had " +
                                std::to_string(features.size()) + " columns");
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto* const word = std::get_if<std::string>(&row[i]);
    const double number = word ? std::numeric_limits<double>::quiet_NaN() : std::get<double>(row[i]);
    const bool is_missing = word ? word->empty() : std::isnan(number);
    if (!is_missing && features[i].bins.has_value() == (word != nullptr))
      throw std::invalid_argument("column '" + features[i].name + "' holds " +
                                  (word ? "numbers, not '" + *word + "'" : "words, not " + std::to_string(number)));
    const auto place = word && !is_missing ? features[i].find(*word) : std::nullopt;
    if (word && !is_missing && !place)
      result.push_back(missing);
    else
      result.push_back(reading(i, place ? static_cast<double>(*place) : number));
  }
  return result;
}

std::vector<std::size_t> TableClassifier::readings(std::span<const TableColumn> columns, std::size_t row) const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < columns.size(); ++i) result.push_back(reading(i, columns[i].cells[row]));
  return result;
}

/// Of a word that no row had, which would be taken for one of the class with the fewest rows, nothing.
std::size_t TableClassifier::reading(std::size_t feature, double cell) const {
  const std::size_t found = model_->features[feature].reading(cell);
  if (found == missing || model_->features[feature].bins) return found;
  const Counts& counts = model_->counts;
  for (std::size_t c = 0; c < counts.pattern().size(); ++c)
    if (counts.of(feature, c)[found] > 0.0) return found;
  return missing;
}

}  // namespace sigmax
