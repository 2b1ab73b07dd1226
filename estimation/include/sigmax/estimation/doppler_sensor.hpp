#pragma once

#include <sigmax/estimation/sensors.hpp>

namespace sigmax {

/// A radar in its own space that also measures the rate of the range, in m/s: what PolarSensor measures, and behind it
/// ṙ = dᵀv / r of a target at d from the origin with the velocity v. The radar stands still.
template <int Axes>
class DopplerSensor : public detail::RadarSensor<DopplerSensor<Axes>, Axes, Axes + 1, 2 * Axes> {
 public:
  using detail::RadarSensor<DopplerSensor, Axes, Axes + 1, 2 * Axes>::RadarSensor;

  void compute(const double* x, int, double* z, double* H) const {
    detail::doppler(Axes, this->origin_.data(), x, z, H);
  }
};

}  // namespace sigmax
