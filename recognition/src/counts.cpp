#include <sigmax/recognition/counts.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace sigmax {
namespace {

void prove_weight(double value, const char* name) {
  if (!(value >= 0.0 && std::isfinite(value)))
    throw std::invalid_argument(std::string(name) + " is finite and not negative, not " + std::to_string(value));
}

void prove_feature(const Counts& counts, std::size_t feature) {
  if (feature >= counts.features().size())
    throw std::invalid_argument("the counts of '" + counts.pattern().name() + "' have " +
                                std::to_string(counts.features().size()) + " features, no number " +
                                std::to_string(feature));
}

}  // namespace

Counts::Counts(RandomVariable pattern, std::vector<RandomVariable> features)
    : pattern_(std::move(pattern)), features_(std::move(features)), rows_(pattern_.size(), 0.0) {
  if (features_.empty())
    throw std::invalid_argument("the counts of '" + pattern_.name() + "' need at least one feature");
  for (const RandomVariable& feature : features_) tables_.emplace_back(pattern_.size(), feature.size());
}

void Counts::observe(std::size_t pattern, std::span<const std::size_t> row, double times) {
  if (pattern >= pattern_.size()) pattern_.label(pattern);  // throws
  prove_weight(times, "how often a row counts");
  if (row.size() != features_.size())
    throw std::invalid_argument("the counts of '" + pattern_.name() + "' have " + std::to_string(features_.size()) +
                                " features, but the row has " + std::to_string(row.size()) + " values");
  for (std::size_t i = 0; i < row.size(); ++i)
    if (row[i] != missing && row[i] >= features_[i].size()) features_[i].label(row[i]);  // throws
  rows_[pattern] += times;
  for (std::size_t i = 0; i < row.size(); ++i)
    if (row[i] != missing) tables_[i](pattern, row[i]) += times;
}

void Counts::observe_value(std::size_t pattern, std::size_t feature, std::size_t value, double times) {
  prove_feature(*this, feature);
  pattern_.label(pattern);
  features_[feature].label(value);
  prove_weight(times, "how often a value counts");
  tables_[feature](pattern, value) += times;
}

Distribution<Random> pattern_prior(const Counts& counts, double alpha) {
  prove_weight(alpha, "the α of a prior");
  std::vector<double> weights(counts.pattern().size());
  for (std::size_t c = 0; c < weights.size(); ++c) weights[c] = counts.rows(c) + alpha;
  return normalized(counts.pattern(), weights);
}

Relation<Random, Random> learned_relation(const Counts& counts, std::size_t feature, double alpha) {
  prove_weight(alpha, "the α of a prior");
  prove_feature(counts, feature);
  const RandomVariable& variable = counts.features()[feature];
  Table rows(counts.pattern().size(), variable.size());
  for (std::size_t c = 0; c < rows.rows(); ++c) {
    const auto seen = counts.of(feature, c);
    const auto row = rows.row(c);
    for (std::size_t f = 0; f < row.size(); ++f) row[f] = seen[f] + alpha;
    if (total<Random>(row) == 0.0)
      throw std::invalid_argument("no row of " + counts.pattern().name() + " = '" + counts.pattern().label(c) +
                                  "' has a value of '" + variable.name() + "', and α is 0");
    condition<Sigma>(row);
  }
  return {variable, counts.pattern(), std::move(rows), detail::ByLaw{}};
}

std::vector<Relation<Random, Random>> learned_relations(const Counts& counts, double alpha) {
  std::vector<Relation<Random, Random>> result;
  for (std::size_t i = 0; i < counts.features().size(); ++i) result.push_back(learned_relation(counts, i, alpha));
  return result;
}

}  // namespace sigmax
