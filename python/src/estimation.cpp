#include "rooms.hpp"
#include "tracking.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <pybind11/stl.h>

#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/doppler_sensor.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/gospa.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/trajectory_gospa.hpp>
#include <sigmax/estimation/unscented.hpp>

namespace sigmax::python {
namespace {

using State = StateOf<AnyModel>;
using Matrix = StateMatrixOf<AnyModel>;
using Measured = Vector<Eigen::Dynamic, max_measurement_size>;
using Slopes = RectangularMatrix<Eigen::Dynamic, Eigen::Dynamic, max_measurement_size, AnyModel::max_state_size>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

py::array array_of_vector(const auto& x) { return copied(x.data(), x.size()); }

/// A result of a user's function. Throws ValueError, naming the function, for another shape; −1 is any length.
template <class Result, class... Lengths>
Result returned(const py::object& value, const char* name, Lengths... lengths) {
  const Array array(value);
  expect_shape(array, name, lengths...);
  const Eigen::Index columns = array.ndim() == 2 ? array.shape(1) : 1;
  return Eigen::Map<const Rows>(array.data(), array.shape(0), columns);
}

/// ∂f/∂x by central differences.
template <class Result, class Function>
Result slopes(const Function& f, State x) {
  Result result;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double at = x(i), step = 6e-6 * std::max(1.0, std::abs(at));
    x(i) = at + step;
    const auto above = f(x);
    x(i) = at - step;
    const auto slope = ((above - f(x)) / (2.0 * step)).eval();
    x(i) = at;
    if (i == 0) result.resize(slope.size(), x.size());
    result.col(i) = slope;
  }
  return result;
}

/// A matrix that serves every step, or one step alone, or is a function of it.
struct OverTime {
  OverTime(const char* own_name, const py::object& given, py::ssize_t n, std::optional<double> own_step)
      : name(own_name), size(n), step(own_step) {
    if (PyCallable_Check(given.ptr()) != 0)
      function = given;
    else
      fixed = returned<Matrix>(given, name, n, n);
  }
  Matrix operator()(double dt) const {
    if (function) return returned<Matrix>(function(dt), name, size, size);
    if (step && !(std::abs(dt - *step) <= 1e-9 * *step))
      throw std::invalid_argument(std::string(name) + " was given for steps of " + std::to_string(*step) +
                                  " s, but one of " + std::to_string(dt) + " s was asked for");
    return fixed;
  }

  const char* name;
  py::ssize_t size;
  std::optional<double> step;
  py::object function = {};
  Matrix fixed = {};
};

/// What a user's motions have in common.
struct OwnModel {
  static constexpr int state_size = Eigen::Dynamic, max_state_size = AnyModel::max_state_size;

  Eigen::Index size() const { return static_cast<Eigen::Index>(own_components.size()); }
  const std::string& name() const { return own_name; }
  const std::vector<std::string>& components() const { return own_components; }
  Matrix process_covariance(double dt) const { return Q(dt); }

  std::string own_name;
  std::vector<std::string> own_components;
  OverTime Q;
};

struct OwnLinearMotion : OwnModel {
  Matrix transition(double dt) const { return F(dt); }
  State known_input(double) const { return State::Zero(size()); }

  OverTime F;
};

struct OwnMotion : OwnModel {
  State propagate(const State& x, double dt) const { return returned<State>(f(array_of_vector(x), dt), "f", size()); }
  Matrix transition_jacobian(const State& x, double dt) const {
    if (!jacobian.is_none()) return returned<Matrix>(jacobian(array_of_vector(x), dt), "jacobian", size(), size());
    return slopes<Matrix>([&](const State& at) { return propagate(at, dt); }, x);
  }

  py::object f, jacobian;
};

/// A user's sensor of the state of whatever model asks.
struct OwnSensor {
  static constexpr int measurement_size = Eigen::Dynamic, max_measurement_size = sigmax::max_measurement_size;

  Measured measure(const AnyModel&, const State& x) const { return seen(x); }
  Measured seen(const State& x) const {
    const Array z(h(array_of_vector(x)));
    if (z.ndim() == 1) require_quantities(z.size());
    return returned<Measured>(z, "h", -1);
  }
  Slopes measurement_jacobian(const AnyModel&, const State& x) const {
    if (!jacobian.is_none()) return returned<Slopes>(jacobian(array_of_vector(x)), "jacobian", -1, x.size());
    return slopes<Slopes>([&](const State& at) { return seen(at); }, x);
  }
  Measured measurement_difference(const Measured& z, const Measured& predicted) const {
    Measured difference = z - predicted;
    for (const Eigen::Index i : angles)
      if (i >= 0 && i < difference.size()) difference(i) = wrapped(difference(i));
    return difference;
  }

