#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/relation.hpp>

namespace sigmax {

/// What eliminating a variable of the other kind leaves, p⁺ or π⁺ of (15)–(18): not normalised, and never silently so.
/// The caller says which reading is meant: `.normalized()` divides by β, `.likelihood(…)` does not.
template <class T>
class Induced;

/// An induced distribution, (15), (16).
template <Uncertainty Kind>
class Induced<Distribution<Kind>> {
 public:
  using kind = Kind;

  Induced(Variable<Kind> variable, Table table, detail::ByLaw)
      : variable_(std::move(variable)), table_(std::move(table)) {}

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  const Table& table() const& { return table_; }
  Table table() && { return std::move(table_); }
  Table& table(detail::ByLaw) & { return table_; }

  /// A view that lives as long as this; of a temporary, a copy.
  std::span<const double> values() const& { return table_.values(); }
  std::vector<double> values() const&& { return Table(table_).values(); }
  double operator[](std::size_t index) const { return table_(0, index); }
  double operator[](std::string_view label) const { return table_(0, variable_.index_of(label)); }

  /// The normalisation factor β of (16): the ⊕ of the values.
  double beta() const { return total<Kind>(values()); }

  /// The distribution reading, (16). Throws std::domain_error if every value is zero.
  Distribution<Kind> normalized() const {
    if (beta() == 0.0) check::excluded(variable_);
    return sigmax::normalized(variable_, values());
  }

 private:
  Variable<Kind> variable_;
  Table table_;
};

/// An induced relation, (17), (18).
template <Uncertainty To, Uncertainty From>
class Induced<Relation<To, From>> : public ConditionalTable<To, From> {
 public:
  Induced(Variable<To> to, Variable<From> from, AnyRows rows, detail::ByLaw)
      : ConditionalTable<To, From>(std::move(to), std::move(from), std::move(rows)) {}

  /// The normalisation factors β, one for each outcome of `from`: they differ.
  double beta(std::size_t from) const { return total<To>(detail::entries_of(this->rows_, from).values); }
  std::vector<double> betas() const {
    std::vector<double> all(this->from_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = beta(i);
    return all;
  }

  /// The distribution reading of (17), (18): every row divided by its β. Throws std::domain_error if a row is all zero.
  Relation<To, From> normalized() const {
    AnyRows rows = this->rows_;
    for (std::size_t i = 0; i < this->from_.size(); ++i) {
      if (beta(i) == 0.0) check::excluded(this->to_, {&this->from_, i});
      condition<AlgebraOf<To>>(detail::values_of(rows, i));
    }
    return {this->to_, this->from_, std::move(rows), detail::ByLaw{}};
  }
};

template <class T>
inline constexpr bool is_induced = false;
template <class T>
inline constexpr bool is_induced<Induced<T>> = true;

}  // namespace sigmax
