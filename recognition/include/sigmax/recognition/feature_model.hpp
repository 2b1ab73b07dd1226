#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/compose.hpp>

namespace sigmax {

/// One feature of the patterns, and how it is read: p(f|c) or π(f|c), and p(z|f) or π(z|f) if a sensor stands between.
///
///     FeatureModel{legs_given_animal}                                    // the feature itself is read
///     FeatureModel{emitter_given_platform, reading_given_emitter}        // a sensor reads it
///
/// The sensor may be of another kind than the feature; the feature's kind chooses how it is eliminated: (42), (45), and
/// (17) or (18) without β. Stores the logarithms of the likelihoods for crisp readings, readings × patterns numbers.
template <Uncertainty Pattern, Uncertainty Feature>
class FeatureModel {
 public:
  /// The readings are the values of the feature. Implicit: a relation is a feature model.
  FeatureModel(Relation<Feature, Pattern> feature_given_pattern)
      : relation_(std::move(feature_given_pattern)), readings_(relation_.to()), symbol_(symbol_of<Feature>()) {
    columns_ = columns([this](std::size_t reading) { return relation_.likelihood(reading); });
  }

  /// A feature that is read by a sensor. Throws std::invalid_argument, naming both, for a sensor of another feature.
  template <Uncertainty Reading>
  FeatureModel(Relation<Feature, Pattern> feature_given_pattern,
               const Relation<Reading, Feature>& reading_given_feature)
      : relation_(std::move(feature_given_pattern)),
        readings_(reading_given_feature.to()),
        symbol_(symbol_of<Reading>()) {
    check::same(relation_.to(), reading_given_feature.from(), "FeatureModel");
    for (std::size_t reading = 0; reading < readings_.size(); ++reading)
      sensor_.push_back(reading_given_feature.likelihood(reading));
    columns_ = columns([this](std::size_t reading) { return compose(sensor_[reading], relation_); });
  }

  /// L(f|c), (43) or (46).
  const Relation<Feature, Pattern>& relation() const& { return relation_; }
  Relation<Feature, Pattern> relation() const&& { return relation_; }
  const Variable<Feature>& feature() const& { return relation_.to(); }
  Variable<Feature> feature() const&& { return relation_.to(); }
  const Variable<Pattern>& pattern() const& { return relation_.from(); }
  Variable<Pattern> pattern() const&& { return relation_.from(); }

  /// What is read: the sensor's variable, or without a sensor the feature.
  const Outcomes& readings() const& { return readings_; }
  Outcomes readings() const&& { return readings_; }
  bool has_sensor() const { return !sensor_.empty(); }

  /// "p" if readings are random, "π" if they are fuzzy.
  std::string_view reading_symbol() const { return symbol_; }

  /// How well each value of the feature explains a crisp reading: the sensor's L(z|f), or without one certainty.
  /// Throws std::invalid_argument, naming the variable, if it has no such reading.
  Likelihood<Feature> evidence(std::size_t reading) const {
    readings_.label(reading);  // throws if there is no such reading
    if (has_sensor()) return sensor_[reading];
    std::vector<double> certain(feature().size(), 0.0);
    certain[reading] = 1.0;
    return {feature(), certain};
  }

  /// log L(z|c) of a crisp reading z, for every pattern c: (42), (45), (17), (18), computed once. Throws
  /// std::invalid_argument, naming the variable, if it has no such reading. The view lives as long as the model; of a
  /// temporary it is a copy.
  std::span<const double> log_likelihoods(std::size_t reading) const& {
    if (reading >= columns_.rows()) readings_.label(reading);  // throws
    return columns_.row(reading);
  }
  std::vector<double> log_likelihoods(std::size_t reading) const&& {
    const auto row = log_likelihoods(reading);
    return {row.begin(), row.end()};
  }

 private:
  template <Uncertainty Kind>
  static constexpr std::string_view symbol_of() {
    return SelectiveAlgebra<AlgebraOf<Kind>> ? "π" : "p";
  }

  template <class LikelihoodOf>
  Table columns(const LikelihoodOf& likelihood_of) const {
    Table all(readings_.size(), pattern().size());
    for (std::size_t reading = 0; reading < all.rows(); ++reading) {
      const Likelihood<Pattern> column = likelihood_of(reading);
      std::copy_n(column.logs().begin(), all.columns(), all.row(reading).begin());
    }
    return all;
  }

  Relation<Feature, Pattern> relation_;
  Outcomes readings_;
  std::string_view symbol_;
  std::vector<Likelihood<Feature>> sensor_;  // L(z|f) for each reading; none if the feature itself is read
  Table columns_{0, 0};                      // log L(z|c), a row per reading: what a crisp report needs is contiguous
};

/// p(reading|feature): `right` where both have the same place, `wrong` in equal parts for the other readings. Throws as
/// `Relation` does, unless they sum to one.
inline Relation<Random, Random> symmetric_sensor(const RandomVariable& reading, const RandomVariable& feature,
                                                 double right, double wrong) {
  const std::size_t n = feature.size();
  std::vector<std::vector<double>> rows(n, std::vector<double>(n, wrong / static_cast<double>(n - 1)));
  for (std::size_t f = 0; f < n; ++f) rows[f][f] = right;
  return {reading, feature, rows};
}

/// A relation read by a sensor of any kind.
template <Uncertainty Pattern, Uncertainty Feature>
FeatureModel(Relation<Feature, Pattern>) -> FeatureModel<Pattern, Feature>;
template <Uncertainty Pattern, Uncertainty Feature, Uncertainty Reading>
FeatureModel(Relation<Feature, Pattern>, Relation<Reading, Feature>) -> FeatureModel<Pattern, Feature>;

}  // namespace sigmax
