#pragma once

#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <iosfwd>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/rows.hpp>

namespace sigmax {

namespace detail {

/// Proves that a row that stores only some of its values is a distribution of `variable`.
void prove_entries(const Outcomes& variable, check::Row row, const AnyEntries& entries, const AnyAlgebra& algebra,
                   std::string_view name_of_total);

/// Whether rows are what the library's verbs promise: of the right shape, and distributions.
bool are_right(const Outcomes& to, const Outcomes& from, const AnyRows& rows, const AnyAlgebra& algebra);

/// The table of rows that are dense. Throws std::invalid_argument, naming the variables, if they are not.
const Table& table_of(const Outcomes& to, const Outcomes& from, const AnyRows& rows);

void write(std::ostream& out, const Outcomes& to, const Outcomes& from, const AnyRows& rows);

}  // namespace detail

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
  const Table& table() const& { return detail::table_of(to_, from_, rows_); }
  Table table() const&& { return detail::table_of(to_, from_, rows_); }

  /// p(to|from) by index: `from` first, as the table is written. `at` throws std::invalid_argument if there is no such
  /// index, () does not look.
  double operator()(std::size_t from, std::size_t to) const {
    if (const Table* const table = std::get_if<Table>(&rows_)) return (*table)(from, to);
    return detail::entries_of(rows_, from).at(to);
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
    const detail::AnyEntries entries = detail::entries_of(rows_, from);
    for (std::size_t k = 0; k < entries.size(); ++k) action(entries.index(k), entries.value(k));
  }

  /// The column of one outcome of `to`, read as a function of `from`: a likelihood, hence without normalisation.
  Likelihood<From> likelihood(std::string_view to) const { return likelihood(to_.index_of(to)); }
  Likelihood<From> likelihood(std::size_t to) const {
    check::index(to_, to);
    return {from_, detail::column_of(rows_, to)};
  }

 protected:
  ConditionalTable(Variable<To> to, Variable<From> from, AnyRows&& rows)
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
  Relation(const Variable<To>& to, const Variable<From>& from, Rows rows)
      : ConditionalTable<To, From>(to, from, proved(to, from, rows)) {}
  Relation(const Variable<To>& to, const Variable<From>& from, const std::vector<std::vector<double>>& rows)
      : ConditionalTable<To, From>(to, from, proved(to, from, rows)) {}

  /// The same of rows that store only some of their numbers; what they do not is zero. It is used like any other.
  ///
  ///     Relation{cell, cell, SparseRows{{{0, 0.9}, {7, 0.1}}, …}}   // a row per condition: outcome, value
  ///     Relation{cell, cell, BandedRows{{0, {0.9, 0.1}}, …}}        // a row per condition: from this outcome on
  Relation(const Variable<To>& to, const Variable<From>& from, SparseRows rows)
      : ConditionalTable<To, From>(to, from, proved_entries(to, from, std::move(rows))) {}
  Relation(const Variable<To>& to, const Variable<From>& from, BandedRows rows)
      : ConditionalTable<To, From>(to, from, proved_entries(to, from, std::move(rows))) {}

  Relation(Variable<To> to, Variable<From> from, AnyRows rows, detail::ByLaw)
      : ConditionalTable<To, From>(std::move(to), std::move(from), std::move(rows)) {
    assert(detail::are_right(this->to_, this->from_, this->rows(), detail::algebra_of<To>()));
  }

  /// The distribution of `to` when `from` has this outcome.
  Distribution<To> given(std::string_view from) const { return given(this->from_.index_of(from)); }
  Distribution<To> given(std::size_t from) const {
    check::index(this->from_, from);
    return {this->to_, detail::dense_row(this->rows(), from), detail::ByLaw{}};
  }

  /// Itself: generic code need not ask whether a composition was only induced.
  const Relation& normalized() const& { return *this; }
  Relation normalized() && { return std::move(*this); }

  /// The same relation stored as a dense table.
  Relation dense() const { return {this->to_, this->from_, dense_table(this->rows()), detail::ByLaw{}}; }

  /// Whether the variables and all numbers are the same, however they are stored.
  friend bool operator==(const Relation& a, const Relation& b) {
    return a.to_ == b.to_ && a.from_ == b.from_ && detail::same_numbers(a.rows(), b.rows());
  }

 private:
  template <class SomeRows>
  static Table proved(const Outcomes& to, const Outcomes& from, const SomeRows& rows) {
    check::rows(to, from, rows.size());
    Table table(from.size(), to.size());
    std::size_t i = 0;
    for (const auto& row : rows) {
      prove_normalized<To>(to, {&from, i}, {row.begin(), row.end()});
      for (double* out = table.row(i++).data(); const double value : row) *out++ = value;
    }
    return table;
  }
  template <class SomeRows>
  static SomeRows proved_entries(const Outcomes& to, const Outcomes& from, SomeRows rows) {
    check::rows(to, from, rows.rows());
    for (std::size_t i = 0; i < rows.rows(); ++i)
      detail::prove_entries(to, {&from, i}, rows.entries(i), detail::algebra_of<To>(), To::total);
    rows.widen(to.size());
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
      const std::vector<double> weights(rows[i].begin(), rows[i].end());
      check::size(to, {&from, i}, weights.size());
      check::weights(to, {&from, i}, weights, detail::algebra_of<To>());
      std::copy(weights.begin(), weights.end(), table.row(i).begin());
      condition<AlgebraOf<To>>(table.row(i));
    }
    return {to, from, std::move(table), detail::ByLaw{}};
  }

/// A line per row: "mood given age = young: calm 0.3, wild 1".
template <Uncertainty To, Uncertainty From>
std::ostream& operator<<(std::ostream& out, const Relation<To, From>& relation) {
  detail::write(out, relation.to(), relation.from(), relation.rows());
  return out;
}

template <Uncertainty To, Uncertainty From>
Relation(Variable<To>, Variable<From>, std::initializer_list<std::initializer_list<double>>) -> Relation<To, From>;

}  // namespace sigmax
