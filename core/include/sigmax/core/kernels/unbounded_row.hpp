#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <sigmax/core/condition.hpp>
#include <sigmax/core/kernels/accumulate.hpp>
#include <sigmax/core/scaled_number.hpp>

namespace sigmax::kernels {

/// x · 2^512, for x in [0, 2^511), without arithmetic on subnormal numbers, which is slow on some processors.
inline double raised(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x) << 1 >> 1;  // without the sign that zero may have
  const std::uint64_t subnormal = ((bits >> 52) - 1) >> 63;     // 1 or 0, without a comparison: it vectorises
  // A subnormal number gets the exponent of the least normal one and, raised, is rid of the leading bit that implies.
  const auto up = std::bit_cast<double>(bits + ((512 + subnormal) << 52));
  return up - std::bit_cast<double>((0 - subnormal) & std::bit_cast<std::uint64_t>(0x1p-510));
}

/// A row whose numbers are read raised.
template <class Entries>
struct RaisedEntries {
  explicit RaisedEntries(const Entries& all) : entries(all) {}
  Entries entries;
  std::size_t size() const { return entries.size(); }
  std::size_t index(std::size_t k) const { return entries.index(k); }
  double value(std::size_t k) const { return raised(entries.value(k)); }
};

/// A row of numbers that never underflow, however many tables it passes through.
class UnboundedRow {
 public:
  using Number = ScaledNumber;

  UnboundedRow() = default;
  explicit UnboundedRow(std::span<const double> values) {
    for (const double value : values) numbers_.emplace_back(value);
  }
  UnboundedRow(std::size_t size, double value) : numbers_(size, ScaledNumber{value}) {}

  static bool is_zero(ScaledNumber number) { return number.is_zero(); }
  static double value_of(ScaledNumber number) { return number.value(); }
  static ScaledNumber times(ScaledNumber a, ScaledNumber b) { return a * b; }

  std::size_t size() const { return numbers_.size(); }
  std::size_t capacity() const { return numbers_.capacity(); }
  void clear() { numbers_.clear(); }
  std::span<const ScaledNumber> numbers() const& { return numbers_; }
  ScaledNumber operator[](std::size_t i) const { return numbers_[i]; }
  ScaledNumber& operator[](std::size_t i) { return numbers_[i]; }
  double log(std::size_t i) const { return numbers_[i].log(); }

  bool is_zero() const {
    return std::all_of(numbers_.begin(), numbers_.end(), [](ScaledNumber number) { return number.is_zero(); });
  }

  /// Index of the greatest, the lowest on a tie; 0 of none.
  std::size_t greatest() const {
    return static_cast<std::size_t>(std::max_element(numbers_.begin(), numbers_.end()) - numbers_.begin());
  }

  /// The logarithm of their ⊕.
  template <ScalingAlgebra A>
  double log_total() const {
    ScaledNumber sum;
    for (const ScaledNumber number : numbers_) sum = ScaledNumber::plus<A>(sum, number);
    return sum.log();
  }

  /// The numbers in proportion, the greatest in [½, 1); what is too small for a double is zero.
  void to_values(std::span<double> values) const {
    const ScaledNumber top = numbers_[greatest()];
    for (std::size_t i = 0; i < size(); ++i) values[i] = numbers_[i].value_in_units_of(top.exponent());
  }

  /// number(k) = ⊕_j before(j) ⊗ left(j, k), where `before` is another row; `winners` is FirstWinners or NoWinners.
  ///
  /// Numbers that doubles can hold together are composed by doubles, band by band: in one band as a rule.
  template <ScalingAlgebra A, class Left, class Winners>
  void assign_composition(const Left& left, const UnboundedRow& before, Winners& winners) {
    numbers_.assign(left.columns(), ScaledNumber{});
    winners.assign(left.columns());
    Winners of_band;
    before.for_each_band([&](std::int64_t unit, const auto& in_band) {
      doubles_.assign(left.columns(), A::zero());
      double* const sums = doubles_.data();
      of_band.assign(left.columns());
      for (std::size_t j = 0; j < before.size(); ++j)
        if (const ScaledNumber number = before[j]; in_band(number))
          accumulate<A>(number.normal_value_in_units_of(unit), RaisedEntries{left.entries(j)}, sums, j,
                        of_band.from(0));
      for (std::size_t k = 0; k < size(); ++k) {
        const ScaledNumber term(sums[k], unit - 512);
        winners.merge(k, numbers_[k], term, of_band);
        numbers_[k] = ScaledNumber::plus<A>(numbers_[k], term);
      }
    });
  }

