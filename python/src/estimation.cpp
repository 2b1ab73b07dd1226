#include "rooms.hpp"
#include "tracking.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <pybind11/stl.h>

#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/doppler_sensor.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/gospa.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/unscented.hpp>

namespace sigmax::python {
namespace {

using State = StateOf<AnyModel>;
using Matrix = StateMatrixOf<AnyModel>;
using Measured = Vector<Eigen::Dynamic, max_measurement_size>;
using Slopes = RectangularMatrix<Eigen::Dynamic, Eigen::Dynamic, max_measurement_size, AnyModel::max_state_size>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using OverTime = std::function<Matrix(double dt)>;

py::array array_of_vector(const State& x) { return copied(x.data(), x.size()); }

/// A result of a user's function. Throws ValueError, naming the function, for another shape; −1 is any length.
template <class Result, class... Lengths>
Result returned(const py::object& value, const char* name, Lengths... lengths) {
  const Array array(value);
  expect_shape(array, name, lengths...);
  if (array.shape(0) > Result::MaxRowsAtCompileTime) throw std::length_error(std::string(name) + " has too many rows");
  return Eigen::Map<const Rows>(array.data(), array.shape(0), array.ndim() == 2 ? array.shape(1) : 1);
}

/// A matrix that serves every step, or a function of the step.
OverTime over_time(const char* name, const py::object& given, std::size_t n) {
  if (PyCallable_Check(given.ptr()) != 0) return [=](double dt) { return returned<Matrix>(given(dt), name, n, n); };
  return [fixed = returned<Matrix>(given, name, n, n)](double) { return fixed; };
}

/// A user's motion, which may be linear.
struct OwnMotion {
  static constexpr int state_size = Eigen::Dynamic, max_state_size = AnyModel::max_state_size;

  Eigen::Index size() const { return static_cast<Eigen::Index>(own_components.size()); }
  const std::string& name() const { return own_name; }
  const std::vector<std::string>& components() const { return own_components; }
  Matrix process_covariance(double dt) const { return Q(dt); }
  State propagate(const State& x, double dt) const {
    return linear ? State(linear(dt) * x) : returned<State>(f(array_of_vector(x), dt), "f", size());
  }
  Matrix transition_jacobian(const State& x, double dt) const {
    return linear ? linear(dt) : returned<Matrix>(jacobian(array_of_vector(x), dt), "jacobian", size(), size());
  }

  std::string own_name;
  std::vector<std::string> own_components;
  OverTime Q, linear;
  py::object f, jacobian;
};

/// A user's sensor of the state of whatever model asks.
struct OwnSensor {
  static constexpr int measurement_size = Eigen::Dynamic, max_measurement_size = sigmax::max_measurement_size;

  Measured measure(const AnyModel&, const State& x) const { return returned<Measured>(h(array_of_vector(x)), "h", -1); }
  Slopes measurement_jacobian(const AnyModel&, const State& x) const {
    return returned<Slopes>(jacobian(array_of_vector(x)), "jacobian", -1, x.size());
  }
  Measured measurement_difference(const Measured& z, const Measured& predicted) const {
    Measured difference = z - predicted;
    for (const std::size_t i : angles)
      if (const auto at = static_cast<Eigen::Index>(i); at < difference.size())
        difference(at) = wrapped(difference(at));
    return difference;
  }

