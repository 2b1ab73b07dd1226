#include <sigmax/core/forward_backward.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include <sigmax/core/kernels/compose.hpp>

#include "algebras.hpp"
#include "exponents.hpp"
#include "kernels/transpose.hpp"
#include "kernels/unbounded_row.hpp"

namespace sigmax::detail {
namespace {

using kernels::number_of;
using Report = kernels::Evidence;
using Reports = std::span<const Report>;
using Transitions = std::span<const AnyRows* const>;

/// Both passes by plain doubles, each row in units of a power of two, as long as everything that is multiplied lies
/// within 300 powers of two: then no product of three underflows.
template <class A>
class ForwardBackward {
 public:
  ForwardBackward(A algebra, const AnyAlgebra& any) : algebra_(algebra), any_(&any) {}

  /// Whether the range sufficed. The first row of `table` is the start, and all rows are posteriors in the end. If the
  /// total is zero, they are not.
  bool run(Transitions transitions, Reports reports, Table& table, ScaledNumber& total) {
    const std::size_t times = table.rows(), n = table.columns();
    Table weights(reports.size(), n), row(1, n), next(1, n);
    std::copy_n(table.data(), n, row.data());
    if (!settle(row.values())) return false;
    for (std::size_t t = 0; t + 1 < times; ++t) {
      if (!is_shallow(*transitions[t]) || !take(reports[t], weights.row(t))) return false;
      kernels::compose(*any_, *transitions[t], row, next);
      multiply(next.values(), weights.row(t));
      if (!settle(next.values())) return false;
      std::copy_n(next.data(), n, table.row(t + 1).data());
      std::swap(row, next);
    }
    total = ScaledNumber{sigmax::detail::total(algebra_, row.values()), exponent_};
    if (total.is_zero()) return true;
    divide(table.row(times - 1));
    std::fill_n(row.data(), n, 1.0);
    for (std::size_t t = times - 1; t-- > 0;) {
      multiply(row.values(), weights.row(t));
      kernels::compose(*any_, columns_of(*transitions[t]), row, next);
      if (!settle(next.values())) return false;
      std::swap(row, next);
      multiply(table.row(t), row.values());
      divide(table.row(t));
    }
    return true;
  }

 private:
  static constexpr std::int64_t deepest = 300;

  static void multiply(std::span<double> row, std::span<const double> by) {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] *= by[i];
  }
  void divide(std::span<double> row) const {
    const double sum = sigmax::detail::total(algebra_, row);
    for (double& value : row) value = algebra_.divide(value, sum);
  }

  bool settle(std::span<double> row) {
    const auto [top, depth] = exponents_of(row);
    if (depth > deepest) return false;
    const auto unit = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - top) << 52);  // 2^−top
    for (double& value : row) value *= unit;
    exponent_ += top;
    return true;
  }

  bool take(const Report& report, std::span<double> weights) {
    numbers_.resize(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) numbers_[i] = number_of(report, i);
    const auto [top, depth] = exponents_of(numbers_);
    if (depth > deepest) return false;
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = numbers_[i].normal_value_in_units_of(top);
    exponent_ += top;
    return true;
  }

  /// Of numbers that are at most one.
  bool is_shallow(const AnyRows& rows) {
    if (&rows == looked_at_) return true;
    looked_at_ = &rows;
    for (const std::size_t r : stored_rows(rows))
      if (const auto [top, depth] = exponents_of(entries_of(rows, r).values); depth - top > deepest) return false;
    return true;
  }

  const AnyRows& columns_of(const AnyRows& rows) {
    if (&rows != transposed_) kernels::transpose(rows, columns_);
    transposed_ = &rows;
    return columns_;
  }

  A algebra_;
  const AnyAlgebra* any_;
  std::int64_t exponent_ = 0;  // of all units so far
  const AnyRows* looked_at_ = nullptr;
  const AnyRows* transposed_ = nullptr;
  AnyRows columns_ = Table(0, 0);
  std::vector<ScaledNumber> numbers_;  // of a report
};

/// The same where each number has an exponent of its own. Throws std::domain_error, naming the step, if the reports up
/// to it exclude every outcome.
void run_without_bounds(const Outcomes& variable, const AnyAlgebra& algebra, Transitions transitions, Reports reports,
                        Table& table, ScaledNumber& total) {
  using Row = kernels::UnboundedRow;
  const std::size_t times = table.rows(), n = table.columns();
  std::vector<Row> forward(times);
  forward[0] = Row(table.row(0));
  for (std::size_t t = 0; t + 1 < times; ++t) {
    forward[t + 1].assign_composition(*transitions[t], forward[t], algebra, nullptr);
    for (std::size_t i = 0; i < n; ++i) forward[t + 1][i] = forward[t + 1][i] * number_of(reports[t], i);
    if (forward[t + 1].is_zero())
      throw std::domain_error("the evidence up to step " + std::to_string(t + 1) +
                              " excludes every outcome of variable '" + variable.name() + "'");
  }
  total = forward[times - 1].total(algebra);
  Row after(n, 1.0), before;
  for (std::size_t t = times; t-- > 0;) {
    Row& row = forward[t];
    for (std::size_t i = 0; i < n; ++i) row[i] = row[i] * after[i];
    const Table posterior = row.conditioned(algebra);
    std::copy_n(posterior.data(), n, table.row(t).begin());
    if (t == 0) return;
    for (std::size_t i = 0; i < n; ++i) after[i] = after[i] * number_of(reports[t - 1], i);
    before.assign_carried_back(*transitions[t - 1], after, algebra);
    std::swap(after, before);
  }
}

}  // namespace

Posteriors forward_backward(const Outcomes& variable, std::span<const double> start, Transitions transitions,
                            Reports reports, const AnyAlgebra& algebra) {
  const auto begin = [&] {
    Table table(reports.size() + 1, start.size());
    std::copy(start.begin(), start.end(), table.row(0).begin());
    return table;
  };
  Table table = begin();
  ScaledNumber total;
  const bool sufficed = with_scaling(
      algebra, [&](auto a) { return ForwardBackward(a, algebra).run(transitions, reports, table, total); });
  if (!sufficed || total.is_zero()) run_without_bounds(variable, algebra, transitions, reports, table = begin(), total);
  return {std::move(table), total.log()};
}

Table row_at(const Table& table, std::size_t time) {
  if (time >= table.rows())
    throw std::invalid_argument("time " + std::to_string(time) + " of a chain of " + std::to_string(table.rows()) +
                                " times");
  Table row(1, table.columns());
  std::copy_n(table.row(time).begin(), row.columns(), row.data());
  return row;
}

void check_reports(std::size_t transitions, std::size_t reports) {
  if (transitions != reports)
    throw std::invalid_argument("forward_backward: " + std::to_string(transitions) + " transitions, but " +
                                std::to_string(reports) + " reports");
}

}  // namespace sigmax::detail
