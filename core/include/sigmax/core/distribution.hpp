#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <sigmax/core/check.hpp>
#include <sigmax/core/condition.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/core/variable.hpp>

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

  Distribution(Variable<Kind> variable, Table table, detail::ByLaw)
      : variable_(std::move(variable)), table_(std::move(table)) {
    assert(std::abs(total<Kind>(values()) - 1.0) <= 4.0 * normalization_tolerance);
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return table_.size(); }
  const Table& table() const& { return table_; }
  Table table() && { return std::move(table_); }
  Table& table(detail::ByLaw) & { return table_; }

  /// The numbers in the order of the outcomes: a view that lives as long as the distribution; of a temporary, a copy.
  std::span<const double> values() const& { return table_.values(); }
  std::vector<double> values() const&& { return std::vector<double>(begin(), end()); }
  const double* begin() const& { return table_.data(); }
  const double* end() const& { return table_.data() + size(); }
  const double* begin() const&& = delete;
  const double* end() const&& = delete;

  /// The number of one outcome; `at` throws std::invalid_argument if there is no such index, [] does not look.
  double operator[](std::size_t index) const { return table_(0, index); }
  double operator[](std::string_view label) const { return table_(0, variable_.index_of(label)); }
  double at(std::size_t index) const {
    check::index(variable_, index);
    return table_(0, index);
  }

  /// Whether the variables and all numbers are the same.
  friend bool operator==(const Distribution& a, const Distribution& b) {
    return a.variable_ == b.variable_ && std::equal(a.begin(), a.end(), b.begin());
  }

  /// Itself: generic code need not ask whether a composition was only induced.
  const Distribution& normalized() const& { return *this; }
  Distribution normalized() && { return std::move(*this); }

 private:
  Variable<Kind> variable_;
  Table table_;
};

/// "age: young 0.5, middle 1, old 0.4", with the digits that the stream shows.
template <Uncertainty Kind>
std::ostream& operator<<(std::ostream& out, const Distribution<Kind>& distribution) {
  out << distribution.variable().name() << ':';
  for (std::size_t i = 0; i < distribution.size(); ++i)
    out << (i > 0 ? ", " : " ") << distribution.variable().label(i) << ' ' << distribution[i];
  return out;
}

namespace detail {

/// The greatest number that a weight or a likelihood may be: any where ⊗ scales, else one.
template <Algebra A>
inline constexpr double greatest_weight = ScalingAlgebra<A> ? std::numeric_limits<double>::max() : A::one();

/// Proves that weights are finite, not negative, not too great for their algebra and not all zero.
template <Algebra A>
void prove_weights(const Outcomes& variable, check::Row row, std::span<const double> weights) {
  check::values(variable, row, weights, greatest_weight<A>);
  check::some_positive(variable, row, weights);
}

}  // namespace detail

/// The conditional of weights that are finite, not negative and not all zero: for a random or fuzzy variable the
/// distribution in proportion to them. Those of an ordinal one are at most one. Throws std::invalid_argument otherwise.
template <Uncertainty Kind>
Distribution<Kind> normalized(Variable<Kind> variable, std::span<const double> weights) {
  check::size(variable, {}, weights.size());
  detail::prove_weights<AlgebraOf<Kind>>(variable, {}, weights);
  Table table(1, weights.size());
  std::copy(weights.begin(), weights.end(), table.data());
  condition<AlgebraOf<Kind>>(table.values());
  return {std::move(variable), std::move(table), detail::ByLaw{}};
}

/// The same of counts, or of numbers of another precision.
template <Uncertainty Kind, class Number>
  requires(std::is_arithmetic_v<Number>)
Distribution<Kind> normalized(Variable<Kind> variable, const std::vector<Number>& weights) {
  const std::vector<double> numbers(weights.begin(), weights.end());
  return normalized(std::move(variable), std::span(numbers));
}

/// What is known of a variable before anything is known: 1/n each for a random, one each for any other variable.
template <Uncertainty Kind>
Distribution<Kind> uninformative(Variable<Kind> variable) {
  Table shares(1, variable.size(), equal_share<AlgebraOf<Kind>>(variable.size()));
  return {std::move(variable), std::move(shares), detail::ByLaw{}};
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
