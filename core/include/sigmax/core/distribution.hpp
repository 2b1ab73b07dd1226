#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/check.hpp>
#include <sigmax/core/condition.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/core/variable.hpp>
#include <sigmax/core/weight.hpp>

namespace sigmax {

/// A normalised distribution of one variable: p with Σ p = 1, (3), or π with max π = 1, (2).
///
/// The constructor proves |⊕ − 1| ≤ 1e-9 and every value in [0, 1], and stores the values unchanged.
template <Uncertainty Kind>
class Distribution {
 public:
  using kind = Kind;

  /// Throws std::invalid_argument, naming the variable and the value, if the values are not a distribution.
  Distribution(Variable<Kind> variable, std::initializer_list<double> values)
      : Distribution(std::move(variable), std::span(values.begin(), values.size())) {}
  Distribution(Variable<Kind> variable, const std::vector<double>& values)
      : Distribution(std::move(variable), std::span(values)) {}
  Distribution(Variable<Kind> variable, std::span<const double> values)
      : variable_(std::move(variable)), table_(1, values.size()) {
    prove_normalized<Kind>(variable_, {}, values);
    std::copy(values.begin(), values.end(), table_.data());
  }

  Distribution(Variable<Kind> variable, Table table, ByLaw) : variable_(std::move(variable)), table_(std::move(table)) {
    assert(std::abs(total<Kind>(values()) - 1.0) <= 1e-6);
  }

  const Variable<Kind>& variable() const { return variable_; }
  std::size_t size() const { return table_.size(); }
  const Table& table() const { return table_; }
  Table& table(ByLaw) { return table_; }
  std::span<const double> values() const { return table_.values(); }

  double operator[](std::size_t index) const { return table_(0, index); }
  double operator[](std::string_view label) const { return table_(0, variable_.index_of(label)); }

  /// Itself: generic code need not ask whether a composition was only induced.
  const Distribution& normalized() const& { return *this; }
  Distribution normalized() && { return std::move(*this); }

 private:
  Variable<Kind> variable_;
  Table table_;
};

/// The conditional of weights that are finite, not negative and not all zero: for a random or fuzzy variable the
/// distribution in proportion to them. Those of an ordinal one are at most one. Throws std::invalid_argument otherwise.
template <Uncertainty Kind>
Distribution<Kind> normalized(Variable<Kind> variable, std::span<const double> weights) {
  check::size(variable, {}, weights.size());
  check::values(variable, {}, weights, Weight<AlgebraOf<Kind>>::greatest_value);
  if (total<Fuzzy>(weights) == 0.0)
    throw std::invalid_argument("every weight of variable '" + variable.name() + "' is zero");
  Table table(1, weights.size());
  std::copy(weights.begin(), weights.end(), table.data());
  condition<AlgebraOf<Kind>>(table.values());
  return {std::move(variable), std::move(table), ByLaw{}};
}

/// What is known of a variable before anything is known: 1/n each for a random, one each for any other variable.
template <Uncertainty Kind>
Distribution<Kind> uninformative(Variable<Kind> variable) {
  Table shares(1, variable.size(), equal_share<AlgebraOf<Kind>>(variable.size()));
  return {std::move(variable), std::move(shares), ByLaw{}};
}

/// Index of the greatest value, the lowest on a tie.
inline std::size_t index_of_greatest(std::span<const double> values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// Label of the most probable or most possible outcome; on a tie the first declared.
template <Uncertainty Kind>
std::string most_likely(const Distribution<Kind>& distribution) {
  return distribution.variable().label(index_of_greatest(distribution.values()));
}

}  // namespace sigmax
