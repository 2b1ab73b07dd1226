#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/unscented.hpp>

namespace sigmax {

/// A member of the Kalman family over a motion, chosen at run time. Linear motions predict, and linear sensors update,
/// as the Kalman filter does whatever the member is.
template <Motion Moves>
class AnyMember {
 public:
  using MotionType = Moves;
  static constexpr int state_size = Moves::state_size;
  static constexpr int max_state_size = Moves::max_state_size;
  static constexpr int axes = axes_of<Moves>;

  AnyMember(Extended<Moves> member) : member_(std::move(member)) {}
  AnyMember(Unscented<Moves> member) : member_(std::move(member)) {}
  AnyMember(Cubature<Moves> member) : member_(std::move(member)) {}

  Eigen::Index size() const { return motion().size(); }
  std::string_view name() const { return motion().name(); }
  std::vector<std::string> components() const { return motion().components(); }
  const Moves& motion() const {
    return visit([](const auto& member) -> const Moves& { return member.motion(); });
  }

  /// Calls `visitor(member)` with the member that it is.
  template <class Visitor>
  decltype(auto) visit(const Visitor& visitor) const {
    return std::visit(visitor, member_);
  }

 private:
  std::variant<Extended<Moves>, Unscented<Moves>, Cubature<Moves>> member_;
};

namespace detail {

/// Whether a sensor is one of several, chosen at run time: AnySensor.
template <class Sensor>
concept ChosenSensor = requires(const Sensor& sensor) {
  sensor.visit([](const auto&) {});
};

}  // namespace detail

/// @{
/// As the member that it is. `result` and `posterior` may be `prior`.
template <Motion Moves>
void predict(const AnyMember<Moves>& any, const EstimateOf<Moves>& prior, double dt, EstimateOf<Moves>& result) {
  any.visit([&](const auto& member) { predict(member, prior, dt, result); });
}
template <Motion Moves>
StateMatrixOf<Moves> prediction_covariance(const AnyMember<Moves>& any, const EstimateOf<Moves>& prior, double dt) {
  return any.visit([&](const auto& member) { return prediction_covariance(member, prior, dt); });
}
template <Motion Moves, SensorOf<AnyMember<Moves>> Sensor>
InnovationOf<Sensor> update(const AnyMember<Moves>& any, const EstimateOf<Moves>& prior,
                            const MeasurementOf<Sensor>& measurement, const Sensor& sensor,
                            EstimateOf<Moves>& posterior) {
  if constexpr (LinearSensorOf<Sensor, Moves>) {
    return update(any.motion(), prior, measurement, sensor, posterior);
  } else if constexpr (detail::ChosenSensor<Sensor>) {
    const auto update_as = [&]<Sensing Chosen>(const Chosen& chosen) {
      if constexpr (LinearSensorOf<Chosen, Moves>)
        return InnovationOf<Sensor>(
            update(any.motion(), prior, {measurement.mean, measurement.covariance}, chosen, posterior));
      else
        return any.visit([&](const auto& member) { return update(member, prior, measurement, sensor, posterior); });
    };
    return sensor.visit(update_as);
  } else {
    return any.visit([&](const auto& member) { return update(member, prior, measurement, sensor, posterior); });
  }
}
/// @}

}  // namespace sigmax
