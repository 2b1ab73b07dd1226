#include "arrays.hpp"
#include "kinds.hpp"

#include <cstdint>
#include <map>
#include <vector>

#include <pybind11/stl.h>

namespace sigmax::python {

void bind_matching(py::module_& module);

namespace {

void add_row(Choices& choices, double none, const auto& entries) {
  std::vector<Choices::Entry> row(entries.size());
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = {entries.index(k), entries.value(k)};
  choices.add_row(none, row);
}

template <class T>
T cast_or_refuse(const py::object& entries) {
  try {
    return entries.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error("entries: expected a list of dicts {column: number}");
  }
}

Choices choices_of(const Array& none, const py::object& entries) {
  expect_shape(none, "none", -1);
  Choices choices;
  const auto rows = static_cast<std::size_t>(none.size());
  if (is_sparse(entries)) {
    const SparseRows sparse = sparse_rows(entries);
    if (sparse.rows() != rows) throw py::value_error("entries: expected as many rows as none has");
    for (std::size_t i = 0; i < rows; ++i) add_row(choices, none.data()[i], sparse.entries(i));
  } else if (py::isinstance<py::list>(entries) &&
             (rows == 0 || py::isinstance<py::dict>(py::object(entries[py::int_(0)])))) {
    const auto listed = cast_or_refuse<std::vector<std::map<std::size_t, double>>>(entries);
    if (listed.size() != rows) throw py::value_error("entries: expected as many rows as none has");
    for (std::size_t i = 0; i < rows; ++i) {
      choices.add_row(none.data()[i]);
      for (const auto& [column, value] : listed[i]) choices.add(column, value);
    }
  } else {
    const Array dense = as_array(entries);
    expect_shape(dense, "entries", rows, -1);
    const auto columns = static_cast<std::size_t>(dense.shape(1));
    for (std::size_t i = 0; i < rows; ++i)
      add_row(choices, none.data()[i], RunOfEntries{0, numbers(dense).subspan(i * columns, columns)});
  }
  return choices;
}

py::tuple compressed(const Choices& choices) {
  std::vector<std::int64_t> ends{0}, columns;
  std::vector<double> values;
  for (std::size_t i = 0; i < choices.rows(); ++i) {
    const ListOfEntries entries = choices.entries(i);
    columns.insert(columns.end(), entries.columns.begin(), entries.columns.end());
    values.insert(values.end(), entries.values.begin(), entries.values.end());
    ends.push_back(static_cast<std::int64_t>(values.size()));
  }
  return py::make_tuple(copied(ends.data(), ends.size()), copied(columns.data(), columns.size()), array_of(values));
}

/// Columns as NumPy has them, −1 for none.
py::array columns_of(const std::vector<std::size_t>& columns) {
  std::vector<std::int64_t> signed_columns(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    signed_columns[i] = columns[i] == no_column ? -1 : static_cast<std::int64_t>(columns[i]);
  return copied(signed_columns.data(), signed_columns.size());
}

Matching match_kinds(const Choices& log_weights, const std::string& pattern, const std::string& permutation,
                     const MatchingOptions& options) {
  const auto is_fuzzy = [](const std::string& kind) {
    if (kind != Random::name && kind != Fuzzy::name)
      throw py::value_error("match: expected 'random' or 'fuzzy', found '" + kind + "'");
    return kind == Fuzzy::name;
  };
  const bool fuzzy = is_fuzzy(permutation);
  const auto of_pattern = [&]<class Pattern>() {
    return unlocked([&] {
      return fuzzy ? match<Pattern, Fuzzy>(log_weights, options) : match<Pattern, Random>(log_weights, options);
    });
  };
  return is_fuzzy(pattern) ? of_pattern.operator()<Fuzzy>() : of_pattern.operator()<Random>();
}

}  // namespace

void bind_matching(py::module_& module) {
  py::class_<Choices>(module, "Choices", "What rows may take: some columns, or none, with a number each.")
      .def(py::init(&choices_of), py::arg("none"), py::arg("entries"), R"(Numbers of no column (rows,), and of columns.

`entries` is an array (rows, columns), a sparse matrix of SciPy, or a list of dicts {column: number}, one a row.
A column that a row does not list is excluded, as is −inf in a matching, +inf in an assignment.)")
      .def_property_readonly("rows", &Choices::rows)
      .def_property_readonly("columns", &Choices::columns)
      .def_property_readonly(
          "none",
          [](const Choices& self) {
            std::vector<double> none(self.rows());
            for (std::size_t i = 0; i < none.size(); ++i) none[i] = self.none(i);
            return array_of(none);
          },
          "Numbers of no column, (rows,).")
      .def("csr", &compressed, "The arrays indptr, indices and data of compressed sparse rows.");
  py::class_<Matching>(module, "Matching", "What all events between rows and columns say together.")
      .def_readonly("log_total", &Matching::log_total, "Logarithm of the ⊕ of all events.")
      .def_readonly("marginals", &Matching::marginals, "Logarithms for each choice of a row, as Choices.")
      .def_property_readonly(
          "winners", [](const Matching& self) { return columns_of(self.winners); },
          "Of each row the choice of greatest marginal, −1 for none.")
      .def_property_readonly(
          "best", [](const Matching& self) { return columns_of(self.best); },
          "The event of greatest weight: a column for each row, −1 for none.")
      .def_readonly("log_best", &Matching::log_best, "Logarithm of the weight of the best event.")
      .def_readonly("exact", &Matching::exact, "False if a cluster had too many states.");
  module.def(
      "match",
      [](const Choices& log_weights, const std::string& pattern, const std::string& permutation, std::size_t max_states,
         bool marginals) {
        return match_kinds(log_weights, pattern, permutation, {max_states, marginals});
      },
      py::arg("log_weights"), py::arg("pattern"), py::arg("permutation"), py::kw_only(),
      py::arg("max_states") = MatchingOptions{}.max_states, py::arg("marginals") = true,
      R"(match(log_weights, pattern, permutation, *, max_states=100000, marginals=True)
--

Marginals of all events that give each row a column or none, and no column twice.

Kinds of (pattern, permutation): "random", "random" is JPDA; "random", "fuzzy" is JPDA*; "fuzzy", "fuzzy" is GNN.
ValueError if there is no event at all.)");
  module.def(
      "assign",
      [](const Choices& costs) {
        const Assignment best = unlocked([&] { return assign(costs); });
        return py::make_tuple(columns_of(best.columns), best.cost);
      },
      py::arg("costs"), R"(assign(costs)
--

The assignment of least total cost: columns (rows,), −1 for none, and the cost.)");
}

}  // namespace sigmax::python