  py::object h, jacobian;
  std::vector<Eigen::Index> angles;
};

Model known_motion_model(const std::string& name, int axes, const std::map<std::string, double>& values) {
  MotionChoice choice{name};
  for (std::size_t i = 0; i < motion_parameters().size(); ++i)
    if (const auto found = values.find(std::string(motion_parameters()[i].key)); found != values.end())
      choice.parameters[i] = found->second;
  if (axes < 1 || axes > 3)
    throw std::invalid_argument(name + " along " + std::to_string(axes) + " axes; expected 1, 2 or 3");
  return {known_model(choice, axes), choice};
}

void bind_models(py::module_& module) {
  py::class_<Model> type(module, "Model", "A motion, with its filter of the Kalman family; made by sigmax.models.");
  property(type, "name", "For people.", [](const Model& self) { return std::string(self.model.name()); });
  property(type, "components", "Names of its states; models share a component by its name.",
           [](const Model& self) { return self.model.components(); });
  property(type, "parameters", "Parameters of a motion of the library by their keys.", [](const Model& self) {
    std::map<std::string, double> values;
    for (std::size_t i = 0; self.known && i < motion_parameters().size(); ++i)
      if (self.known->known().has[i]) values[std::string(motion_parameters()[i].key)] = self.known->parameters[i];
    return values;
  });
  type.def("__repr__", [](const py::object& self) {
    return py::str("<Model {} {}>").format(self.attr("name"), self.attr("parameters"));
  });
  module.def("_known_model", &known_motion_model);
  using Names = std::vector<std::string>;
  module.def("_linear_model", [](const std::string& name, const Names& components, const py::object& F,
                                 const py::object& Q, std::optional<double> dt) {
    const auto n = static_cast<py::ssize_t>(components.size());
    return Model{OwnLinearMotion{{name, components, OverTime("Q", Q, n, dt)}, OverTime("F", F, n, dt)}};
  });
  module.def("_own_model", [](const std::string& name, const Names& components, const py::object& f,
                              const py::object& Q, const py::object& jacobian, const std::string& member) {
    const OwnMotion motion{
        {name, components, OverTime("Q", Q, static_cast<py::ssize_t>(components.size()), {})}, f, jacobian};
    const std::size_t kind = index_among("member", member, {"ekf", "ukf", "ckf"});
    if (kind == 1) return Model{Unscented{motion}};
    return kind == 2 ? Model{Cubature{motion}} : Model{Extended{motion}};
  });
}

/// A sensor of the library with its place.
Sensor placed(const std::string& name, int axes, const std::vector<double>& origin) {
  using enum AnyDetection::Sensor;
  if (axes < 2 || axes > 3)
    throw std::invalid_argument(name + " in " + std::to_string(axes) + " axes; expected 2 or 3");
  if (!origin.empty() && origin.size() != static_cast<std::size_t>(axes))
    throw std::invalid_argument("origin: expected " + std::to_string(axes) + " numbers, found " +
                                std::to_string(origin.size()));
  AnyDetection plain;
  std::ranges::copy(origin, plain.origin.begin());
  const Vector<3> at(plain.origin.data());
  const Vector<2> below(plain.origin.data());
  plain.sensor = name == "bearing" ? bearing : name == "doppler" ? doppler : polar;
  if (name == "bearing") return {BearingSensor(below), plain};
  if (name == "slant") return {SlantSensor(at), plain};
  if (axes == 2)
    return name == "doppler" ? Sensor{DopplerSensor<2>(below), plain} : Sensor{PolarSensor<2>(below), plain};
  return name == "doppler" ? Sensor{DopplerSensor<3>(at), plain} : Sensor{PolarSensor<3>(at), plain};
}

void bind_sensors(py::module_& module) {
  py::class_<Sensor>(module, "Sensor", "What measures a state, with its place; made by sigmax.sensors.");
  module.def("_placed_sensor", &placed);
  module.def("_component_sensor", [](const std::vector<int>& places) {
    const ComponentSensor<max_measurement_size> sensor(places);  // refuses what no sensor measures
    AnyDetection plain{.sensor = AnyDetection::Sensor::components};
    std::ranges::copy(places, plain.places.begin());
    return Sensor{sensor, plain};
  });
  module.def("_own_sensor", [](const py::object& h, const py::object& jacobian, std::vector<Eigen::Index> angles) {
    return Sensor{OwnSensor{h, jacobian, std::move(angles)}};
  });

  py::class_<Detections> type(module, "Detections",
                              "Detections(times, z, R, sensor=None): a recording, or a scan, of one sensor.\n\n"
                              "times (N,) in s; z (N, m), a row of NaN or masked is a missed detection; R (m, m),\n"
                              "variances (m,), or (N, m, m). Without a sensor z is a position in m.\n"
                              "a + b merges two of them by time.");
  type.def(py::init([](const Array& times, const py::object& numbers, const Array& R, const Sensor* sensor) {
             expect_shape(times, "times", -1);
             const Array z = unmasked(numbers);
             expect_shape(z, "z", times.size(), -1);
             const py::ssize_t m = z.shape(1);
             require_quantities(m);
             if (sensor && !sensor->plain)
               throw py::type_error("Detections: a sensor of your own has no recordings; give its detections to step");
             AnyDetection detection = sensor ? *sensor->plain : AnyDetection{.sensor = AnyDetection::Sensor::position};
             detection.size = static_cast<int>(m);
             Detections result;
             for (py::ssize_t i = 0; i < times.size(); ++i) {
               const double* const row = z.data() + i * m;
               const auto missing = std::count_if(row, row + m, [](double number) { return std::isnan(number); });
               if (missing > 0 && missing < m)
                 throw std::invalid_argument("z: row " + std::to_string(i) + " has " + std::to_string(missing) +
                                             " NaN of " + std::to_string(m) +
                                             "; expected none, or all if it was missed");
               write_covariance(R, i, times.size(), m, detection.covariance.data());
               std::copy_n(row, m, detection.z.begin());
               detection.time = times.data()[i];
               result.rows.push_back(missing == 0 ? detection : AnyDetection::missed(detection.time));
               result.rows.back().tag = static_cast<std::size_t>(i);
             }
             return result;
           }),
           py::arg("times"), py::arg("z"), py::arg("R"), py::arg("sensor") = py::none());
  type.def("__len__", [](const Detections& self) { return self.rows.size(); });
  type.def("__add__", [](Detections self, const Detections& other) {
    self.rows.insert(self.rows.end(), other.rows.begin(), other.rows.end());
    std::ranges::stable_sort(self.rows, {}, &AnyDetection::time);
    for (std::size_t i = 0; i < self.rows.size(); ++i) self.rows[i].tag = i;
    return self;
  });
  property(type, "times", "(N,), in s.", [](const Detections& self) {
    std::vector<double> times;
    for (const AnyDetection& each : self.rows) times.push_back(each.time);
    return array_of(times);
  });
}

/// Points (N, d). Of a trajectory a row of NaN is a gap.
PointSet points_of(const Array& array, bool gaps) {
  expect_shape(array, "points", -1, -1);
  PointSet points;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const double* const row = array.data() + i * array.shape(1);
    const bool gap = gaps && std::all_of(row, row + array.shape(1), [](double number) { return std::isnan(number); });
    points.emplace_back(row, gap ? row : row + array.shape(1));
  }
  return points;
}

