#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/estimation/chi_square.hpp>

namespace sigmax {

/// Up to which `gate_distance()` a measurement counts. A gate says whether its number is a probability or a distance:
///
///     filter.step(1.0, z, Gate::probability(0.999));
///
/// A default one is open: every measurement passes.
class Gate {
 public:
  Gate() { limits_.fill(std::numeric_limits<double>::infinity()); }

  /// Turns a right measurement away with probability 1 − p: the p-quantile of χ² with as many degrees of freedom as a
  /// measurement has numbers. 1 is open. Make it once, since each quantile takes an iteration. Throws
  /// std::invalid_argument unless 0 < p ≤ 1.
  static Gate probability(double p) {
    Gate gate;
    for (std::size_t m = 0; p != 1.0 && m < gate.limits_.size(); ++m)
      gate.limits_[m] = chi_square_quantile(p, static_cast<double>(m + 1));
    return gate;
  }

  /// Throws std::invalid_argument for a negative squared distance.
  static Gate squared_distance(double limit) {
    if (!(limit >= 0.0)) throw std::invalid_argument("the squared distance of a gate is negative");
    Gate gate;
    gate.limits_.fill(limit);
    return gate;
  }

  /// The greatest squared distance of a measurement of m numbers that passes.
  double limit(int m) const { return limits_[static_cast<std::size_t>(m - 1)]; }

 private:
  std::array<double, max_measurement_size> limits_;
};

}  // namespace sigmax
