#pragma once

#include <utility>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>

namespace sigmax {

/// Sequential pattern recognition: sigma inference (41)–(43) if patterns and features are random, max inference
/// (44)–(46) if they are fuzzy; nothing else changes.
///
///     Classifier classifier{uninformative(target), emitter_given_target};
///     classifier.observe(Likelihood{emitter, {0.7, 0.1, 0.2}});
///     most_likely(classifier.belief());
///
/// The static p(feature|pattern) is built from p(pattern|feature) by `invert`. A report about a fuzzy feature may come
/// from a random sensor: `observe(reading_given_feature.likelihood(reading))`.
template <Uncertainty Pattern, Uncertainty Feature>
class Classifier {
 public:
  /// Throws std::invalid_argument if the relation's condition is not the prior's variable.
  Classifier(const Distribution<Pattern>& prior, Relation<Feature, Pattern> feature_given_pattern)
      : feature_given_pattern_(std::move(feature_given_pattern)), belief_(prior) {
    check::same(prior.variable(), feature_given_pattern_.from(), "Classifier");
  }

  /// Takes one report, given as the likelihood of every feature: (42) and (41), or (45) and (44).
  /// Throws std::domain_error if the report excludes every pattern that was left.
  void observe(const Likelihood<Feature>& report) { update(belief_, compose(report, feature_given_pattern_), belief_); }

  /// What is believed of the pattern after all reports.
  Distribution<Pattern> belief() const { return belief_.distribution(); }

 private:
  Relation<Feature, Pattern> feature_given_pattern_;
  Belief<Pattern> belief_;
};

}  // namespace sigmax
