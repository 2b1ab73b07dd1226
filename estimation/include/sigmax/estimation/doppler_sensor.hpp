#pragma once

#include <sigmax/estimation/sensors.hpp>

namespace sigmax {

/// A radar in its own space that also measures the rate of the range, in m/s: what PolarSensor measures, and behind it
/// ṙ = dᵀv / r of a target at d from the origin with the velocity v. The radar stands still.
template <int Axes>
class DopplerSensor : public detail::ComputedSensor<DopplerSensor<Axes>, Axes + 1, 2 * Axes> {
  static_assert(Axes == 2 || Axes == 3, "range, azimuth and rate, or also elevation");

 public:
  static constexpr int axes = Axes;

  explicit DopplerSensor(const Vector<Axes>& origin = Vector<Axes>::Zero()) : origin_(detail::numbers_of(origin)) {}
  Vector<Axes> origin() const { return Vector<Axes>(origin_.data()); }

  Vector<Axes + 1> measurement_difference(const Vector<Axes + 1>& z, const Vector<Axes + 1>& predicted) const {
    Vector<Axes + 1> difference;
    detail::polar_difference(z.data(), predicted.data(), Axes + 1, difference.data());
    return difference;
  }

  /// What a measurement tells of the position, as of PolarSensor.
  Gaussian<Axes> position(const Gaussian<Axes + 1>& z) const {
    Gaussian<Axes> result;
    detail::position_of_polar(Axes, origin_.data(), z.mean.data(), z.covariance.data(), Axes + 1, result.mean.data(),
                              result.covariance.data());
    return result;
  }

  void compute(const double* x, int, double* z, double* H) const { detail::doppler(Axes, origin_.data(), x, z, H); }

 private:
  std::array<double, std::size_t{Axes}> origin_;
};

}  // namespace sigmax
