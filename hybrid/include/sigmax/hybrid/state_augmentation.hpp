#pragma once

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace sigmax {

/// What stands for a component that a model lacks when it is mixed into one that has it. Going down drops components.
enum class StateAugmentation {
  zero,               ///< value 0, variance 0
  borrowed_variance,  ///< value 0, the receiving model's variance, no cross terms (the authors' program)
  unbiased,           ///< value and covariance of the receiving model, uncorrelated with the rest (Yuan, Bar-Shalom,
                      ///< Willett 2012)
  prior               ///< value 0, the variance of EntryPrior, no cross terms: what a component can be that begins
};

/// What is thought of a component before anything was seen of it: its value is 0, give or take a standard deviation.
struct EntryPrior {
  /// The standard deviations that it may have, in its own unit: of accelerations m/s². A filter that keeps histories
  /// tries each of them; one that merges has their root mean square.
  std::vector<double> scales = {25.0};
  double vertical = 0.3;                       ///< so much of it along z: an aircraft turns harder than it climbs
  double turn_rate = std::numbers::pi / 60.0;  ///< that of a rate of turn, omega, in rad/s: 3°/s

  double variance(const std::string& component, double scale) const;
  double root_mean_square() const;
};

namespace detail {

/// Where each component of a receiving model stands in a source model, by name.
struct Correspondence {
  std::vector<int> in_source;  ///< for each component of the receiver; −1 if the source lacks it

  Correspondence(const std::vector<std::string>& receiver, const std::vector<std::string>& source);
};

}  // namespace detail

}  // namespace sigmax
