#pragma once

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
    write<typename Values::PlainObject>(values, numbers);
  }

  static void measure(const void* pointer, const void* model, const double* x, int n, int m, double* z, double* H) {
    const Sensor& own = sensor(pointer);
    if constexpr (Sensor::measurement_size != Eigen::Dynamic) require_measured(Sensor::measurement_size, m);
    if constexpr (ComputesItself<Sensor>) {
      own.compute(x, m, z, H);
    } else if constexpr (requires { own.measurement_matrix(); }) {
      write_rows(own.measurement_matrix(), m, H);
    } else if constexpr (SeesLeading<Sensor>) {
      const auto seen = read<Vector<Sensor::seen_size>>(x, Sensor::seen_size);
      if (z) write_rows(Measured(own.measure(seen)), m, z);
      if constexpr (Differentiates)
        if (H) write_rows(leading_jacobian(own, seen), m, H);
    } else {
      const Model& asked = *static_cast<const Model*>(model);
      if constexpr (requires { own.measurement_matrix(asked); }) {
        write_rows(MeasurementMatrixOf<Sensor, Model>(own.measurement_matrix(asked)), m, H);
      } else {
        const auto state = read<StateOf<Model>>(x, n);
        if (z) write_rows(Measured(own.measure(asked, state)), m, z);
        if constexpr (Differentiates)
          if (H) write_rows(whole_jacobian(own, asked, state), m, H);
      }
    }
  }

  static void difference(const void* pointer, const double* z, const double* predicted, int m, double* result) {
    write<Measured>(sensor(pointer).measurement_difference(read<Measured>(z, m), read<Measured>(predicted, m)), result);
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

/// Whether filters of a model differentiate h: those that do not use sigma points.
template <class Model>
inline constexpr bool differentiates = !requires(const Model& model) {
  model.weights();
};

/// The type of a model that a sensor is asked with: the motion of a member.
template <class Model>
struct AskedAs {
  using type = Model;
  static const Model& of(const Model& model) { return model; }
};
template <class Model>
  requires requires { typename Model::MotionType; }
struct AskedAs<Model> {
  using type = typename Model::MotionType;
  static const type& of(const Model& model) { return model.motion(); }
};

/// A sensor as compiled code sees it, of this model.
template <class Sensor, class Model>
SensorRef sensor_ref(const Sensor& sensor, const Model& model) {
  if constexpr (requires { sensor.ref_for(model); }) {
    return sensor.ref_for(model);
  } else {
    using Asked = AskedAs<Model>;
    return {&sensor, &sensor_table<Sensor, typename Asked::type, differentiates<Model>>, &Asked::of(model)};
  }
}

}  // namespace sigmax::detail
