#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <sigmax/core/condition.hpp>
#include <sigmax/core/outcomes.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax {

/// How far from one the ⊕ of a distribution may lie when a constructor proves it.
inline constexpr double normalization_tolerance = 1e-9;

/// ⊕ of numbers in the algebra of `Kind`, (2) or (3).
template <Uncertainty Kind>
double total(std::span<const double> values) {
  return detail::total(detail::algebra_of<Kind>(), values);
}

/// The failures of the constructors, with the variable, the row and the value in the message. All but `excluded` throw
/// std::invalid_argument.
namespace check {

/// The row of a conditional table that is being checked: outcome `index` of `variable`. None if `variable` is null.
struct Row {
  const Outcomes* variable = nullptr;
  std::size_t index = 0;
};

/// Every value is a finite number in [0, greatest].
void values(const Outcomes& variable, Row row, std::span<const double> values, double greatest);

/// The same of one of them.
void value(const Outcomes& variable, Row row, std::size_t index, double value, double greatest);

/// The stored values of a row belong to outcomes of the variable, in ascending order.
void ascending(const Outcomes& variable, Row row, std::size_t next_allowed, std::size_t index);

/// The variable has an outcome of this index.
void index(const Outcomes& variable, std::size_t index);

/// There are as many values as the variable has outcomes.
void size(const Outcomes& variable, Row row, std::size_t size);

/// There are as many rows of a relation as `from` has outcomes.
void rows(const Outcomes& to, const Outcomes& from, std::size_t rows);

/// The ⊕ of the values is one to within `normalization_tolerance`.
void total(const Outcomes& variable, Row row, double total, std::string_view name_of_total);

/// Both are the same variable; `where` says who asks.
[[noreturn]] void differ(const Outcomes& expected, const Outcomes& found, std::string_view where);
inline void same(const Outcomes& expected, const Outcomes& found, std::string_view where) {
  if (!(expected == found)) differ(expected, found, where);
}

/// The values are a distribution: as many as outcomes, each in [0, 1], their ⊕ one.
void normalized(const Outcomes& variable, Row row, std::span<const double> values, const detail::AnyAlgebra& algebra,
                std::string_view name_of_total);

/// The values are likelihoods: finite, not negative, and at most one where ⊗ does not scale.
void likelihoods(const Outcomes& variable, Row row, std::span<const double> values, const detail::AnyAlgebra& algebra);

/// The weights are likelihoods, and at least one of them is not zero.
void weights(const Outcomes& variable, Row row, std::span<const double> values, const detail::AnyAlgebra& algebra);

/// The logarithm of a likelihood is not NaN, nor +∞.
void log_likelihood(const Outcomes& variable, std::size_t index, double log);

/// Throws std::domain_error: no outcome of the variable is left, whatever excluded them.
[[noreturn]] void excluded(const Outcomes& variable, Row row = {});

/// Throws std::invalid_argument: the variable of a network is of another kind.
[[noreturn]] void other_kind(const std::string& variable, std::string_view kind, std::string_view expected);

/// Throws std::domain_error: an event is a condition, but its measure is zero.
[[noreturn]] void impossible(const std::string& event, std::string_view name_of_measure);

}  // namespace check

/// Proves that the values are a distribution of `variable`: each in [0, 1], their ⊕ one.
template <Uncertainty Kind>
void prove_normalized(const Outcomes& variable, check::Row row, std::span<const double> values) {
  check::normalized(variable, row, values, detail::algebra_of<Kind>(), Kind::total);
}

}  // namespace sigmax
