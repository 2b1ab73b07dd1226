#pragma once

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/core/likelihood.hpp>

namespace sigmax {

/// The numbers p(to|from) or π(to|from), one row per outcome of `from`: what Relation and Induced<Relation> share.
template <Uncertainty To, Uncertainty From>
  requires Mixable<To, From>
class ConditionalTable {
 public:
  using to_kind = To;
  using from_kind = From;

  const Variable<To>& to() const { return to_; }
  const Variable<From>& from() const { return from_; }
  const Table& table() const { return table_; }

  /// The numbers, for a verb that writes its result here; it alone knows by which law they are right.
  Table& table(ByLaw) { return table_; }

  /// p(to|from) by index: `from` first, as the table is written.
  double operator()(std::size_t from, std::size_t to) const { return table_(from, to); }
  std::span<const double> row(std::size_t from) const { return table_.row(from); }

  /// The column of one outcome of `to`, read as a function of `from`: a likelihood, hence without normalisation.
  Likelihood<From> likelihood(std::string_view to) const { return likelihood(to_.index_of(to)); }
  Likelihood<From> likelihood(std::size_t to) const {
    to_.label(to);  // throws if there is no such outcome
    std::vector<double> column(from_.size());
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = table_(i, to);
    return {from_, column};
  }

 protected:
  ConditionalTable(Variable<To> to, Variable<From> from, Table table)
      : to_(std::move(to)), from_(std::move(from)), table_(std::move(table)) {}

  Variable<To> to_;
  Variable<From> from_;
  Table table_;
};

/// A normalised relation, read "to given from": every row is a distribution of `to`.
///
///     const Relation mood_given_age{mood, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};   // a row per age; max = 1
///
/// The constructor proves each row (⊕ = 1 to within 1e-9, values in [0, 1]) and stores the values unchanged. `to` and
/// `from` may be the same variable: a transition, (49), (50).
template <Uncertainty To, Uncertainty From>
  requires Mixable<To, From>
class Relation : public ConditionalTable<To, From> {
 public:
  using Rows = std::initializer_list<std::initializer_list<double>>;

  /// Throws std::invalid_argument, naming variable, row and value, if a row is not a distribution of `to`.
  Relation(Variable<To> to, Variable<From> from, Rows rows)
      : Relation(std::move(to), std::move(from), std::vector<std::vector<double>>(rows.begin(), rows.end())) {}
  Relation(Variable<To> to, Variable<From> from, const std::vector<std::vector<double>>& rows)
      : ConditionalTable<To, From>(std::move(to), std::move(from), Table(0, 0)) {
    if (rows.size() != this->from_.size())
      throw std::invalid_argument("the relation '" + this->to_.name() + "' given '" + this->from_.name() + "' needs " +
                                  std::to_string(this->from_.size()) + " rows, but " + std::to_string(rows.size()) +
                                  " were given");
    this->table_ = Table(this->from_.size(), this->to_.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      prove_normalized<To>(this->to_, {&this->from_, i}, rows[i]);
      std::copy(rows[i].begin(), rows[i].end(), this->table_.row(i).begin());
    }
  }

  Relation(Variable<To> to, Variable<From> from, Table table, ByLaw)
      : ConditionalTable<To, From>(std::move(to), std::move(from), std::move(table)) {
    assert(this->table_.rows() == this->from_.size() && this->table_.columns() == this->to_.size());
  }

  /// The distribution of `to` when `from` has this outcome.
  Distribution<To> given(std::string_view from) const { return given(this->from_.index_of(from)); }
  Distribution<To> given(std::size_t from) const {
    this->from_.label(from);  // throws if there is no such outcome
    Table row(1, this->to_.size());
    std::copy_n(this->row(from).begin(), row.size(), row.data());
    return {this->to_, std::move(row), ByLaw{}};
  }

  /// Itself: generic code need not ask whether a composition was only induced.
  const Relation& normalized() const& { return *this; }
  Relation normalized() && { return std::move(*this); }
};

template <Uncertainty To, Uncertainty From>
Relation(Variable<To>, Variable<From>, std::initializer_list<std::initializer_list<double>>) -> Relation<To, From>;

}  // namespace sigmax