  /// number(i) = ⊕_j rows(i, j) ⊗ after(j), where `after` is another row: evidence carried back.
  template <ScalingAlgebra A, class Rows>
  void assign_carried_back(const Rows& rows, const UnboundedRow& after) {
    numbers_.assign(rows.rows(), ScaledNumber{});
    after.for_each_band([&](std::int64_t unit, const auto& in_band) {
      doubles_.resize(after.size());
      for (std::size_t j = 0; j < after.size(); ++j)
        doubles_[j] = in_band(after[j]) ? after[j].normal_value_in_units_of(unit) : 0.0;
      for (std::size_t i = 0; i < size(); ++i) {
        const auto row = rows.entries(i);
        double sum = A::zero();
        for (std::size_t k = 0; k < row.size(); ++k)
          sum = A::plus(sum, A::times(doubles_[row.index(k)], raised(row.value(k))));
        numbers_[i] = ScaledNumber::plus<A>(numbers_[i], ScaledNumber(sum, unit - 512));
      }
    });
  }

 private:
  // Powers of two between which no product of a weight and a raised number underflows, nor a sum overflows: weights lie
  // in [2^(478 − 901), 2^478), raised numbers in [2^(512 − 1074), 2^512], products in [2^−985, 2^990].
  static constexpr std::int64_t weight_exponent = 478, band_depth = 900;
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::min();

  /// action(unit, whether a number is in the band) for every band, from the greatest numbers down; in units of 2^unit
  /// the numbers of the band are weights.
  template <class Action>
  void for_each_band(const Action& action) const {
    for (std::int64_t top = top_exponent(std::numeric_limits<std::int64_t>::max()); top > none;
         top = top_exponent(top - band_depth))
      action(top - weight_exponent, [top](ScaledNumber number) {
        return !number.is_zero() && number.exponent() <= top && number.exponent() > top - band_depth;
      });
  }

  /// The greatest exponent that is not above `limit`.
  std::int64_t top_exponent(std::int64_t limit) const {
    std::int64_t top = none;
    for (const ScaledNumber number : numbers_)
      if (!number.is_zero() && number.exponent() <= limit) top = std::max(top, number.exponent());
    return top;
  }

  std::vector<ScaledNumber> numbers_;
  std::vector<double> doubles_;  // sums or weights of one band; kept for its memory
};

/// The same where nothing underflows because ⊗ does not scale: the numbers as they are.
template <Algebra A>
class PlainRow {
 public:
  using Number = double;

  PlainRow() = default;
  explicit PlainRow(std::span<const double> values) : numbers_(values.begin(), values.end()) {}
  PlainRow(std::size_t size, double value) : numbers_(size, value) {}

  static bool is_zero(double number) { return number == A::zero(); }
  static double value_of(double number) { return number; }
  static double times(double a, double b) { return A::times(a, b); }

  std::size_t size() const { return numbers_.size(); }
  std::size_t capacity() const { return numbers_.capacity(); }
  std::span<const double> numbers() const& { return numbers_; }
  double operator[](std::size_t i) const { return numbers_[i]; }
  double& operator[](std::size_t i) { return numbers_[i]; }
  double log(std::size_t i) const { return std::log(numbers_[i]); }
  bool is_zero() const { return is_zero(detail::total<A>(numbers_)); }
  std::size_t greatest() const {
    return static_cast<std::size_t>(std::max_element(numbers_.begin(), numbers_.end()) - numbers_.begin());
  }
  template <Algebra>
  double log_total() const {
    return std::log(detail::total<A>(numbers_));
  }
  void to_values(std::span<double> values) const { std::copy(numbers_.begin(), numbers_.end(), values.begin()); }

  template <Algebra, class Left, class Winners>
  void assign_composition(const Left& left, const PlainRow& before, Winners& winners) {
    numbers_.assign(left.columns(), A::zero());
    winners.assign(left.columns());
    double* const sums = numbers_.data();
    for (std::size_t j = 0; j < before.size(); ++j) accumulate<A>(before[j], left.entries(j), sums, j, winners.from(0));
  }

  template <Algebra, class Rows>
  void assign_carried_back(const Rows& rows, const PlainRow& after) {
    numbers_.assign(rows.rows(), A::zero());
    for (std::size_t i = 0; i < size(); ++i) {
      const auto row = rows.entries(i);
      for (std::size_t k = 0; k < row.size(); ++k)
        numbers_[i] = A::plus(numbers_[i], A::times(row.value(k), after[row.index(k)]));
    }
  }

 private:
  std::vector<double> numbers_;
};

/// A row of numbers of an algebra that loses nothing, however long it is composed and multiplied.
template <Algebra A>
using LosslessRow = std::conditional_t<ScalingAlgebra<A>, UnboundedRow, PlainRow<A>>;

}  // namespace sigmax::kernels
