#pragma once

#include <type_traits>
#include <utility>

#include <sigmax/estimation/model_ref.hpp>
#include <sigmax/estimation/sensing.hpp>

/// How compiled code asks a sensor of any type.
namespace sigmax::detail {

/// The functions of a sensor of models of one type; ∂h/∂x only if it is wanted.
template <class Sensor, class Model, bool Differentiates>
struct SensorFunctions {
  using Measured = MeasuredOf<Sensor>;

  static const Sensor& sensor(const void* pointer) { return *static_cast<const Sensor*>(pointer); }

  static int seen(const void* pointer) {
    if constexpr (requires { sensor(pointer).seen(); })
      return sensor(pointer).seen();
    else if constexpr (SeesLeading<Sensor>)
      return Sensor::seen_size;
    else
      return 0;
  }

  template <class Values>
  static void write_rows(const Values& values, int m, double* numbers) {
    require_measured(static_cast<int>(values.rows()), m);
    write<Values>(values, numbers);
  }

  /// Writes the predicted measurement z and its Jacobian H. A sensor of the model's whole state also takes the model.
  template <class Seen, class... Models>
  static void evaluate(const Sensor& own, const double* x, int n, int m, double* z, double* H,
                       const Models&... models) {
    if constexpr (requires { own.measurement_matrix(models...); }) {
      using Matrix = RectangularMatrix<Sensor::measurement_size, Seen::RowsAtCompileTime,
                                       max_measurement_size_of<Sensor>, Seen::MaxRowsAtCompileTime>;
      write_rows(Matrix(own.measurement_matrix(models...)), m, H);
    } else {
      const auto seen = read<Seen>(x, n);
      if (z) write_rows(Measured(own.measure(models..., seen)), m, z);
      if constexpr (Differentiates)
        if (H) write_rows(slope_of_sensor(own, seen, models...), m, H);
    }
  }

  static void measure(const void* pointer, const void* model, const double* x, int n, int m, double* z, double* H) {
    const Sensor& own = sensor(pointer);
    if constexpr (Sensor::measurement_size != Eigen::Dynamic) require_measured(Sensor::measurement_size, m);
    if constexpr (ComputesItself<Sensor>) {
      own.compute(x, m, z, H);
    } else if constexpr (SeesLeading<Sensor>) {
      evaluate<Vector<Sensor::seen_size>>(own, x, Sensor::seen_size, m, z, H);
    } else {
      evaluate<StateOf<Model>>(own, x, n, m, z, H, *static_cast<const Model*>(model));
    }
  }

  static void difference(const void* pointer, const double* z, const double* predicted, int m, int count,
                         double* result) {
    if constexpr (requires { sensor(pointer).compute_difference(z, predicted, count, result); }) {
      sensor(pointer).compute_difference(z, predicted, count, result);
    } else {
      const auto from = read<Measured>(predicted, m);
      for (int i = 0; i < count; ++i)
        write<Measured>(sensor(pointer).measurement_difference(read<Measured>(z + i * m, m), from), result + i * m);
    }
  }

  static void mean(const void* pointer, const double* points, const double* weights, int m, int count, double* result) {
    const Eigen::Map<const RectangularMatrix<Sensor::measurement_size, Eigen::Dynamic>> columns(points, m, count);
    const Eigen::Map<const Eigen::VectorXd> each(weights, count);
    write<Measured>(sensor(pointer).measurement_mean(columns, each), result);
  }

  static constexpr bool has_difference = requires(const Sensor& own, const Measured& z) {
    own.measurement_difference(z, z);
  };
};

template <class Sensor, class Model, bool Differentiates>
inline constexpr SensorTable sensor_table = [] {
  using Functions = SensorFunctions<Sensor, Model, Differentiates>;
  SensorTable table{measures_leading_components<Sensor>, LinearSensorOf<Sensor, Model>, Functions::seen};
  if constexpr (!measures_leading_components<Sensor>) table.measure = Functions::measure;
  if constexpr (Functions::has_difference) table.difference = Functions::difference;
  if constexpr (requires(const Sensor& own, const Eigen::MatrixXd& points, const Eigen::VectorXd& weights) {
                  own.measurement_mean(points, weights);
                })
    table.mean = Functions::mean;
  return table;
}();

/// What a sensor is asked with: the motion of a member, else the model.
template <class Model>
const auto& asked(const Model& model) {
  if constexpr (requires { typename Model::MotionType; })
    return model.motion();
  else
    return model;
}
template <class Model>
using AskedAs = std::remove_cvref_t<decltype(asked(std::declval<const Model&>()))>;

/// The functions that filters of a model ask for: those with sigma points do not differentiate h.
template <class Sensor, class Model>
inline constexpr const SensorTable* table_for = &sensor_table<Sensor, AskedAs<Model>, !UsesPoints<Model>>;

/// A sensor as compiled code sees it, of this model.
template <class Sensor, class Model>
SensorRef sensor_ref(const Sensor& sensor, const Model& model) {
  if constexpr (requires { sensor.ref_for(model); })
    return sensor.ref_for(model);
  else
    return {&sensor, table_for<Sensor, Model>, &asked(model)};
}

}  // namespace sigmax::detail
