#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "kinds.hpp"

#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/hybrid/any_target.hpp>

namespace sigmax::python {

/// A model of a bank. One that the library knows by name can also follow whole recordings.
struct Model {
  AnyModel model;
  std::optional<MotionChoice> known = {};
};

/// A sensor, and a detection of it to be filled in; a user's own has none.
struct Sensor {
  AnySensor any;
  std::optional<AnyDetection> plain = {};
};

/// The argument of this name. Throws TypeError for an object of another class.
template <class T>
const T& argument(const char* name, const py::object& object) {
  if (!py::isinstance<T>(object))
    throw py::type_error(std::string(name) + ": expected a " +
                         std::string(py::str(py::type::of<T>().attr("__name__"))) + ", found " + class_name(object));
  return object.cast<const T&>();
}

/// A recording, or a scan: the tag of each detection is its row.
struct Detections {
  std::vector<AnyDetection> rows;
};

/// Writes the covariance of row i of so many: R is (m, m), or variances (m,), or one for each row, (rows, m, m).
inline void write_covariance(const Array& R, py::ssize_t i, py::ssize_t rows, py::ssize_t m, double* result) {
  if (R.ndim() == 1) {
    expect_shape(R, "R", m);
    std::fill_n(result, m * m, 0.0);
    for (py::ssize_t k = 0; k < m; ++k) result[k * (m + 1)] = R.data()[k];
  } else {
    if (R.ndim() == 3)
      expect_shape(R, "R", rows, m, m);
    else
      expect_shape(R, "R", m, m);
    std::copy_n(R.data() + (R.ndim() == 3 ? i * m * m : 0), m * m, result);
  }
}

/// Throws ValueError unless the sensor can measure so many quantities.
inline void require_quantities(py::ssize_t m) {
  if (m < 1 || m > max_measurement_size)
    throw std::invalid_argument("z has " + std::to_string(m) + " quantities; expected 1 to 6");
}

/// The index among words of the one that is given. Throws ValueError, which lists them.
std::size_t index_among(const std::string& key, const std::string& given, const std::vector<std::string>& words);

/// The choice of a filter by its name, as programs call them, for models and a transition, which is a table, a relation
/// or None; and further rules by keyword. `relation` becomes the transition.
TargetChoice choice_of(const std::string& filter, const std::vector<Model>& models, const py::object& transition,
                       const py::dict& rules, py::object& relation);

void bind_filters(py::module_& module);

}  // namespace sigmax::python
