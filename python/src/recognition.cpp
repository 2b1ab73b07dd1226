#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <cmath>
#include <iterator>
#include <set>
#include <vector>

#include <pybind11/stl.h>

#include <sigmax/core/tie.hpp>
#include <sigmax/recognition/counts.hpp>
#include <sigmax/recognition/discretization.hpp>

namespace sigmax::python {
namespace {

/// The cuts between the bins of each column. A reading is the number of a bin; that of NaN is one more than there are.
using Cuts = std::vector<std::vector<double>>;

std::size_t reading(const std::vector<double>& cuts, double cell) {
  if (std::isnan(cell)) return cuts.size() + 1;
  if (cuts.size() > 16)
    return static_cast<std::size_t>(std::upper_bound(cuts.begin(), cuts.end(), cell) - cuts.begin());
  std::size_t bin = 0;  // without a branch that is hard to predict
  for (const double cut : cuts) bin += cell >= cut ? 1 : 0;
  return bin;
}

/// Weighted counts (columns, classes, readings) of rows with labels.
Array count_rows(std::size_t classes, std::size_t readings, const Cuts& cuts, const Array& labels, const Array& rows,
                 const Array& weights) {
  expect_shape(rows, "rows", labels.size(), cuts.size());
  expect_shape(weights, "weights", labels.size());
  Counts counts{RandomVariable{"class", classes}, {cuts.size(), RandomVariable{"column", readings}}};
  std::vector<std::size_t> row(cuts.size());
  const double* cell = rows.data();
  for (py::ssize_t k = 0; k < labels.size(); ++k) {
    for (std::size_t i = 0; i < cuts.size(); ++i) row[i] = reading(cuts[i], *cell++);
    counts.observe(static_cast<std::size_t>(labels.data()[k]), row, weights.data()[k]);
  }
  Array result({cuts.size(), classes, readings});
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (std::size_t c = 0; c < classes; ++c) std::ranges::copy(counts.of(i, c), result.mutable_data(i, c, 0));
  return result;
}

/// Logarithms of belief, (N, classes), less the greatest of each row: the prior's, (classes,), and those of all its
/// readings, (columns, readings, classes). A row that excludes all classes leaves the prior.
Array log_degrees(const Array& prior, const Array& logs, const Cuts& cuts, const Array& rows) {
  const py::ssize_t classes = prior.size(), readings = logs.shape(1);
  expect_shape(rows, "rows", -1, cuts.size());
  Array result({rows.shape(0), classes});
  const double *cell = rows.data(), *const table = logs.data();
  double *row = result.mutable_data(), *const end = row + result.size();
  const py::gil_scoped_release release;
  for (; row != end; row += classes) {
    std::copy_n(prior.data(), classes, row);
    const double* of_column = table;
    for (const auto& column : cuts) {
      const double* const log = of_column + static_cast<py::ssize_t>(reading(column, *cell++)) * classes;
      for (py::ssize_t c = 0; c < classes; ++c) row[c] += log[c];
      of_column += readings * classes;
    }
    if (*std::max_element(row, row + classes) == log_zero) std::copy_n(prior.data(), classes, row);
    const double greatest = *std::max_element(row, row + classes);
    std::for_each_n(row, classes, [&](double& log) { log = ties(log, greatest) ? 0.0 : log - greatest; });
  }
  return result;
}

/// Cuts and labels of bins by `equal_frequency`; few different values are found without sorting all.
py::tuple bins_of(const Array& values, std::size_t bins) {
  std::set<double> different;
  for (const double value : row_of(values)) {
    if (!std::isnan(value)) different.insert(value);
    if (different.size() <= bins && !std::isinf(value)) continue;
    const Discretization found = equal_frequency(row_of(values), bins);
    return py::make_tuple(std::vector<double>(found.cuts().begin(), found.cuts().end()), found.labels());
  }
  const std::vector<double> cuts(different.empty() ? different.end() : std::next(different.begin()), different.end());
  return py::make_tuple(cuts, Discretization(cuts).labels());
}

}  // namespace

void bind_recognition(py::module_& module) {
  module.def("_bins", &bins_of);
  module.def("_count_rows", &count_rows);
  module.def("_log_degrees", &log_degrees);
}

}  // namespace sigmax::python
