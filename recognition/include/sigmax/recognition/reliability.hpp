#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <sigmax/core/belief.hpp>

namespace sigmax {

/// How often what was believed to a degree is true: a reliability diagram, in bins of equal width over [0, 1].
///
/// Calibrated probabilities are true as often as they say. Possibilities are an upper bound: they are to be true at
/// most as often, and no fault is found with one that is true more seldom. Cases are not kept.
///
///     Reliability reliability;
///     for (…) reliability.add(truth, classifier.posterior(row));
///     for (const auto& bin : reliability.bins()) …   // bin.mean_degree against bin.share
class Reliability {
 public:
  /// Throws std::invalid_argument without a bin.
  explicit Reliability(std::size_t bins = 10);

  /// Counts a statement that was believed to a degree. Throws std::invalid_argument if that is not in [0, 1].
  void add(double degree, bool is_true);

  /// Adds the belief about one object: a statement for each pattern, one of them true. Throws
  /// std::invalid_argument, naming the variable, if there is no such pattern.
  template <Uncertainty Kind>
  void add(std::size_t truth, const Belief<Kind>& belief) {
    belief.variable().label(truth);  // throws if there is no such pattern
    for (std::size_t c = 0; c < belief.size(); ++c) add(std::min(1.0, belief[c]), c == truth);
  }

  /// Adds all statements of another one with as many bins; throws std::invalid_argument for another number.
  void add(const Reliability& other);

  /// A bin that is not empty.
  struct Bin {
    double from, to;      ///< degrees in [from, to), the last one with 1
    double count;         ///< statements
    double mean_degree;   ///< of them
    double share;         ///< of them that is true
    double lower, upper;  ///< the share with 95 % confidence, by Wilson's interval
  };

  /// The bins that are not empty. Where each statement was counted so many times, say once a division into folds, it
  /// counts once. Throws std::invalid_argument unless that is at least one.
  std::vector<Bin> bins(double repetitions = 1.0) const;

  /// Mean of |mean degree − share| over the statements, bin by bin: the expected calibration error of probabilities.
  /// Throws std::domain_error if nothing was counted.
  double calibration_error() const;

 private:
  struct Sums {
    double count = 0.0, degrees = 0.0, true_ones = 0.0;
  };
  std::vector<Sums> sums_;
};

}  // namespace sigmax
