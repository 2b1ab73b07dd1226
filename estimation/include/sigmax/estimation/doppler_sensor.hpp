#pragma once

#include <sigmax/estimation/sensors.hpp>

namespace sigmax {

/// A radar in its own space that also measures the range rate, in m/s. The quantities of PolarSensor come first, then
/// ṙ = dᵀv / r of a target at d from the origin with the velocity v. The radar stands still.
template <int Axes>
class DopplerSensor : public detail::RadarSensor<DopplerSensor<Axes>, Axes, Axes + 1, 2 * Axes> {
 public:
  using detail::RadarSensor<DopplerSensor, Axes, Axes + 1, 2 * Axes>::RadarSensor;

  /// What this radar measured, with these standard deviations, and the rate of the range with its own, in m/s.
  MeasuredBy<DopplerSensor> measurement(const Polar& measured, const Polar& sigma, double range_rate,
                                        double sigma_range_rate) const {
    const auto polar = PolarSensor<Axes>{}.measurement(measured, sigma).z;
    MeasurementOf<DopplerSensor> z{Vector<Axes + 1>::Zero(), SquareMatrix<Axes + 1>::Zero()};
    z.mean << polar.mean, range_rate;
    z.covariance.diagonal() << polar.covariance.diagonal(), sigma_range_rate * sigma_range_rate;
    return {z, *this};
  }

  void compute(const double* x, int, double* z, double* H) const {
    detail::doppler(Axes, this->origin_.data(), x, z, H);
  }
};

}  // namespace sigmax
