#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/likelihood.hpp>

namespace sigmax {

/// The index that stands for a feature whose cell in a row of data is empty.
inline constexpr std::size_t missing = static_cast<std::size_t>(-1);

/// A crisp reading: the variable that was read, and the index of its value.
///
///     Reading{legs, "4"}
///
/// Throws std::invalid_argument, naming the variable, if it has no such value.
struct Reading {
  Reading(Outcomes of, std::size_t value) : variable(std::move(of)), index(value) { (void)variable.label(index); }
  Reading(const Outcomes& of, std::string_view label) : Reading(of, of.index_of(label)) {}

  Outcomes variable;
  std::size_t index;
};

/// The report on one feature: the value that was read, or a likelihood that grades how well each value explains the
/// observation. It names its variable.
template <Uncertainty Feature>
using Finding = std::variant<Reading, Likelihood<Feature>>;

/// One report: findings in any order. Features that have none are missing.
template <Uncertainty Feature>
using Report = std::vector<Finding<Feature>>;

/// A view of a row of data: an index for each feature *in the order of the classifier*, or `missing`. Nothing can check
/// that order.
///
///     classifier.posterior(InOrder{2, missing})
struct InOrder {
  explicit InOrder(std::span<const std::size_t> row) : indices(row) {}
  InOrder(std::initializer_list<std::size_t> row) : indices(row.begin(), row.size()) {}

  std::span<const std::size_t> indices;
};

}  // namespace sigmax
