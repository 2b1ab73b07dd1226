#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include <sigmax/estimation/converted_measurement.hpp>
#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/sensing.hpp>

namespace sigmax {

/// The angle less whole turns, in [−π, π].
inline double wrapped(double angle) {
  return std::abs(angle) <= std::numbers::pi ? angle : std::remainder(angle, 2.0 * std::numbers::pi);  // rarely
}

/// Measures the position itself, H = [I 0], in m.
template <int Axes>
struct PositionSensor {
  static constexpr int axes = Axes;
  static constexpr int seen_size = Axes;
  static constexpr int measurement_size = Axes;
  static constexpr bool measures_leading_components = true;

  template <class Scalar>
  Eigen::Matrix<Scalar, Axes, 1> measure(const Eigen::Matrix<Scalar, Axes, 1>& position) const {
    return position;
  }

  /// What a measurement tells of the position.
  Gaussian<Axes> position(const Gaussian<Axes>& z) const { return z; }
};

/// Measures combinations H of the leading components of the state: `M` quantities, of `N` components. Of components
/// that a model lacks, in a bank of models of different sizes, H must say nothing.
template <int M, int N>
class LinearSensor {
 public:
  static constexpr int seen_size = N;
  static constexpr int measurement_size = M;

  explicit LinearSensor(RectangularMatrix<M, N> H) : H_(std::move(H)) {}
  const RectangularMatrix<M, N>& measurement_matrix() const { return H_; }

 private:
  RectangularMatrix<M, N> H_;
};

/// Measures some components of the state by themselves: an altitude, a place without one, a velocity. Which they are is
/// known at run time; at most `MaxSize` at once.
template <int MaxSize>
class ComponentSensor {
 public:
  static constexpr int measurement_size = Eigen::Dynamic;
  static constexpr int max_measurement_size = MaxSize;

  /// Their places in the state of every model, in which the position and its derivatives lead. If the number of axes is
  /// told, and the first places are those of the position, in order, a target can start from it. Throws
  /// std::invalid_argument for none, or more than `MaxSize`.
  explicit ComponentSensor(std::span<const int> places, int axes = 0) : size_(static_cast<int>(places.size())) {
    if (places.empty() || size_ > MaxSize)
      throw std::invalid_argument("a sensor of " + std::to_string(places.size()) + " components; expected 1 to " +
                                  std::to_string(MaxSize));
    std::copy(places.begin(), places.end(), places_.begin());
    while (position_size_ < std::min(axes, size_) && places[static_cast<std::size_t>(position_size_)] == position_size_)
      ++position_size_;
    if (position_size_ < axes) position_size_ = 0;
  }

  /// What a measurement tells of the position by itself, if all its axes were measured.
  std::optional<Gaussian<Eigen::Dynamic, 3>> position(const Gaussian<Eigen::Dynamic, MaxSize>& z) const {
    if (position_size_ == 0) return std::nullopt;
    return Gaussian<Eigen::Dynamic, 3>{z.mean.head(position_size_),
                                       z.covariance.topLeftCorner(position_size_, position_size_)};
  }

  /// Throws std::invalid_argument, naming the model, if it lacks one of the components.
  template <StateModel Model>
  RectangularMatrix<Eigen::Dynamic, Model::state_size, MaxSize, Model::max_state_size> measurement_matrix(
      const Model& model) const {
    RectangularMatrix<Eigen::Dynamic, Model::state_size, MaxSize, Model::max_state_size> H;
    H.setZero(size_, model.size());
    for (int i = 0; i < size_; ++i) {
      const int place = places_[static_cast<std::size_t>(i)];
      if (place < 0 || place >= model.size())
        throw std::invalid_argument("a sensor measures component " + std::to_string(place + 1) + ", but model '" +
                                    std::string(model.name()) + "' has " + std::to_string(model.size()));
      H(i, place) = 1.0;
    }
    return H;
  }

 private:
  std::array<int, std::size_t{MaxSize}> places_{};
  int size_;
  int position_size_ = 0;
};

/// A radar in its own space: range in m, azimuth counter-clockwise from x, and with three axes the elevation from the
/// x–y plane, in rad, of a target as seen from `origin`. Differences of azimuths are wrapped. The Jacobian does not
/// exist at the origin and, of the azimuth, above it.
template <int Axes>
class PolarSensor {
  static_assert(Axes == 2 || Axes == 3, "range and azimuth, or also elevation");

