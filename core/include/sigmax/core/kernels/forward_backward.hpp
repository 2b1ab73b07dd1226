#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/condition.hpp>
#include <sigmax/core/kernels/compose.hpp>
#include <sigmax/core/kernels/transpose.hpp>
#include <sigmax/core/kernels/unbounded_row.hpp>
#include <sigmax/core/scaled_number.hpp>

namespace sigmax::kernels {

/// The exponent of the greatest number, and how far below it that of the least one is that is not zero.
struct ExponentRange {
  std::int64_t top = 0, depth = 0;
};
inline ExponentRange exponent_range(std::span<const double> numbers) {
  std::uint64_t most = 0, least = ~std::uint64_t{0};
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number) << 1 >> 1;  // without the sign that zero may have
    most = std::max(most, bits);
    least = std::min(least, bits - 1);  // that of zero is the greatest there is
  }
  if (most == 0) return {};
  const auto exponent = [](std::uint64_t bits) { return static_cast<std::int64_t>(bits >> 52) - 1022; };
  return {exponent(most), exponent(most) - exponent(least + 1)};
}

/// Both passes by plain doubles, each row in units of a power of two, as long as everything that is multiplied lies
/// within 300 powers of two: then no product of three underflows.
template <ScalingAlgebra A>
class ForwardBackward {
 public:
  /// Whether the range sufficed. `transition(t)` leads from time t to t + 1, where reports[t] is about the variable;
  /// the first row of `table` is the start, and all rows are its posteriors in the end. If the total is zero, they are
  /// not.
  template <class Transition, class Reports>
  bool run(const Transition& transition, const Reports& reports, Table& table, ScaledNumber& total) {
    const std::size_t times = table.rows(), n = table.columns();
    Table weights(reports.size(), n), row(1, n), next(1, n);
    std::copy_n(table.data(), n, row.data());
    if (!settle(row.values())) return false;
    for (std::size_t t = 0; t + 1 < times; ++t) {
      if (!is_shallow(transition(t)) || !take(reports[t], weights.row(t))) return false;
      compose<A>(transition(t), row, next);
      multiply(next.values(), weights.row(t));
      if (!settle(next.values())) return false;
      std::copy_n(next.data(), n, table.row(t + 1).data());
      std::swap(row, next);
    }
    total = ScaledNumber{sigmax::detail::total<A>(row.values()), exponent_};
    if (total.is_zero()) return true;
    divide(table.row(times - 1));
    std::fill_n(row.data(), n, 1.0);
    for (std::size_t t = times - 1; t-- > 0;) {
      multiply(row.values(), weights.row(t));
      compose<A>(columns_of(transition(t)), row, next);
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
  static void divide(std::span<double> row) {
    const double sum = sigmax::detail::total<A>(row);
    for (double& value : row) value = A::divide(value, sum);
  }

  bool settle(std::span<double> row) {
    const auto [top, depth] = exponent_range(row);
    if (depth > deepest) return false;
    const auto unit = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - top) << 52);  // 2^−top
    for (double& value : row) value *= unit;
    exponent_ += top;
    return true;
  }

  template <class Report>
  bool take(const Report& report, std::span<double> weights) {
    constexpr auto beyond = std::numeric_limits<std::int64_t>::max() / 4;
    std::int64_t most = -beyond, least = beyond;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const ScaledNumber number = report.number(i);
      if (number.is_zero()) continue;
      most = std::max(most, number.exponent());
      least = std::min(least, number.exponent());
    }
    if (most - least > deepest) return false;
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = report.number(i).normal_value_in_units_of(most);
    if (most != -beyond) exponent_ += most;
    return true;
  }

  /// Of numbers that are at most one.
  bool is_shallow(const AnyRows& rows) {
    if (&rows == looked_at_) return true;
    looked_at_ = &rows;
    return std::visit(
        [](const auto& stored) {
          for (std::size_t r = 0; r < stored.rows(); ++r)
            if (const auto [top, depth] = exponent_range(stored.entries(r).values); depth - top > deepest) return false;
          return true;
        },
        rows);
  }

  const AnyRows& columns_of(const AnyRows& rows) {
    if (&rows != transposed_) transpose(rows, columns_);
    transposed_ = &rows;
    return columns_;
  }

  std::int64_t exponent_ = 0;  // of all units so far
  const AnyRows* looked_at_ = nullptr;
  const AnyRows* transposed_ = nullptr;
  AnyRows columns_ = Table(0, 0);
};

/// The same where each number has an exponent of its own.
template <ScalingAlgebra A, class Transition, class Reports>
void forward_backward_without_bounds(const Transition& transition, const Reports& reports, Table& table,
                                     ScaledNumber& total) {
  using Row = UnboundedRow;
  const std::size_t times = table.rows(), n = table.columns();
  NoWinners none;
  std::vector<Row> forward(times);
  forward[0] = Row(table.row(0));
  for (std::size_t t = 0; t + 1 < times; ++t) {
    std::visit([&](const auto& rows) { forward[t + 1].template assign_composition<A>(rows, forward[t], none); },
               transition(t));
    for (std::size_t i = 0; i < n; ++i) forward[t + 1][i] = forward[t + 1][i] * reports[t].number(i);
  }
  total = ScaledNumber{};
  for (std::size_t i = 0; i < n; ++i) total = ScaledNumber::plus<A>(total, forward[times - 1][i]);
  if (total.is_zero()) return;
  Row after(n, 1.0), before;
  for (std::size_t t = times; t-- > 0;) {
    Row& row = forward[t];
    for (std::size_t i = 0; i < n; ++i) row[i] = row[i] * after[i];
    row.to_values(table.row(t));
    condition<A>(table.row(t));
    if (t == 0) return;
    for (std::size_t i = 0; i < n; ++i) after[i] = after[i] * reports[t - 1].number(i);
    std::visit([&](const auto& rows) { before.assign_carried_back<A>(rows, after); }, transition(t - 1));
    std::swap(after, before);
  }
}

}  // namespace sigmax::kernels