  py::object h, jacobian;
  std::vector<std::size_t> angles;
};

Model known_motion_model(const std::string& name, int axes, double sigma, const py::kwargs& values) {
  MotionChoice choice{name};
  choice[MotionParameter::sigma_w] = sigma;
  for (const auto& [key, value] : values.cast<std::map<std::string, double>>()) {
    const auto found = std::ranges::find(motion_parameters(), key, &KnownParameter::key);
    const auto i = static_cast<std::size_t>(found - motion_parameters().begin());
    if (found == motion_parameters().end() || !choice.known().has[i])
      throw py::type_error(name + ": there is no parameter '" + key + "'");
    choice.parameters[i] = value;
  }
  if (axes > 3) throw std::invalid_argument(name + " along " + std::to_string(axes) + " axes; expected 1, 2 or 3");
  return {known_model(choice, axes), choice};
}

/// A sensor of the library at a place of two or three numbers, or of components of the state at so many places.
Sensor placed(const std::string& name, const std::vector<double>& numbers) {
  using enum AnyDetection::Sensor;
  if (name == "components") {
    const std::vector<int> places(numbers.begin(), numbers.end());
    const ComponentSensor<max_measurement_size> sensor(places);  // refuses what no sensor measures
    AnyDetection plain{.sensor = components};
    std::ranges::copy(places, plain.places.begin());
    return {sensor, plain};
  }
  AnyDetection plain{.sensor = name == "bearing" ? bearing : name == "doppler" ? doppler : polar};
  const std::size_t axes = numbers.size();
  if (axes != 3 && (axes != 2 || name == "slant"))
    throw std::invalid_argument(name + ": found an origin of " + std::to_string(axes) + " numbers");
  std::ranges::copy(numbers, plain.origin.begin());
  const Vector<3> at(plain.origin.data());
  const Vector<2> below(plain.origin.data());
  if (name == "bearing") return {BearingSensor(below), plain};
  if (name == "slant") return {SlantSensor(at), plain};
  if (name == "doppler") return {axes == 2 ? AnySensor(DopplerSensor<2>(below)) : DopplerSensor<3>(at), plain};
  return {axes == 2 ? AnySensor(PolarSensor<2>(below)) : PolarSensor<3>(at), plain};
}

void bind_models_and_sensors(py::module_& module) {
  py::class_<Model> type(module, "Model", "A motion, with its filter of the Kalman family; made by sigmax.models.");
  property(type, "name", "For people.", [](const Model& self) { return std::string(self.model.name()); });
  property(type, "_known", "", [](const Model& self) { return self.known.has_value(); });
  module.def("_known_model", &known_motion_model, py::arg("name"), py::arg("axes"), py::arg("sigma") = 3.0);
  module.def("_own_model", [](const std::string& name, const std::vector<std::string>& components, const py::object& f,
                              const py::object& F, const py::object& Q, const std::string& member) {
    const OverTime linear = f.is_none() ? over_time("F", F, components.size()) : OverTime();
    const OwnMotion motion{name, components, over_time("Q", Q, components.size()), linear, f, F};
    const std::size_t kind = index_among("member", member, {"ekf", "ukf", "ckf"});
    if (kind == 1) return Model{Unscented{motion}};
    return kind == 2 ? Model{Cubature{motion}} : Model{Extended{motion}};
  });
  py::class_<Sensor>(module, "Sensor", "What measures a state, with its place; made by sigmax.sensors.");
  module.def("_placed_sensor", &placed);
  module.def("_own_sensor", [](const py::object& h, const py::object& jacobian, std::vector<std::size_t> angles) {
    return Sensor{OwnSensor{h, jacobian, std::move(angles)}};
  });
}

Detections detections_of(const Array& times, const py::object& numbers, const Array& R, const Sensor* sensor) {
  expect_shape(times, "times", -1);
  const Array z = measured(numbers);
  expect_shape(z, "z", times.size(), -1);
  const py::ssize_t m = z.shape(1);
  require_quantities(m);
  if (sensor && !sensor->plain)
    throw py::type_error("Detections: a sensor of your own has no recordings; give its detections to step");
  AnyDetection detection = sensor ? *sensor->plain : AnyDetection{.sensor = AnyDetection::Sensor::position};
  detection.size = static_cast<int>(m);
  Detections result;
  result.reserve(static_cast<std::size_t>(times.size()));
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    const double* const row = z.data() + i * m;
    const auto missing = std::count_if(row, row + m, [](double number) { return std::isnan(number); });
    if (missing % m != 0)
      throw std::invalid_argument("z: row " + std::to_string(i) + " has " + std::to_string(missing) + " NaN of " +
                                  std::to_string(m) + "; expected none, or all if it was missed");
    if (i == 0 || R.ndim() == 3) write_covariance(R, i, times.size(), m, detection.covariance.data());
    std::copy_n(row, m, detection.z.begin());
    detection.time = times.data()[i];
    missing == 0 ? result.push_back(detection) : result.push_back(AnyDetection::missed(detection.time));
    result.back().tag = static_cast<std::size_t>(i);
  }
  return result;
}

void bind_detections_and_metrics(py::module_& module) {
  py::class_<Detections> type(module, "Detections",
                              "Detections(times, z, R, sensor=None): a recording, or a scan, of one sensor.\n\n"
                              "times (N,) in s; z (N, m), a row of NaN or masked is a missed detection; R (m, m),\n"
                              "variances (m,), or (N, m, m). Without a sensor z is a position in m.\n"
                              "a + b merges two of them by time.");
  type.def(py::init(&detections_of), py::arg("times"), py::arg("z"), py::arg("R"), py::arg("sensor") = py::none());
  method(type, "__len__", "", [](const Detections& self) { return self.size(); });
  method(type, "__add__", "", [](Detections self, const Detections& other) {
    self.insert(self.end(), other.begin(), other.end());
    std::ranges::stable_sort(self, {}, &AnyDetection::time);
    for (std::size_t i = 0; i < self.size(); ++i) self[i].tag = i;
    return self;
  });
  function(
      module, "gospa(truth, estimates, cutoff=10.0, order=2.0)",
      "GOSPA with α = 2 of points (N, d) against (M, d), in m, and its parts, which are powers of `order`.",
      [](const PointSet& truth, const PointSet& estimates, double cutoff, double order) {
        const Gospa g = gospa(truth, estimates, {cutoff, order});
        return record(py::arg("value") = g.value, py::arg("localisation") = g.localisation,
                      py::arg("missed") = g.missed, py::arg("false_targets") = g.false_targets,
                      py::arg("estimate_of") = g.estimate_of);
      },
      py::arg("truth"), py::arg("estimates"), py::arg("cutoff") = 10.0, py::arg("order") = 2.0);
}

}  // namespace

std::size_t index_among(const std::string& key, const std::string& given, const std::vector<std::string>& words) {
  const auto found = std::ranges::find(words, given);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  throw std::invalid_argument(key + ": expected one of " + all + ", found '" + given + "'");
}

void bind_estimation(py::module_& module) {
  bind_models_and_sensors(module);
  bind_detections_and_metrics(module);
}

}  // namespace sigmax::python
