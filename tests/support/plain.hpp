#pragma once

#include "support/core.hpp"

/// The discrete calculus restated with plain loops over vectors: no code shared with the library. It runs in long
/// double, which holds the product of any two doubles.
namespace sigmax::plain {

using Numbers = std::vector<double>;
using Rows = std::vector<Numbers>;  // a row per outcome of the condition

enum class By { sum, max };

inline long double eliminate(By by, const std::vector<long double>& values) {
  long double result = 0;
  for (const long double value : values) {
    if (by == By::sum) result += value;
    if (by == By::max && value > result) result = value;
  }
  return result;
}

/// (6), (7), (17), (18) before β: from right(m|y) and left(x|m) the numbers (x|y).
inline Rows compose(By by, const Rows& left, const Rows& right) {
  Rows result;
  for (const Numbers& weights : right) {
    assert(weights.size() == left.size());
    Numbers row;
    for (std::size_t x = 0; x < left.front().size(); ++x) {
      std::vector<long double> terms;
      for (std::size_t m = 0; m < left.size(); ++m) terms.push_back(static_cast<long double>(left[m][x]) * weights[m]);
      row.push_back(static_cast<double>(eliminate(by, terms)));
    }
    result.push_back(row);
  }
  return result;
}

/// (5), (15) before β.
inline Numbers compose(By by, const Rows& left, const Numbers& right) { return compose(by, left, Rows{right}).front(); }

/// ⊕ of prior ⊗ likelihood: the denominator of (8), (19), (20), (41), (44).
inline long double evidence(By by, const Numbers& prior, const Numbers& likelihood) {
  std::vector<long double> terms;
  for (std::size_t i = 0; i < prior.size(); ++i) terms.push_back(static_cast<long double>(prior[i]) * likelihood[i]);
  return eliminate(by, terms);
}

/// (8), (19), (20), (41), (44).
inline Numbers update(By by, const Numbers& prior, const Numbers& likelihood) {
  const long double divisor = evidence(by, prior, likelihood);
  Numbers result;
  for (std::size_t i = 0; i < prior.size(); ++i)
    result.push_back(static_cast<double>(static_cast<long double>(prior[i]) * likelihood[i] / divisor));
  return result;
}

inline Numbers column(const Rows& rows, std::size_t c) {
  Numbers result;
  for (const Numbers& row : rows) result.push_back(row[c]);
  return result;
}

/// (43), (46): each row an update of the prior by one column; empty where nothing reaches.
inline Rows invert(By by, const Rows& relation, const Numbers& prior) {
  Rows result;
  for (std::size_t to = 0; to < relation.front().size(); ++to) {
    const Numbers likelihood = column(relation, to);
    const bool reached = evidence(by, prior, likelihood) > 0;
    result.push_back(reached ? update(by, prior, likelihood) : Numbers{});
  }
  return result;
}

}  // namespace sigmax::plain