 public:
  static constexpr int axes = Axes;
  static constexpr int seen_size = Axes;
  static constexpr int measurement_size = Axes;

  explicit PolarSensor(const Vector<Axes>& origin = Vector<Axes>::Zero()) : origin_(origin) {}
  const Vector<Axes>& origin() const { return origin_; }

  template <class Scalar>
  Eigen::Matrix<Scalar, Axes, 1> measure(const Eigen::Matrix<Scalar, Axes, 1>& position) const {
    using std::atan2, std::sqrt;
    const Scalar x = position(0) - origin_(0);
    const Scalar y = position(1) - origin_(1);
    const Scalar ground = sqrt(Scalar(x * x + y * y));
    Eigen::Matrix<Scalar, Axes, 1> seen;
    seen(1) = atan2(y, x);
    if constexpr (Axes == 2) {
      seen(0) = ground;
    } else {
      const Scalar z = position(2) - origin_(2);
      seen(0) = sqrt(Scalar(x * x + y * y + z * z));
      seen(2) = atan2(z, ground);
    }
    return seen;
  }

  SquareMatrix<Axes> measurement_jacobian(const Vector<Axes>& position) const {
    const Vector<Axes> d = position - origin_;
    const double r = d.norm();
    const double ground_squared = d(0) * d(0) + d(1) * d(1);
    SquareMatrix<Axes> H = SquareMatrix<Axes>::Zero();
    H.row(0) = d.transpose() / r;
    H(1, 0) = -d(1) / ground_squared;
    H(1, 1) = d(0) / ground_squared;
    if constexpr (Axes == 3) {
      const double ground = std::sqrt(ground_squared);
      H.row(2) << -d(0) * d(2) / (r * r * ground), -d(1) * d(2) / (r * r * ground), ground / (r * r);
    }
    return H;
  }

  Vector<Axes> measurement_difference(const Vector<Axes>& z, const Vector<Axes>& predicted) const {
    Vector<Axes> difference = z - predicted;
    difference(1) = wrapped(difference(1));
    return difference;
  }

  /// What a measurement tells of the position: its unbiased conversion, which neglects correlations of its errors.
  Gaussian<Axes> position(const Gaussian<Axes>& z) const {
    Vector<3> seen = Vector<3>::Zero(), deviations = Vector<3>::Zero();
    seen.head<Axes>() = z.mean;
    deviations.head<Axes>() = z.covariance.diagonal().cwiseSqrt();
    const Gaussian<3> converted =
        to_cartesian({seen(0), seen(1), seen(2)}, {deviations(0), deviations(1), deviations(2)}, Conversion::unbiased);
    return {converted.mean.head<Axes>() + origin_, converted.covariance.topLeftCorner<Axes, Axes>()};
  }

  /// What a radar with these standard deviations measured; with two axes the elevation is ignored.
  static Gaussian<Axes> measurement(const Polar& measured, const Polar& sigma) {
    const Vector<3> z(measured.range, measured.azimuth, measured.elevation);
    const Vector<3> deviations(sigma.range, sigma.azimuth, sigma.elevation);
    return {z.head<Axes>(), deviations.head<Axes>().cwiseAbs2().asDiagonal()};
  }

 private:
  Vector<Axes> origin_;
};

/// Measures only the azimuth of a target, counter-clockwise from x in rad, as seen from `origin`. Differences are
/// wrapped. One such sensor that stands still does not tell the range.
class BearingSensor {
 public:
  static constexpr int axes = 2;
  static constexpr int seen_size = 2;
  static constexpr int measurement_size = 1;

  explicit BearingSensor(const Vector<2>& origin = Vector<2>::Zero()) : origin_(origin) {}
  const Vector<2>& origin() const { return origin_; }

  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 2, 1>& position) const {
    using std::atan2;
    const Scalar x = position(0) - origin_(0);
    const Scalar y = position(1) - origin_(1);
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(atan2(y, x)));
  }

  Eigen::RowVector2d measurement_jacobian(const Vector<2>& position) const {
    const Vector<2> d = position - origin_;
    return Eigen::RowVector2d(-d(1), d(0)) / d.squaredNorm();
  }

  Vector<1> measurement_difference(const Vector<1>& z, const Vector<1>& predicted) const {
    return Vector<1>(wrapped(z(0) - predicted(0)));
  }

 private:
  Vector<2> origin_;
};

}  // namespace sigmax
