#pragma once

#include <algorithm>
#include <cmath>

#include <sigmax/core/belief.hpp>
#include <sigmax/core/compose.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

/// How probable or possible it is that a target which exists is missed in a scan, and that it is detected, as
/// logarithms.
struct DetectionWeights {
  double log_missed, log_detected;

  /// 1 − P_D P_G and P_D; of a fuzzy kind 1 − P_D and P_D, divided by the greater.
  template <ScalableUncertainty Kind>
  static DetectionWeights of(double detection_probability, double gate_probability) {
    if (!AlgebraOf<Kind>::selective)
      return {std::log(1.0 - detection_probability * gate_probability), std::log(detection_probability)};
    const double greatest = std::max(detection_probability, 1.0 - detection_probability);
    return {std::log((1.0 - detection_probability) / greatest), std::log(detection_probability / greatest)};
  }
};

/// Whether a target exists: a variable of two outcomes, of the kind of the association's pattern. With sums it is the
/// existence of integrated PDA (Musicki, Evans and Stankovic 1994), r⁺ = 1 − β₀ + β₀ (1 − P_D P_G) r / (1 − P_D P_G r);
/// with maxima that of the possibilistic Bernoulli filter (Ristic, Houssineau and Arulampalam 2020). Its weights q₀ of
/// absence and q₁ of presence are normalised by their own ⊕.
template <ScalableUncertainty Kind>
class Existence {
 public:
  /// Presence has this probability, between 0 and 1; of a fuzzy kind this possibility, and absence is possible.
  explicit Existence(double presence)
      : belief_(Distribution<Kind>{variable(), {AlgebraOf<Kind>::selective ? 1.0 : 1.0 - presence, presence}}) {}

  /// The transition over a time in which a target that exists survives with this probability. None begins in it.
  static Relation<Kind, Kind> survival(double probability) {
    const double total = AlgebraOf<Kind>::plus(1.0 - probability, probability);
    return {variable(), variable(), {{1.0, 0.0}, {(1.0 - probability) / total, probability / total}}};
  }

  double log_presence() const { return belief_.log(1); }
  double presence() const { return belief_[1]; }
  /// How certain presence is: its probability, or one minus the possibility of absence.
  double necessity() const { return AlgebraOf<Kind>::selective ? 1.0 - belief_[0] : belief_[1]; }

  void predict(const Relation<Kind, Kind>& survival) { compose(survival, belief_, belief_); }

  /// The logarithm of q₀ ⊕ q₁ ⊗ d₀: how much it weighs in the matching that the target has no detection.
  double log_none(const DetectionWeights& weights) const {
    return log_plus(belief_.log(0), belief_.log(1) + weights.log_missed);
  }

  /// How much that has, given that the target exists, of a marginal weight of having no detection.
  double log_missed(const DetectionWeights& weights, double log_none_marginal) const {
    return shared(log_none_marginal, belief_.log(1) + weights.log_missed, log_none(weights));
  }

  /// After a scan, by the marginal weights that the matching gave no detection and any detection, as logarithms.
  /// Throws std::domain_error if nothing is left.
  void update(const DetectionWeights& weights, double log_none_marginal, double log_any_marginal) {
    const double absent = shared(log_none_marginal, belief_.log(0), log_none(weights));
    const double present = log_plus(log_any_marginal, log_missed(weights, log_none_marginal));
    belief_.assign([&](std::size_t outcome) { return outcome == 0 ? absent : present; });
  }

 private:
  static const Variable<Kind>& variable() {
    static const Variable<Kind> existence{"existence", {"absent", "present"}};
    return existence;
  }
  static double log_plus(double a, double b) {
    return detail::log_combine<AlgebraOf<Kind>>(
        2, [&](std::size_t i) { return i == 0 ? a : b; }, [](std::size_t) { return 1.0; });
  }
  /// A marginal's part of this share of a total.
  static double shared(double marginal, double share, double total) {
    return marginal == log_zero || share == log_zero ? log_zero : marginal + share - total;
  }

  Belief<Kind> belief_;
};

}  // namespace sigmax
