#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "kinds.hpp"

#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/hybrid/any_target.hpp>
#include <sigmax/hybrid/multi_target_tracker.hpp>

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

/// A recording, or a scan: the tag of each detection is its row.
struct Detections : std::vector<AnyDetection> {};

/// What a filter, or a tracker of many targets, is made of. The choice lacks motions of a user's own.
struct Settings {
  TargetChoice choice = {};
  TargetRules target = choice.rules;
  AssociationChoice association = {};
  MultiTargetRules scene = {};
  std::vector<AnyModel> models = {};
  py::object relation = {};  ///< the transition
};

/// Numbers that were measured, with NaN where a masked array hides them; pandas' `mask` is something else.
inline Array measured(const py::object& numbers) {
  return py::isinstance<py::array>(numbers) ? quick_array(numbers) : Array(numbers);
}

/// Writes the covariance of row i of so many: R is (m, m), or variances (m,), or one for each row, (rows, m, m).
inline void write_covariance(const Array& R, py::ssize_t i, py::ssize_t rows, py::ssize_t m, double* result) {
  const bool each = R.ndim() == 3, variances = R.ndim() == 1;
  each ? expect_shape(R, "R", rows, m, m) : variances ? expect_shape(R, "R", m) : expect_shape(R, "R", m, m);
  std::fill_n(result, m * m, 0.0);
  const double* const from = R.data() + (each ? i * m * m : 0);
  for (py::ssize_t k = 0; k < (variances ? m : m * m); ++k) result[variances ? k * (m + 1) : k] = from[k];
}

/// Throws ValueError unless so many quantities can be measured.
inline void require_quantities(py::ssize_t m, int most = max_measurement_size) {
  if (m < 1 || m > most)
    throw std::invalid_argument("z has " + std::to_string(m) + " quantities; expected 1 to " + std::to_string(most));
}

/// The index among words of the one that is given. Throws ValueError, which lists them.
std::size_t index_among(const std::string& key, const std::string& given, const std::vector<std::string>& words);

void bind_filters(py::module_& module);

}  // namespace sigmax::python