void bind_metrics(py::module_& module) {
  function(
      module, "gospa(truth, estimates, cutoff=10.0, order=2.0)",
      "GOSPA with α = 2 of points (N, d) against (M, d), in m, and its parts, which are powers of `order`.",
      [](const Array& truth, const Array& estimates, double cutoff, double order) {
        const Gospa g = gospa(points_of(truth, false), points_of(estimates, false), {cutoff, order});
        return record(py::arg("value") = g.value, py::arg("localisation") = g.localisation,
                      py::arg("missed") = g.missed, py::arg("false_targets") = g.false_targets,
                      py::arg("estimate_of") = g.estimate_of);
      },
      py::arg("truth"), py::arg("estimates"), py::arg("cutoff") = 10.0, py::arg("order") = 2.0);
  function(
      module, "trajectory_gospa(truth, tracks, cutoff=10.0, order=2.0, switch_penalty=1.0)",
      "Trajectory GOSPA of lists of positions (K, d) at the same K scans, a row of NaN where there is none.",
      [](const std::vector<Array>& truth, const std::vector<Array>& tracks, double cutoff, double order,
         double penalty) {
        const auto all = [](const std::vector<Array>& arrays) {
          std::vector<Trajectory> result;
          for (const Array& array : arrays) result.push_back({0, points_of(array, true)});
          return result;
        };
        const auto a = all(truth), b = all(tracks);
        const TrajectoryGospa g = unlocked([&] { return trajectory_gospa(a, b, {cutoff, order, penalty}); });
        return record(py::arg("value") = g.value, py::arg("localisation") = g.localisation,
                      py::arg("missed") = g.missed, py::arg("false_targets") = g.false_targets,
                      py::arg("switching") = g.switching, py::arg("switches") = g.switches, py::arg("exact") = g.exact);
      },
      py::arg("truth"), py::arg("tracks"), py::arg("cutoff") = 10.0, py::arg("order") = 2.0,
      py::arg("switch_penalty") = 1.0);
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
  bind_models(module);
  bind_sensors(module);
  bind_metrics(module);
}

}  // namespace sigmax::python
