#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/estimation/nonlinear_model.hpp>

namespace sigmax {

/// What measures the position of a target, whatever its motion, by its valid expressions. The position is the leading
/// components of the state.
///
///   Sensor::axes                      number of leading components that matter
///   Sensor::measurement_size          number of measured quantities, m
///   sensor.measure(position)          h, m
///   sensor.measurement_jacobian(position)  ∂h/∂position, m × axes. Optional, as for a NonlinearModel; the same holds
///   of sensor.measurement_difference(z, predicted) and sensor.measurement_mean(points, weights)
template <class Sensor>
concept PositionSensing = requires(const Sensor& sensor, const Vector<Sensor::axes>& position) {
  { sensor.measure(position) } -> MatrixOf<Sensor::measurement_size>;
  requires !requires { sensor.measurement_jacobian(position); }
  || requires {
    { sensor.measurement_jacobian(position) } -> MatrixOf<Sensor::measurement_size, Sensor::axes>;
  };
};

/// The model of a motion seen by a sensor: any motion, linear or not, with any sensor.
///
///     const Extended filter{Observed{dwna<3>(3.0), PolarSensor<3>{}}};
///
/// What the motion measures by itself, if anything, is of no account.
template <class Motion, PositionSensing Sensor>
  requires(LinearMotion<Motion> || NonlinearMotion<Motion>)
class Observed {
  static_assert(Motion::state_size == Eigen::Dynamic || Motion::state_size >= Sensor::axes,
                "the sensor measures more axes than the motion has states");

 public:
  static constexpr int state_size = Motion::state_size;
  static constexpr int max_state_size = Motion::max_state_size;
  static constexpr int measurement_size = Sensor::measurement_size;
  static constexpr int axes = Sensor::axes;
  static constexpr bool measures_leading_components = requires { requires Sensor::measures_leading_components; };

  using State = Vector<state_size, max_state_size>;
  using Matrix = SquareMatrix<state_size, max_state_size>;

  Observed(Motion motion, Sensor sensor) : motion_(std::move(motion)), sensor_(std::move(sensor)) {}

  const Motion& motion() const { return motion_; }
  const Sensor& sensor() const { return sensor_; }

  Eigen::Index size() const { return motion_.size(); }
  std::string_view name() const { return motion_.name(); }
  std::vector<std::string> components() const { return motion_.components(); }

  decltype(auto) process_covariance(double dt) const { return motion_.process_covariance(dt); }
  decltype(auto) transition(double dt) const requires(LinearMotion<Motion>) { return motion_.transition(dt); }
  decltype(auto) known_input(double dt) const requires(LinearMotion<Motion>) { return motion_.known_input(dt); }

  template <class Scalar>
  auto propagate(const Eigen::Matrix<Scalar, state_size, 1, 0, max_state_size, 1>& x, double dt) const {
    return detail::moved(motion_, x, dt);
  }
  Matrix transition_jacobian(const State& x, double dt) const { return detail::tangent(motion_, x, dt); }

  template <class Scalar>
  auto measure(const Eigen::Matrix<Scalar, state_size, 1, 0, max_state_size, 1>& x) const {
    return sensor_.measure(Eigen::Matrix<Scalar, axes, 1>(x.template head<axes>()));
  }
  RectangularMatrix<measurement_size, state_size, measurement_size, max_state_size> measurement_jacobian(
      const State& x) const {
    const Vector<axes> position = x.template head<axes>();
    RectangularMatrix<measurement_size, state_size, measurement_size, max_state_size> H;
    H.setZero(measurement_size, size());
    if constexpr (requires { sensor_.measurement_jacobian(position); })
      H.template leftCols<axes>() = sensor_.measurement_jacobian(position);
    else
      H.template leftCols<axes>() = jacobian<measurement_size, measurement_size, axes, axes>(
          [this](const DifferentiableVector<axes>& p) { return sensor_.measure(p); }, position);
    return H;
  }
  RectangularMatrix<measurement_size, state_size, measurement_size, max_state_size> measurement_matrix() const
      requires(measures_leading_components) {
    return RectangularMatrix<measurement_size, state_size, measurement_size, max_state_size>::Identity(measurement_size,
                                                                                                       size());
  }
  Vector<measurement_size> measurement_difference(const Vector<measurement_size>& z,
                                                  const Vector<measurement_size>& predicted) const {
    if constexpr (requires { sensor_.measurement_difference(z, predicted); })
      return sensor_.measurement_difference(z, predicted);
    else
      return z - predicted;
  }
  template <class Points, class Weights>
  Vector<measurement_size> measurement_mean(const Points& points, const Weights& weights) const
      requires(requires(const Sensor& sensor) { sensor.measurement_mean(points, weights); }) {
    return sensor_.measurement_mean(points, weights);
  }

 private:
  Motion motion_;
  Sensor sensor_;
};

/// Prediction by the motion's own, which may use its structure. `result` may be `prior`.
template <LinearMotion Motion, class Sensor>
void predict(const Observed<Motion, Sensor>& model, const EstimateOf<Motion>& prior, double dt,
             EstimateOf<Motion>& result) {
  predict(model.motion(), prior, dt, result);
}

}  // namespace sigmax
