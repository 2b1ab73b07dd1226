#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/rows.hpp>

namespace sigmax {

/// The numbers p(to|from) or π(to|from), one row per outcome of `from`: what Relation and Induced<Relation> share.
template <Uncertainty To, Uncertainty From>
  requires Mixable<To, From>
class ConditionalTable {
 public:
  using to_kind = To;
  using from_kind = From;

  const Variable<To>& to() const& { return to_; }
  Variable<To> to() const&& { return to_; }
  const Variable<From>& from() const& { return from_; }
  Variable<From> from() const&& { return from_; }

  /// How the rows are stored: dense, sparse or banded, as they were given or as fits what they were computed from.
  const AnyRows& rows() const& { return rows_; }
  AnyRows rows() && { return std::move(rows_); }

  /// The same, for a verb that writes its result here; it alone knows by which law the numbers are right.
  AnyRows& rows(detail::ByLaw) & { return rows_; }

  /// The table of a dense relation. Throws std::invalid_argument, naming it, if it is not: see `dense`, `for_each`.
  /// This and `row` are views that live as long as the relation; of a temporary, copies.
  const Table& table() const& {
    if (const Table* const table = std::get_if<Table>(&rows_)) return *table;
    throw std::invalid_argument("'" + to_.name() + "' given '" + from_.name() +
                                "' is stored sparsely, not as a table; call dense() first");
  }
  Table table() const&& {
    const ConditionalTable& named = *this;
    return named.table();
  }

  /// p(to|from) by index: `from` first, as the table is written. `at` throws std::invalid_argument if there is no such
  /// index, () does not look.
  double operator()(std::size_t from, std::size_t to) const {
    if (const Table* const table = std::get_if<Table>(&rows_)) return (*table)(from, to);
    return std::visit([&](const auto& rows) { return rows.at(from, to); }, rows_);
  }

  double at(std::size_t from, std::size_t to) const {
    check::index(from_, from);
    check::index(to_, to);
    return (*this)(from, to);
  }

  /// One row of a dense relation. Throws std::invalid_argument if there is no such row.
  std::span<const double> row(std::size_t from) const& {
    check::index(from_, from);
    return table().row(from);
  }
  std::vector<double> row(std::size_t from) const&& {
    const auto view = static_cast<const ConditionalTable&>(*this).row(from);
    return {view.begin(), view.end()};
  }

  /// action(to, value) for every number that row `from` stores, `to` ascending; what it does not store is zero.
  ///
  ///     cell_given_cell.for_each(17, [](std::size_t to, double p) { … });
  template <class Action>
  void for_each(std::size_t from, const Action& action) const {
    std::visit(
        [&](const auto& rows) {
          const auto entries = rows.entries(from);
          for (std::size_t k = 0; k < entries.size(); ++k) action(entries.index(k), entries.value(k));
        },
        rows_);
  }

  /// The column of one outcome of `to`, read as a function of `from`: a likelihood, hence without normalisation.
  Likelihood<From> likelihood(std::string_view to) const { return likelihood(to_.index_of(to)); }
  Likelihood<From> likelihood(std::size_t to) const {
    check::index(to_, to);
    std::vector<double> column(from_.size());
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = (*this)(i, to);
    return {from_, column};
  }

 protected:
  ConditionalTable(Variable<To> to, Variable<From> from, AnyRows rows)
      : to_(std::move(to)), from_(std::move(from)), rows_(std::move(rows)) {}

  Variable<To> to_;
  Variable<From> from_;
  AnyRows rows_;
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
    check::rows(this->to_, this->from_, rows.size());
    Table table(this->from_.size(), this->to_.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      prove_normalized<To>(this->to_, {&this->from_, i}, rows[i]);
      std::copy(rows[i].begin(), rows[i].end(), table.row(i).begin());
    }
    this->rows_ = std::move(table);
  }

  /// The same of rows that store only some of their numbers; what they do not is zero. It is used like any other.
  ///
  ///     Relation{cell, cell, SparseRows{{{0, 0.9}, {7, 0.1}}, …}}   // a row per condition: outcome, value
  ///     Relation{cell, cell, BandedRows{{0, {0.9, 0.1}}, …}}        // a row per condition: from this outcome on
  Relation(Variable<To> to, Variable<From> from, SparseRows rows)
      : ConditionalTable<To, From>(std::move(to), std::move(from), Table(0, 0)) {
    this->rows_ = proved(std::move(rows));
  }
  Relation(Variable<To> to, Variable<From> from, BandedRows rows)
      : ConditionalTable<To, From>(std::move(to), std::move(from), Table(0, 0)) {
    this->rows_ = proved(std::move(rows));
  }

