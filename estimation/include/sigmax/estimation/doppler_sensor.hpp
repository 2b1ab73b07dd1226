#pragma once

#include <sigmax/estimation/sensors.hpp>

namespace sigmax {

/// A radar in its own space that also measures the rate of the range, in m/s: what PolarSensor measures, and behind it
/// ṙ = dᵀv / r of a target at d from the origin with the velocity v. The radar stands still.
template <int Axes>
class DopplerSensor {
 public:
  static constexpr int axes = Axes;
  static constexpr int seen_size = 2 * Axes;
  static constexpr int measurement_size = Axes + 1;

  explicit DopplerSensor(const Vector<Axes>& origin = Vector<Axes>::Zero()) : polar_(origin) {}
  const Vector<Axes>& origin() const { return polar_.origin(); }

  template <class Scalar>
  Eigen::Matrix<Scalar, Axes + 1, 1> measure(const Eigen::Matrix<Scalar, 2 * Axes, 1>& x) const {
    using std::sqrt;
    const Eigen::Matrix<Scalar, Axes, 1> position = x.template head<Axes>();
    Scalar along(0.0), squared(0.0);
    for (int axis = 0; axis < Axes; ++axis) {
      const Scalar d = position(axis) - origin()(axis);
      along += d * x(Axes + axis);
      squared += d * d;
    }
    Eigen::Matrix<Scalar, Axes + 1, 1> seen;
    seen.template head<Axes>() = polar_.measure(position);
    seen(Axes) = along / sqrt(squared);
    return seen;
  }

  RectangularMatrix<Axes + 1, 2 * Axes> measurement_jacobian(const Vector<2 * Axes>& x) const {
    const Vector<Axes> d = x.template head<Axes>() - origin();
    const Vector<Axes> v = x.template tail<Axes>();
    const double r = d.norm();
    RectangularMatrix<Axes + 1, 2 * Axes> H = RectangularMatrix<Axes + 1, 2 * Axes>::Zero();
    H.template topLeftCorner<Axes, Axes>() = polar_.measurement_jacobian(x.template head<Axes>());
    H.template bottomLeftCorner<1, Axes>() = ((v - d * (d.dot(v) / (r * r))) / r).transpose();
    H.template bottomRightCorner<1, Axes>() = d.transpose() / r;
    return H;
  }

  Vector<Axes + 1> measurement_difference(const Vector<Axes + 1>& z, const Vector<Axes + 1>& predicted) const {
    Vector<Axes + 1> difference = z - predicted;
    difference(1) = wrapped(difference(1));
    return difference;
  }

  /// What a measurement tells of the position, as of PolarSensor.
  Gaussian<Axes> position(const Gaussian<Axes + 1>& z) const {
    return polar_.position({z.mean.template head<Axes>(), z.covariance.template topLeftCorner<Axes, Axes>()});
  }

 private:
  PolarSensor<Axes> polar_;
};

}  // namespace sigmax
