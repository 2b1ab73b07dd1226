#pragma once

#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <iosfwd>
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

/// Index of the greatest value, the lowest on a tie.
std::size_t index_of_greatest(std::span<const double> values);

namespace detail {

/// Whether the ⊕ of numbers is one, as far as what is right by law may be off.
bool is_normalized(std::span<const double> values, const AnyAlgebra& algebra);

/// Weights, turned into the distribution in proportion to them. Throws std::invalid_argument if there is none.
Table conditioned(const Outcomes& variable, std::span<const double> weights, const AnyAlgebra& algebra);

bool same_numbers(std::span<const double> a, std::span<const double> b);
void write(std::ostream& out, const Outcomes& variable, std::span<const double> values);

}  // namespace detail

/// A normalised distribution of one variable: p with Σ p = 1, (3), or π with max π = 1, (2).
///
/// The constructor proves |⊕ − 1| ≤ 1e-9 and every value in [0, 1], and stores the values unchanged.
template <Uncertainty Kind>
class Distribution {
 public:
  using kind = Kind;

  /// Throws std::invalid_argument, naming the variable and the value, if the values are not a distribution.
  Distribution(Variable<Kind> variable, std::initializer_list<double> values)
      : Distribution(std::move(variable), std::span<const double>(values.begin(), values.size())) {}
  Distribution(Variable<Kind> variable, const std::vector<double>& values)
      : Distribution(std::move(variable), std::span<const double>(values.data(), values.size())) {}
  Distribution(Variable<Kind> variable, std::span<const double> values)
      : variable_(std::move(variable)), table_(values) {
    prove_normalized<Kind>(variable_, {}, values);
  }

  Distribution(Variable<Kind> variable, Table table, detail::ByLaw)
      : variable_(std::move(variable)), table_(std::move(table)) {
    assert(detail::is_normalized(values(), detail::algebra_of<Kind>()));
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
    return a.variable_ == b.variable_ && detail::same_numbers(a.values(), b.values());
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
  detail::write(out, distribution.variable(), distribution.values());
  return out;
}

/// The conditional of weights that are finite, not negative and not all zero: for a random or fuzzy variable the
/// distribution in proportion to them. Those of an ordinal one are at most one. Throws std::invalid_argument otherwise.
template <Uncertainty Kind>
Distribution<Kind> normalized(Variable<Kind> variable, std::span<const double> weights) {
  Table table = detail::conditioned(variable, weights, detail::algebra_of<Kind>());
  return {std::move(variable), std::move(table), detail::ByLaw{}};
}

/// The same of counts, or of numbers of another precision.
template <Uncertainty Kind, class Number>
  requires(std::is_arithmetic_v<Number>)
Distribution<Kind> normalized(Variable<Kind> variable, const std::vector<Number>& weights) {
  const std::vector<double> numbers(weights.begin(), weights.end());
  return normalized(std::move(variable), std::span<const double>(numbers.data(), numbers.size()));
}

/// What is known of a variable before anything is known: 1/n each for a random, one each for any other variable.
template <Uncertainty Kind>
Distribution<Kind> uninformative(Variable<Kind> variable) {
  Table shares(1, variable.size(), equal_share<AlgebraOf<Kind>>(variable.size()));
  return {std::move(variable), std::move(shares), detail::ByLaw{}};
}

/// Label of the most probable or most possible outcome; on a tie the first declared.
template <Uncertainty Kind>
std::string most_likely(const Distribution<Kind>& distribution) {
  return distribution.variable().label(index_of_greatest(distribution.values()));
}

}  // namespace sigmax
