#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include <sigmax/estimation/sensing.hpp>

namespace sigmax {

/// One of several sensors, chosen at run time, of any measured quantities: what a program has whose next row may be
/// anybody's. Nothing is allocated.
///
///     const AnySensor<PositionSensor<3>, PolarSensor<3>, BearingSensor> camera = BearingSensor{Vector<2>(0.0, 500.0)};
template <Sensing First, Sensing... Others>
class AnySensor {
  template <class Sensor>
  static constexpr bool is_one = std::is_same_v<Sensor, First> || (std::is_same_v<Sensor, Others> || ...);

 public:
  static constexpr int measurement_size = Eigen::Dynamic;
  static constexpr int max_measurement_size =
      std::max({detail::max_measurement_size_of<First>, detail::max_measurement_size_of<Others>...});
  using Measured = Vector<measurement_size, max_measurement_size>;

  template <class Sensor>
    requires(is_one<Sensor>)
  AnySensor(Sensor sensor) : sensor_(std::move(sensor)) {}

  /// @{
  /// As the sensor that it is.
  template <StateModel Model>
  Measured measure(const Model& model, const StateOf<Model>& x) const {
    return visit([&](const auto& sensor) -> Measured { return predicted_measurement(model, sensor, x); });
  }
  template <StateModel Model>
  RectangularMatrix<Eigen::Dynamic, Model::state_size, max_measurement_size, Model::max_state_size>
  measurement_jacobian(const Model& model, const StateOf<Model>& x) const {
    using Jacobian = RectangularMatrix<Eigen::Dynamic, Model::state_size, max_measurement_size, Model::max_state_size>;
    return visit([&](const auto& sensor) -> Jacobian { return sigmax::measurement_jacobian(model, sensor, x); });
  }
  Measured measurement_difference(const Measured& z, const Measured& predicted) const {
    return visit([&]<Sensing Sensor>(const Sensor& sensor) -> Measured {
      return sigmax::measurement_difference<Sensor>(sensor, z, predicted);
    });
  }
  template <class Points, class Weights>
  Measured measurement_mean(const Points& points, const Weights& weights) const {
    return visit([&](const auto& sensor) -> Measured { return sigmax::measurement_mean(sensor, points, weights); });
  }
  /// @}

  /// What a measurement tells of the position, if the sensor that it is can tell it by itself.
  std::optional<Gaussian<Eigen::Dynamic, 3>> position(const Gaussian<measurement_size, max_measurement_size>& z) const {
    return visit([&]<Sensing Sensor>(const Sensor& sensor) -> std::optional<Gaussian<Eigen::Dynamic, 3>> {
      if constexpr (requires(const MeasurementOf<Sensor>& own) { sensor.position(own); }) {
        const std::optional position = sensor.position(MeasurementOf<Sensor>{z.mean, z.covariance});
        if (position) return Gaussian<Eigen::Dynamic, 3>{position->mean, position->covariance};
        return std::nullopt;
      } else {
        return std::nullopt;
      }
    });
  }

  /// Calls `visitor(sensor)` with the sensor that it is.
  template <class Visitor>
  decltype(auto) visit(const Visitor& visitor) const {
    return std::visit(visitor, sensor_);
  }

 private:
  std::variant<First, Others...> sensor_;
};

}  // namespace sigmax
