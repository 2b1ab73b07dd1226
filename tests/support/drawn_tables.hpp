#pragma once

#include "support/core.hpp"

/// Tables for the kernels, and what a composition of them is by its definition.
namespace sigmax::drawn_tables {

constexpr double least_normal = std::numeric_limits<double>::min(), last_place = 0x1p-1074;

/// How the numbers of a table are drawn.
using Draw = double (*)(std::mt19937_64&);
inline double uniform(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1p-53; }
inline double tied(std::mt19937_64& bits) { return static_cast<double>(bits() % 4) / 4.0; }
/// Of these a maximum alone can be had: zero times infinity is no number.
inline double with_infinities(std::mt19937_64& bits) { return bits() % 50 == 0 ? infinity : tied(bits); }
inline double positive_with_infinities(std::mt19937_64& bits) {
  return bits() % 50 == 0 ? infinity : 1.0 - uniform(bits);
}
inline double wide(std::mt19937_64& bits) {  // half of all products are subnormal, or smaller
  return bits() % 5 == 0 ? 0.0 : std::ldexp(uniform(bits), -static_cast<int>(bits() % 1060));
}
inline double subnormal(std::mt19937_64& bits) {
  return bits() % 3 == 0 ? 1.0 : static_cast<double>(bits() % 9) * last_place;
}

inline Table drawn(std::size_t rows, std::size_t columns, Draw draw, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  Table table(rows, columns);
  for (double& number : table.values()) number = draw(bits);
  return table;
}

inline double summed(double sum, double weight, double value) { return sum + weight * value; }
inline double max_of(double sum, double weight, double value) { return weight * value > sum ? weight * value : sum; }
inline double max_min(double sum, double weight, double value) { return std::max(sum, std::min(weight, value)); }

/// The definition, one number after the other.
template <class Add>
Table defined(const Table& left, const Table& right, Add add) {
  Table result(right.rows(), left.columns(), 0.0);
  for (std::size_t i = 0; i < right.rows(); ++i)
    for (std::size_t k = 0; k < left.columns(); ++k)
      for (std::size_t j = 0; j < left.rows(); ++j) result(i, k) = add(result(i, k), right(i, j), left(j, k));
  return result;
}

}  // namespace sigmax::drawn_tables
