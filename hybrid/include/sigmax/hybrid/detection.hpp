#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include <sigmax/estimation/any_sensor.hpp>

namespace sigmax {

/// A detection at one time: a measurement with the sensor that made it, or a missed measurement. The tag, the
/// number of a row say, comes back with what the detection leads to.
class Detection {
 public:
  double time;  ///< in s
  std::size_t tag = 0;

  /// There was no measurement.
  explicit Detection(double t = 0.0, std::size_t number = 0) : time(t), tag(number) {}

  template <Sensing Sensor>
  Detection(double t, const MeasurementOf<Sensor>& z, const Sensor& sensor, std::size_t number = 0)
      : Detection(t, detail::view(z), sensor, number) {}

  template <Sensing Sensor>
  Detection(double t, const MeasuredBy<Sensor>& measured, std::size_t number = 0)
      : Detection(t, measured.z, measured.sensor, number) {}

  /// A position along as many axes as z has.
  template <int N, int MaxN>
    requires(MaxN <= 3)
  Detection(double t, const Gaussian<N, MaxN>& z, std::size_t number = 0)
      : Detection(t, detail::view(z), detail::position_sensor(static_cast<int>(z.size())), number) {}

  /// The same with numbers.
  Detection(double t, detail::ConstView z, AnySensor sensor, std::size_t number = 0)
      : time(t), tag(number), size_(z.n), sensor_(std::move(sensor)) {
    std::copy_n(z.mean, size_, z_.begin());
    std::copy_n(z.covariance, size_ * size_, covariance_.begin());
  }

  bool seen() const { return sensor_.has_value(); }
  /// The measurement with its covariance, and its sensor. Valid only if there was a measurement.
  detail::ConstView measurement() const { return {z_.data(), covariance_.data(), size_}; }
  const AnySensor& sensor() const { return *sensor_; }

  /// The position that the measurement alone determines, for a start; nothing if the sensor has none along so many
  /// axes. Eigen::Dynamic is any number of axes.
  template <int Axes>
  std::optional<Gaussian<Axes, Axes == Eigen::Dynamic ? 3 : Axes>> position() const {
    Gaussian<3> room;
    const int axes = seen() ? sensor_->position(measurement(), room.mean.data(), room.covariance.data()) : 0;
    if (axes == 0 || (Axes != Eigen::Dynamic && axes != Axes)) return std::nullopt;
    Gaussian<Axes, Axes == Eigen::Dynamic ? 3 : Axes> result;
    const detail::View numbers = detail::sized_view(result, axes);
    std::copy_n(room.mean.data(), axes, numbers.mean);
    std::copy_n(room.covariance.data(), axes * axes, numbers.covariance);
    return result;
  }

 private:
  int size_ = 0;
  std::array<double, max_measurement_size> z_{};
  std::array<double, max_measurement_size * max_measurement_size> covariance_{};
  std::optional<AnySensor> sensor_;
};

/// Where a target starts: estimates, of all models together or one each, and their time. `from_detections` says that
/// the detections that waited are in them; otherwise those are taken as measurements after the start.
template <class Estimates>
struct StartAt {
  double time;
  Estimates estimates;
  bool from_detections = true;
};

}  // namespace sigmax
