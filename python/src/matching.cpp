#include "arrays.hpp"
#include "kinds.hpp"

#include <cstdint>
#include <map>
#include <vector>

#include <pybind11/stl.h>

namespace sigmax::python {

void bind_matching(py::module_& module);

namespace {

using Lists = std::vector<std::map<std::size_t, double>>;

/// The choices of each row, listed as {column: number}.
Choices choices_of(const Array& none, const Lists& rows) {
  expect_shape(none, "log_none", rows.size());
  Choices choices;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    choices.add_row(none.data()[i]);
    for (const auto& [column, value] : rows[i]) choices.add(column, value);
  }
  return choices;
}

/// The same as rows of any other form: an array (rows, columns), or sparse.
Lists lists_of(const py::object& rows) {
  const SparseRows sparse = is_sparse(rows) ? sparse_rows(rows) : SparseRows();
  const Array dense = is_sparse(rows) ? Array(std::vector<py::ssize_t>{0, 0}) : as_array(rows);
  expect_shape(dense, "log_weights", -1, -1);
  Lists lists(sparse.rows() + static_cast<std::size_t>(dense.shape(0)));
  const auto columns = static_cast<std::size_t>(dense.shape(1));
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const detail::AnyEntries entries = is_sparse(rows) ? detail::AnyEntries(sparse.entries(i))
                                                       : RunOfEntries{0, numbers(dense).subspan(i * columns, columns)};
    for (std::size_t k = 0; k < entries.size(); ++k) lists[i][entries.index(k)] = entries.value(k);
  }
  return lists;
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
  return py::make_tuple(array_of(values), array_of(columns), array_of(ends));
}

/// Columns as NumPy has them, −1 for none.
py::array columns_of(const std::vector<std::size_t>& columns) {
  std::vector<std::int64_t> with_sign;
  for (const std::size_t column : columns)
    with_sign.push_back(column == no_column ? -1 : static_cast<std::int64_t>(column));
  return array_of(with_sign);
}

template <class Pattern>
Matching match_pattern(const Choices& log_weights, const std::string& permutation, const MatchingOptions& options) {
  return permutation == Fuzzy::name ? match<Pattern, Fuzzy>(log_weights, options)
                                    : match<Pattern, Random>(log_weights, options);
}

Matching match_any(const Array& none, const py::object& rows, const std::string& pattern,
                   const std::string& permutation, std::size_t max_states) {
  for (const std::string& kind : {pattern, permutation})
    if (kind != Random::name && kind != Fuzzy::name)
      throw py::value_error("match: expected 'random' or 'fuzzy', found '" + kind + "'");
  const bool listed = py::isinstance<py::list>(rows) &&
                      (py::len(rows) == 0 || py::isinstance<py::dict>(rows[py::int_(0)].cast<py::object>()));
  const Choices log_weights = choices_of(none, listed ? rows.cast<Lists>() : lists_of(rows));
  const MatchingOptions options{max_states, true};
  return unlocked([&] {
    return pattern == Fuzzy::name ? match_pattern<Fuzzy>(log_weights, permutation, options)
                                  : match_pattern<Random>(log_weights, permutation, options);
  });
}

}  // namespace

void bind_matching(py::module_& module) {
  py::class_<Matching> type(module, "Matching", "What all events between rows and columns say together.");
  type.def_readonly("log_total", &Matching::log_total, "Logarithm of the ⊕ of all events.");
  type.def_readonly("log_best", &Matching::log_best, "Logarithm of the weight of the best event.");
  type.def_readonly("exact", &Matching::exact, "False if a cluster had too many states.");
  property(type, "log_marginals",
           "Logarithms for each choice, as scipy.sparse.csr_matrix takes them: data, indices, indptr.",
           [](const Matching& self) { return compressed(self.marginals); });
  property(type, "log_none", "Logarithms for no column, (rows,).", [](const Matching& self) {
    std::vector<double> none(self.marginals.rows());
    for (std::size_t i = 0; i < none.size(); ++i) none[i] = self.marginals.none(i);
    return array_of(none);
  });
  property(type, "winners", "Of each row the choice of greatest marginal, −1 for none.",
           [](const Matching& self) { return columns_of(self.winners); });
  property(type, "best", "The event of greatest weight: a column for each row, −1 for none.",
           [](const Matching& self) { return columns_of(self.best); });
  function(
      module, "match(log_none, log_weights, pattern, permutation, max_states=100000)",
      "Marginals of all events that give each row a column or none, and no column twice.\n\n"
      "`log_none` (rows,) are weights of no column; `log_weights` is an array (rows, columns), a sparse matrix of\n"
      "SciPy or a list of dicts {column: number}. What is not listed is excluded, as is −inf. Kinds of pattern and\n"
      "permutation: random, random is JPDA; random, fuzzy is JPDA*; fuzzy, fuzzy is GNN.",
      &match_any, py::arg("log_none"), py::arg("log_weights"), py::arg("pattern"), py::arg("permutation"),
      py::arg("max_states") = MatchingOptions{}.max_states);
}

}  // namespace sigmax::python
