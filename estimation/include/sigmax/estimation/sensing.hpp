#pragma once

#include <concepts>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/jacobian.hpp>
#include <sigmax/estimation/model.hpp>

namespace sigmax {

/// What every sensor says of its measurements, z = h(x) + v, (22) or (48); the measurement brings the covariance of v.
///
///   Sensor::measurement_size  number of measured quantities, m, or Eigen::Dynamic with at most
///                             Sensor::max_measurement_size
template <class Sensor>
concept Sensing = requires {
  { Sensor::measurement_size } -> std::convertible_to<int>;
};

namespace detail {

template <class Sensor>
inline constexpr int max_measurement_size_of = [] {
  if constexpr (Sensor::measurement_size == Eigen::Dynamic)
    return Sensor::max_measurement_size;
  else
    return Sensor::measurement_size;
}();

/// Whether a sensor sees only leading components of the state, whatever the model.
template <class Sensor>
concept SeesLeading = requires {
  { Sensor::seen_size } -> std::convertible_to<int>;
};

/// Whether a model may have as many components as a sensor sees, and as many axes.
template <class Sensor, class Model>
concept SeenOf = (axes_of<Model> == 0 ||
                  axes_of<Sensor> <= axes_of<Model>)&&(!SeesLeading<Sensor> || Model::state_size == Eigen::Dynamic ||
                                                       requires { requires Sensor::seen_size <= Model::state_size; });

/// Whether the Jacobian that a sensor gives, if it gives one, is of the right shape.
template <class Sensor, int Columns, class... Asked>
concept JacobianFits = !requires(const Sensor& sensor, const Asked&... asked) {
  sensor.measurement_jacobian(asked...);
}
|| requires(const Sensor& sensor, const Asked&... asked) {
  { sensor.measurement_jacobian(asked...) } -> MatrixOf<Sensor::measurement_size, Columns>;
};

/// The same of the difference.
template <class Sensor, class Measured = Vector<Sensor::measurement_size, max_measurement_size_of<Sensor>>>
concept DifferenceFits = !requires(const Sensor& sensor, const Measured& z) {
  sensor.measurement_difference(z, z);
}
|| requires(const Sensor& sensor, const Measured& z) {
  { sensor.measurement_difference(z, z) } -> MatrixOf<Sensor::measurement_size>;
};

/// Throws std::invalid_argument, naming the model, if a sensor sees more components than the model has now.
template <class Sensor, class Model>
void require_seen([[maybe_unused]] const Model& model) {
  if constexpr (Model::state_size == Eigen::Dynamic)
    if (model.size() < Sensor::seen_size)
      throw std::invalid_argument("a sensor sees " + std::to_string(Sensor::seen_size) + " components, but model '" +
                                  std::string(model.name()) + "' has " + std::to_string(model.size()));
}

/// Calls `ask` with what a sensor's functions take: the leading components that it sees, or the model and the state.
template <class Sensor, class Model, class Scalar, class Ask>
decltype(auto) asked(const Model& model,
                     const Eigen::Matrix<Scalar, Model::state_size, 1, 0, Model::max_state_size, 1>& x,
                     const Ask& ask) {
  if constexpr (SeesLeading<Sensor>) {
    require_seen<Sensor>(model);
    const Eigen::Matrix<Scalar, Sensor::seen_size, 1> seen = x.template head<Sensor::seen_size>();
    return ask(seen);
  } else {
    return ask(model, x);
  }
}

}  // namespace detail

/// What a sensor measures, with its R.
template <Sensing Sensor>
using MeasurementOf = Gaussian<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>>;

/// A vector of measured quantities.
template <Sensing Sensor>
using MeasuredOf = Vector<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>>;

/// ∂h/∂x, m × n.
template <class Sensor, class Model>
using MeasurementMatrixOf = RectangularMatrix<Sensor::measurement_size, Model::state_size,
                                              detail::max_measurement_size_of<Sensor>, Model::max_state_size>;

/// Whether a sensor measures the first components and nothing else, H = [I 0]; the Kalman filter then skips the zeros.
template <class Sensor>
inline constexpr bool measures_leading_components = requires {
  requires Sensor::measures_leading_components;
};

/// A sensor that can measure the state of this model, by its valid expressions; no base class is needed. Functions of
/// another size do not compile. A sensor either says how many leading components of the state it sees, and is asked
/// with these alone whatever the model, or it is asked with the model and its whole state:
///
///   Sensor::seen_size                number of leading components seen; x below is then these
///   sensor.measure(x)                h, m;  or sensor.measure(model, x)
///   sensor.measurement_jacobian(x)   ∂h/∂x, m × seen_size;  or (model, x), m × n. Optional: if it is absent and a
///                                    filter wants it, `measure` must take any scalar type and is differentiated
///   sensor.measurement_difference(z, predicted)  z − predicted, m. Optional: wraps angles
///   sensor.measurement_mean(points, weights)  the weighted mean of measurements, a column each. Optional: by default
///                                    z₀ + Σ wᵢ (zᵢ − z₀) with the difference above, right for angles less than half a
///                                    turn apart
///
/// A linear sensor gives instead of all this its matrix:
///
///   sensor.measurement_matrix()      H, m × seen_size;  or (model), m × n
template <class Sensor, class Model>
concept SensorOf = Sensing<Sensor> && StateModel<Model> && detail::SeenOf<Sensor, Model> &&(
    measures_leading_components<Sensor> ||
    requires(const Sensor& sensor, const Vector<Sensor::seen_size>& seen) {
      { sensor.measurement_matrix() } -> MatrixOf<Sensor::measurement_size, Sensor::seen_size>;
    } ||
    requires(const Sensor& sensor, const Model& model) {
      { sensor.measurement_matrix(model) } -> MatrixOf<Sensor::measurement_size, Model::state_size>;
    } ||
    requires(const Sensor& sensor, const Vector<Sensor::seen_size>& seen) {
      { sensor.measure(seen) } -> MatrixOf<Sensor::measurement_size>;
      requires detail::DifferenceFits<Sensor> &&
          detail::JacobianFits<Sensor, Sensor::seen_size, Vector<Sensor::seen_size>>;
    } ||
    requires(const Sensor& sensor, const Model& model, const StateOf<Model>& x) {
      { sensor.measure(model, x) } -> MatrixOf<Sensor::measurement_size>;
      requires detail::DifferenceFits<Sensor> && detail::JacobianFits<Sensor, Model::state_size, Model, StateOf<Model>>;
    });

/// A sensor whose h is a matrix for this model.
template <class Sensor, class Model>
concept LinearSensorOf = SensorOf<Sensor, Model> &&(
    measures_leading_components<Sensor> || requires(const Sensor& sensor) { sensor.measurement_matrix(); } ||
    requires(const Sensor& sensor, const Model& model) { sensor.measurement_matrix(model); });

namespace detail {

/// Returns the value. Throws std::domain_error, naming the function, the model and the state, unless it is finite.
template <class Value, class Model>
const Value& require_finite(const Value& value, const char* function, const Model& model, const StateOf<Model>& x) {
  if (value.allFinite()) return value;
  std::string message = std::string(function) + " of model '" + std::string(model.name()) + "' is not finite at x = (";
  for (Eigen::Index i = 0; i < x.size(); ++i) message += (i == 0 ? "" : ", ") + std::to_string(x(i));
  throw std::domain_error(message + ")");
}

/// A matrix over the leading components of a state as one over all of it.
template <class Sensor, class Model, class Leading>
MeasurementMatrixOf<Sensor, Model> over_all_components(const Model& model, const Leading& H) {
  require_seen<Sensor>(model);
  MeasurementMatrixOf<Sensor, Model> result;
  result.setZero(H.rows(), model.size());
  result.leftCols(H.cols()) = H;
  return result;
}

}  // namespace detail

/// H of a linear sensor, m × n.
template <StateModel Model, LinearSensorOf<Model> Sensor>
MeasurementMatrixOf<Sensor, Model> measurement_matrix(const Model& model, const Sensor& sensor) {
  if constexpr (measures_leading_components<Sensor>)
    return MeasurementMatrixOf<Sensor, Model>::Identity(Sensor::measurement_size, model.size());
  else if constexpr (detail::SeesLeading<Sensor>)
    return detail::over_all_components<Sensor>(model, sensor.measurement_matrix());
  else
    return sensor.measurement_matrix(model);
}

/// h(x), (22). Throws std::domain_error unless it is finite.
template <StateModel Model, SensorOf<Model> Sensor>
MeasuredOf<Sensor> predicted_measurement(const Model& model, const Sensor& sensor, const StateOf<Model>& x) {
  return detail::require_finite(
      [&]() -> MeasuredOf<Sensor> {
        if constexpr (LinearSensorOf<Sensor, Model>)
          return measurement_matrix(model, sensor) * x;
        else
          return detail::asked<Sensor>(
              model, x, [&](const auto&... seen) { return MeasuredOf<Sensor>(sensor.measure(seen...)); });
      }(),
      "h(x)", model, x);
}

namespace detail {

/// ∂h/∂x over the leading components that a sensor sees.
template <class Sensor, int Seen>
auto leading_jacobian(const Sensor& sensor, const Vector<Seen>& seen) {
  constexpr int M = Sensor::measurement_size;
  constexpr int max_M = max_measurement_size_of<Sensor>;
  if constexpr (requires { sensor.measurement_jacobian(seen); })
    return RectangularMatrix<M, Seen, max_M, Seen>(sensor.measurement_jacobian(seen));
  else
    return jacobian<M, max_M, Seen, Seen>(
        [&](const DifferentiableVector<Seen>& components) { return sensor.measure(components); }, seen);
}

}  // namespace detail

/// ∂h/∂x as the sensor gives it, else by automatic differentiation; of a linear sensor H. Throws std::domain_error
/// unless it is finite.
template <StateModel Model, SensorOf<Model> Sensor>
MeasurementMatrixOf<Sensor, Model> measurement_jacobian(const Model& model, const Sensor& sensor,
                                                        const StateOf<Model>& x) {
  const auto jacobian_at = [&]() -> MeasurementMatrixOf<Sensor, Model> {
    if constexpr (LinearSensorOf<Sensor, Model>)
      return measurement_matrix(model, sensor);
    else if constexpr (detail::SeesLeading<Sensor>)
      return detail::asked<Sensor>(model, x, [&](const auto& seen) {
        return detail::over_all_components<Sensor>(model, detail::leading_jacobian(sensor, seen));
      });
    else if constexpr (requires { sensor.measurement_jacobian(model, x); })
      return sensor.measurement_jacobian(model, x);
    else
      return jacobian<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>, Model::state_size,
                      Model::max_state_size>(
          [&](const DifferentiableVector<Model::state_size, Model::max_state_size>& state) {
            return sensor.measure(model, state);
          },
          x);
  };
  return detail::require_finite(jacobian_at(), "the Jacobian of h", model, x);
}

namespace detail {

/// ∂h/∂x over the leading components that a sensor sees, by which alone h changes, or over all. Throws
/// std::domain_error unless it is finite.
template <StateModel Model, SensorOf<Model> Sensor>
auto jacobian_of_seen(const Model& model, const Sensor& sensor, const StateOf<Model>& x) {
  if constexpr (SeesLeading<Sensor> && !LinearSensorOf<Sensor, Model>)
    return require_finite(asked<Sensor>(model, x, [&](const auto& seen) { return leading_jacobian(sensor, seen); }),
                          "the Jacobian of h", model, x);
  else
    return measurement_jacobian(model, sensor, x);
}

}  // namespace detail

/// z − predicted, by the sensor's own difference if it has one.
template <Sensing Sensor>
MeasuredOf<Sensor> measurement_difference(const Sensor& sensor, const MeasuredOf<Sensor>& z,
                                          const MeasuredOf<Sensor>& predicted) {
  if constexpr (requires { sensor.measurement_difference(z, predicted); })
    return sensor.measurement_difference(z, predicted);
  else
    return z - predicted;
}

/// The mean of measurements, a column each, with weights that sum to one: the sensor's own if it has one.
template <Sensing Sensor, class Points, class Weights>
MeasuredOf<Sensor> measurement_mean(const Sensor& sensor, const Points& points, const Weights& weights) {
  if constexpr (requires { sensor.measurement_mean(points, weights); }) {
    return sensor.measurement_mean(points, weights);
  } else {
    const MeasuredOf<Sensor> first = points.col(0);
    MeasuredOf<Sensor> mean = first;
    for (Eigen::Index i = 1; i < points.cols(); ++i)
      mean += weights(i) * measurement_difference<Sensor>(sensor, points.col(i), first);
    return mean;
  }
}

}  // namespace sigmax
