#pragma once

#include <algorithm>
#include <cmath>

#include "eliminate.hpp"

namespace sigmax::detail {

inline constexpr int most_sweeps = 300;
inline constexpr double message_tolerance = 1e-12;  // relative change of a message by which they count as settled

/// A number that may be divided by: messages about what cannot be otherwise grow without bounds.
inline double bounded(double number) { return std::clamp(number, 1e-300, 1e300); }

/// ⊕ of `first` and all numbers but one, for each of them.
template <class A>
void all_but_one(A algebra, double first, std::span<const double> numbers, std::vector<double>& result) {
  result.resize(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); first = algebra.plus(first, numbers[k++])) result[k] = first;
  double after = algebra.zero();
  for (std::size_t k = numbers.size(); k-- > 0; after = algebra.plus(after, numbers[k]))
    result[k] = algebra.plus(result[k], after);
}

/// Maxima over events, exact as well: what the shortest alternating path through a choice costs.
inline EventTotals maximize(const Choices& costs, AlternatingPaths& paths) {
  EventTotals result{0.0, std::vector<double>(costs.size() + costs.rows(), 0.0)};
  for (std::size_t node = 0; node <= costs.rows(); ++node) {
    if (node < costs.rows() && paths.choice(node) == no_column) continue;
    paths.search_all(node);
    const auto note = [&](std::size_t row, std::size_t column, double cost, double& log) {
      if (paths.choice(row) != column && paths.loser(column) == node)
        log = -(paths.reduced(row, column, cost) + paths.distance(row));
    };
    for (std::size_t row = 0; row < costs.rows(); ++row) {
      const auto entries = costs.entries(row);
      for (std::size_t k = 0; k < entries.size(); ++k)
        note(row, entries.index(k), entries.value(k), result.log_marginals[costs.offset(row) + k]);
      note(row, no_column, costs.none(row), result.log_marginals[costs.size() + row]);
    }
  }
  return result;
}

/// Message passing with one ⊕, Williams and Lau (2014): exact on trees. Its total is the Bethe approximation.
/// Weights are scaled by the potentials of the best event, so that none exceeds one: of a choice exp(−reduced cost), of
/// a column that stays free exp(its potential). A message is a ratio, of taking a column to not taking it.
inline EventTotals pass_messages(const Choices& costs, const AlternatingPaths& paths, const AnyAlgebra& any) {
  return with_scaling(any, [&](auto algebra) {
    const std::size_t rows = costs.rows(), columns = costs.columns(), size = costs.size();
    std::vector<double> weight(size), none(rows), free(columns), to_column(size), to_row(size, 1.0), in, out;
    std::vector<std::vector<std::size_t>> entries_of(columns);
    for (std::size_t row = 0; row < rows; ++row) {
      const auto entries = costs.entries(row);
      none[row] = std::exp(-paths.reduced(row, no_column, costs.none(row)));
      for (std::size_t k = 0; k < entries.size(); ++k) {
        weight[costs.offset(row) + k] = std::exp(-paths.reduced(row, entries.index(k), entries.value(k)));
        entries_of[entries.index(k)].push_back(costs.offset(row) + k);
      }
    }
    for (std::size_t column = 0; column < columns; ++column) free[column] = std::exp(-paths.price(column));
    double log_total = 0.0;
    const auto sweep = [&](bool total) {
      double change = 0.0;
      for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t first = costs.offset(row);
        in.clear();
        for (std::size_t entry = first; entry < first + costs.entries(row).size(); ++entry)
          in.push_back(weight[entry] * to_row[entry]);
        all_but_one(algebra, none[row], in, out);
        for (std::size_t k = 0; k < in.size(); ++k) to_column[first + k] = bounded(weight[first + k] / bounded(out[k]));
        if (total) log_total += std::log(in.empty() ? none[row] : algebra.plus(out[0], in[0]));
      }
      for (std::size_t column = 0; column < columns; ++column) {
        in.clear();
        for (const std::size_t entry : entries_of[column]) in.push_back(to_column[entry]);
        all_but_one(algebra, free[column], in, out);
        if (total) log_total += std::log(algebra.plus(out[0], in[0]));
        for (std::size_t k = 0; k < in.size(); ++k) {
          double& message = to_row[entries_of[column][k]];
          const double next = 1.0 / bounded(out[k]);
          if (total) log_total -= std::log(algebra.plus(1.0, in[k] * message));
          change = std::max(change, std::abs(next - message) / next);
          message = next;
        }
      }
      return change;
    };
    for (int count = 0; count < most_sweeps && sweep(false) > message_tolerance;) ++count;
    sweep(true);
    EventTotals result{log_total, std::vector<double>(size + rows)};
    for (std::size_t row = 0; row < rows; ++row) {
      double sum = none[row];
      const std::size_t first = costs.offset(row), end = first + costs.entries(row).size();
      for (std::size_t entry = first; entry < end; ++entry) sum = algebra.plus(sum, weight[entry] * to_row[entry]);
      for (std::size_t entry = first; entry < end; ++entry)
        result.log_marginals[entry] = std::log(weight[entry] * to_row[entry] / sum);
      result.log_marginals[size + row] = std::log(none[row] / sum);
    }
    return result;
  });
}

}  // namespace sigmax::detail