  Relation(Variable<To> to, Variable<From> from, AnyRows rows, detail::ByLaw)
      : ConditionalTable<To, From>(std::move(to), std::move(from), std::move(rows)) {
    assert(std::visit([](const auto& stored) { return stored.rows(); }, this->rows_) == this->from_.size());
    assert(std::visit([](const auto& stored) { return stored.columns(); }, this->rows_) == this->to_.size());
    assert(is_normalized());
  }

  /// The distribution of `to` when `from` has this outcome.
  Distribution<To> given(std::string_view from) const { return given(this->from_.index_of(from)); }
  Distribution<To> given(std::size_t from) const {
    check::index(this->from_, from);
    Table row(1, this->to_.size());
    this->for_each(from, [&](std::size_t to, double value) { row(0, to) = value; });
    return {this->to_, std::move(row), detail::ByLaw{}};
  }

  /// Itself: generic code need not ask whether a composition was only induced.
  const Relation& normalized() const& { return *this; }
  Relation normalized() && { return std::move(*this); }

  /// The same relation stored as a dense table.
  Relation dense() const {
    return {this->to_, this->from_, std::visit([](const auto& rows) { return dense_table(rows); }, this->rows_),
            detail::ByLaw{}};
  }

  /// Whether the variables and all numbers are the same, however they are stored.
  friend bool operator==(const Relation& a, const Relation& b) {
    if (!(a.to_ == b.to_ && a.from_ == b.from_)) return false;
    for (std::size_t i = 0; i < a.from_.size(); ++i)
      if (!(a.given(i) == b.given(i))) return false;
    return true;
  }

 private:
  bool is_normalized() const {
    bool all = true;
    const auto each = [&all](const auto& rows) {
      detail::for_each_stored_row(rows, [&](std::size_t r) {
        all = all && std::abs(total<To>(rows.entries(r).values) - 1.0) <= 4.0 * normalization_tolerance;
      });
    };
    std::visit(each, this->rows_);
    return all;
  }

  template <class SomeRows>
  SomeRows proved(SomeRows rows) const {
    check::rows(this->to_, this->from_, rows.rows());
    for (std::size_t i = 0; i < rows.rows(); ++i)
      prove_entries_normalized<To>(this->to_, {&this->from_, i}, rows.entries(i));
    rows.widen(this->to_.size());
    return rows;
  }
};

/// The relation whose rows are in proportion to these weights: counts, or numbers of any precision. Throws
/// std::invalid_argument, naming variable, row and value, as `normalized` of one row does.
///
///     normalized(reading, target, std::vector<std::vector<int>>{{17, 3}, {2, 8}})
template <Uncertainty To, Uncertainty From, class Number>
  requires std::is_arithmetic_v<Number> Relation<To, From> normalized(const Variable<To>& to,
                                                                      const Variable<From>& from,
                                                                      const std::vector<std::vector<Number>>& rows) {
    check::rows(to, from, rows.size());
    Table table(from.size(), to.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      check::size(to, {&from, i}, rows[i].size());
      const std::span<double> row = table.row(i);
      for (std::size_t k = 0; k < row.size(); ++k) row[k] = static_cast<double>(rows[i][k]);
      detail::prove_weights<AlgebraOf<To>>(to, {&from, i}, row);
      condition<AlgebraOf<To>>(row);
    }
    return {to, from, std::move(table), detail::ByLaw{}};
  }

/// A line per row: "mood given age = young: calm 0.3, wild 1".
template <Uncertainty To, Uncertainty From>
std::ostream& operator<<(std::ostream& out, const Relation<To, From>& relation) {
  for (std::size_t i = 0; i < relation.from().size(); ++i) {
    out << relation.to().name() << " given " << relation.from().name() << " = " << relation.from().label(i) << ':';
    const char* separator = " ";
    relation.for_each(i, [&](std::size_t to, double value) {
      out << std::exchange(separator, ", ") << relation.to().label(to) << ' ' << value;
    });
    out << '\n';
  }
  return out;
}

template <Uncertainty To, Uncertainty From>
Relation(Variable<To>, Variable<From>, std::initializer_list<std::initializer_list<double>>) -> Relation<To, From>;

}  // namespace sigmax
