#pragma once

#include <cstddef>
#include <string>

#include <sigmax/core/distribution.hpp>
#include <sigmax/recognition/discretization.hpp>

namespace sigmax {

/// A triangular possibility: zero below `minimum` and above `maximum`, one at `optimum`, linear between. What is known
/// of a quantity when only [min, opt, max] is.
class Triangle {
 public:
  /// Throws std::invalid_argument, with the numbers, unless all are finite and minimum ≤ optimum ≤ maximum.
  Triangle(double minimum, double optimum, double maximum);

  double minimum() const { return minimum_; }
  double optimum() const { return optimum_; }
  double maximum() const { return maximum_; }

  /// π(x).
  double operator()(double x) const;

  /// sup π(x) over the interval [lower, upper); the bounds may be infinite. A limit that is not attained counts.
  double supremum(double lower, double upper) const;

 private:
  double minimum_, optimum_, maximum_;
};

/// Possibility of each bin: the supremum of the triangle over it, since a bin is as possible as its most possible
/// value. No bin gets less than `least`, so that an unexpected value does not exclude a pattern for ever. The greatest
/// is one wherever the optimum falls, as the bins leave no gap.
///
/// Throws std::invalid_argument, naming the variable, if it has not as many outcomes as there are bins, and if `least`
/// is not in [0, 1].
Distribution<Fuzzy> triangular(const FuzzyVariable& variable, const Discretization& bins, const Triangle& triangle,
                               double least = 0.0);

}  // namespace sigmax
