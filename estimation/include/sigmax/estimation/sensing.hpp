#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
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

class AnySensor;

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

/// What a sensor of M quantities and so many leading components shows, if the library computes it: compute(x, m, z, H),
/// see sensor_ref.hpp.
template <class Sensor, int M, int Seen>
class ComputedSensor {
 public:
  using ComputedBy = Sensor;
  static constexpr int seen_size = Seen;
  static constexpr int measurement_size = M;

  Vector<M> measure(const Vector<Seen>& x) const {
    Vector<M> z;
    static_cast<const Sensor&>(*this).compute(x.data(), M, z.data(), nullptr);
    return z;
  }
  RectangularMatrix<M, Seen> measurement_jacobian(const Vector<Seen>& x) const {
    RectangularMatrix<M, Seen> H;
    static_cast<const Sensor&>(*this).compute(x.data(), M, nullptr, H.data());
    return H;
  }
};

template <int N>
std::array<double, std::size_t{N}> numbers_of(const Vector<N>& vector) {
  std::array<double, std::size_t{N}> numbers;
  std::copy_n(vector.data(), N, numbers.data());
  return numbers;
}

/// Throws std::invalid_argument unless a sensor of so many quantities got as many.
inline void require_measured(int own, int m) {
  if (own != m)
    throw std::invalid_argument("a measurement of " + std::to_string(m) + " quantities by a sensor of " +
                                std::to_string(own));
}

/// Whether a model may have as many components as a sensor sees, and as many axes.
template <class Sensor, class Model>
concept SeenOf = (axes_of<Model> == 0 ||
                  axes_of<Sensor> <= axes_of<Model>)&&(!SeesLeading<Sensor> || Model::state_size == Eigen::Dynamic ||
                                                       requires { requires Sensor::seen_size <= Model::state_size; });

/// Holds if the sensor has a measurement matrix, or a function, of the right shape, and so its Jacobian and difference,
/// if there are any. A sensor of the model's whole state also takes the model.
template <class Sensor, class Seen, class... Models>
concept MeasuresFrom = requires(const Sensor& sensor, const Models&... models) {
  { sensor.measurement_matrix(models...) } -> MatrixOf<Sensor::measurement_size, Seen::RowsAtCompileTime>;
}
|| requires(const Sensor& sensor, const Seen& x,
            const Vector<Sensor::measurement_size, max_measurement_size_of<Sensor>>& z, const Models&... models) {
  { sensor.measure(models..., x) } -> MatrixOf<Sensor::measurement_size>;
  requires !requires { sensor.measurement_jacobian(models..., x); }
  || requires {
    { sensor.measurement_jacobian(models..., x) } -> MatrixOf<Sensor::measurement_size, Seen::RowsAtCompileTime>;
  };
  requires !requires { sensor.measurement_difference(z, z); }
  || requires {
    { sensor.measurement_difference(z, z) } -> MatrixOf<Sensor::measurement_size>;
  };
};

}  // namespace detail

/// What a sensor measures, with its R.
template <Sensing Sensor>
using MeasurementOf = Gaussian<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>>;

/// A measurement z with its covariance R, and the sensor that made it; `update` and `step` take it.
///
///     const auto seen = PolarSensor<2>{radar}.measurement({5e3, degrees(40)}, {10.0, degrees(0.1)});
///     filter.step(1.0, seen);
///     filter.step(0.5, MeasuredBy{Gaussian<1>{…}, Speedometer{}});   // of a sensor of your own
template <class Sensor>  // a sensor returns it before its own class is complete, and g++ would not see that it is one
struct MeasuredBy {
  MeasurementOf<Sensor> z;
  Sensor sensor;
};
template <Sensing Sensor>
MeasuredBy(MeasurementOf<Sensor>, Sensor) -> MeasuredBy<Sensor>;

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
/// another size do not compile. A sensor either says how many leading components of the state it sees, and is models
/// with these alone whatever the model, or it is models with the model and its whole state:
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
    measures_leading_components<Sensor> || detail::ComputesItself<Sensor> || std::same_as<Sensor, AnySensor> ||
    requires { requires detail::MeasuresFrom<Sensor, Vector<Sensor::seen_size>>; } ||
    requires { requires detail::MeasuresFrom<Sensor, StateOf<Model>, Model>; });

/// A sensor whose h is a matrix for this model.
template <class Sensor, class Model>
concept LinearSensorOf = SensorOf<Sensor, Model> &&(
    measures_leading_components<Sensor> || requires { requires Sensor::is_linear; } ||
    requires(const Sensor& sensor) { sensor.measurement_matrix(); } ||
    requires(const Sensor& sensor, const Model& model) { sensor.measurement_matrix(model); });

namespace detail {

/// ∂h/∂x over what a sensor sees, as it gives it, else by automatic differentiation.
template <class Sensor, int N, int MaxN, class... Model>
RectangularMatrix<Sensor::measurement_size, N, max_measurement_size_of<Sensor>, MaxN> slope_of_sensor(
    const Sensor& sensor, const Vector<N, MaxN>& x, const Model&... models) {
  if constexpr (requires { sensor.measurement_jacobian(models..., x); })
    return sensor.measurement_jacobian(models..., x);
  else
    return jacobian<Sensor::measurement_size, max_measurement_size_of<Sensor>>(
        [&](const DifferentiableVector<N, MaxN>& variables) { return sensor.measure(models..., variables); }, x);
}

}  // namespace detail

}  // namespace sigmax
