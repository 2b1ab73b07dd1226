#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/sensing.hpp>

namespace sigmax {

/// Measures the position itself, H = [I 0], in m.
template <int Axes>
struct PositionSensor {
  static constexpr int axes = Axes;
  static constexpr int seen_size = Axes;
  static constexpr int measurement_size = Axes;
  static constexpr bool measures_leading_components = true;

  Vector<Axes> measure(const Vector<Axes>& position) const { return position; }

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
  static constexpr bool is_linear = true;
  using ComputedBy = ComponentSensor;

  /// Their places in the state of every model, in which the position and its derivatives lead. If the number of axes is
  /// told, and the first places are those of the position, in order, a target can start from it. Throws
  /// std::invalid_argument for none, more than `MaxSize`, or a place that is negative.
  explicit ComponentSensor(std::span<const int> places, int axes = 0) : size_(static_cast<int>(places.size())) {
    if (places.empty() || size_ > MaxSize)
      throw std::invalid_argument("a sensor of " + std::to_string(places.size()) + " components; expected 1 to " +
                                  std::to_string(MaxSize));
    std::copy(places.begin(), places.end(), places_.begin());
    for (const int place : places) {
      if (place < 0) throw std::invalid_argument("a sensor measures component " + std::to_string(place + 1));
      seen_ = std::max(seen_, place + 1);
    }
    while (position_size_ < std::min(axes, size_) && places[static_cast<std::size_t>(position_size_)] == position_size_)
      ++position_size_;
    if (position_size_ < axes) position_size_ = 0;
  }

  /// What a measurement tells of the position by itself, if all its axes were measured. Throws std::invalid_argument
  /// for a measurement of another number of quantities.
  std::optional<Gaussian<Eigen::Dynamic, 3>> position(const Gaussian<Eigen::Dynamic, MaxSize>& z) const {
    if (position_size_ == 0) return std::nullopt;
    detail::require_measured(size_, static_cast<int>(z.size()));
    return Gaussian<Eigen::Dynamic, 3>{z.mean.head(position_size_),
                                       z.covariance.topLeftCorner(position_size_, position_size_)};
  }

  /// How many leading components it sees, and H over them, for so many measured quantities as there are places.
  int seen() const { return seen_; }
  void compute(const double*, int m, double*, double* H) const {
    detail::require_measured(size_, m);
    std::fill_n(H, m * seen_, 0.0);
    for (int i = 0; i < m; ++i) H[i + places_[static_cast<std::size_t>(i)] * m] = 1.0;
  }

 private:
  std::array<int, std::size_t{MaxSize}> places_{};
  int size_;
  int seen_ = 0;
  int position_size_ = 0;
};

namespace detail {

/// Base of radars at one place; their second quantity is the azimuth.
template <class Sensor, int Axes, int M, int Seen>
class RadarSensor : public ComputedSensor<Sensor, M, Seen> {
  static_assert(Axes == 2 || Axes == 3, "range and azimuth, or also elevation");

 public:
  static constexpr int axes = Axes;

  explicit RadarSensor(const Vector<Axes>& origin = Vector<Axes>::Zero()) : origin_(numbers_of(origin)) {}
  Vector<Axes> origin() const { return Vector<Axes>(origin_.data()); }

  Vector<M> measurement_difference(const Vector<M>& z, const Vector<M>& predicted) const {
    Vector<M> difference;
    compute_difference(z.data(), predicted.data(), 1, difference.data());
    return difference;
  }
  void compute_difference(const double* z, const double* predicted, int count, double* result) const {
    polar_difference(z, predicted, M, count, result);
  }

  /// What a measurement tells of the position: its unbiased conversion, which neglects correlations of its errors.
  Gaussian<Axes> position(const Gaussian<M>& z) const {
    Gaussian<Axes> result;
    position_of_polar(Axes, origin_.data(), z.mean.data(), z.covariance.data(), M, result.mean.data(),
                      result.covariance.data());
    return result;
  }

 protected:
  std::array<double, std::size_t{Axes}> origin_;
};

}  // namespace detail

/// A radar in its own space, at `origin`. It measures the range in m and the azimuth in rad, counter-clockwise from x;
/// with three axes also the elevation in rad, from the x–y plane. Differences of azimuths are wrapped. The Jacobian
/// does not exist at the origin and, of the azimuth, above it.
template <int Axes>
class PolarSensor : public detail::RadarSensor<PolarSensor<Axes>, Axes, Axes, Axes> {
 public:
  using detail::RadarSensor<PolarSensor, Axes, Axes, Axes>::RadarSensor;

  /// What this radar measured, with these standard deviations; with two axes the elevation is ignored.
  MeasuredBy<PolarSensor> measurement(const Polar& measured, const Polar& sigma) const {
    const auto z = detail::numbers_of(measured), deviations = detail::numbers_of(sigma);
    return {{Vector<Axes>(z.data()), Vector<Axes>(deviations.data()).array().square().matrix().asDiagonal()}, *this};
  }

  void compute(const double* position, int, double* z, double* H) const {
    detail::polar(Axes, this->origin_.data(), position, z, H);
  }
};

/// A radar in space that measures no elevation: the slant range and the azimuth. By itself it tells no position.
class SlantSensor : public detail::RadarSensor<SlantSensor, 3, 2, 3> {
 public:
  using RadarSensor::RadarSensor;

  Gaussian<3> position(const Gaussian<2>& z) const = delete;

  void compute(const double* position, int, double* z, double* H) const {
    detail::slant(origin_.data(), position, z, H);
  }
};

/// Measures only the azimuth of a target, counter-clockwise from x in rad, as seen from `origin`. Differences are
/// wrapped. One such sensor that stands still does not tell the range.
class BearingSensor : public detail::ComputedSensor<BearingSensor, 1, 2> {
 public:
  static constexpr int axes = 2;

  explicit BearingSensor(const Vector<2>& origin = Vector<2>::Zero()) : origin_(detail::numbers_of(origin)) {}
  Vector<2> origin() const { return Vector<2>(origin_.data()); }

  /// What this sensor measured, with this standard deviation.
  MeasuredBy<BearingSensor> measurement(Angle azimuth, Angle sigma) const {
    return {{Vector<1>(azimuth.radians()), SquareMatrix<1>(sigma.radians() * sigma.radians())}, *this};
  }

  Vector<1> measurement_difference(const Vector<1>& z, const Vector<1>& predicted) const {
    return Vector<1>(wrapped(z(0) - predicted(0)));
  }

  void compute(const double* position, int, double* z, double* H) const {
    detail::bearing(origin_.data(), position, z, H);
  }

 private:
  std::array<double, 2> origin_;
};

}  // namespace sigmax
