#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

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

/// One term of a composition, with its winners if they are asked for.
template <Algebra A, class Entries>
void accumulate_from(double weight, const Entries& row, double* sums, std::size_t) {
  accumulate<A>(weight, row, sums);
}
template <SelectiveAlgebra A, class Entries>
void accumulate_from(double weight, const Entries& row, double* sums, std::size_t index, std::vector<Winner>& winners) {
  Winner* const won = winners.data();
  accumulate<A>(weight, row, sums, static_cast<Winner>(index), won);
}

/// A row of numbers that never underflow, however many tables it passes through.
class LongRow {
 public:
  explicit LongRow(std::span<const double> values) {
    for (const double value : values) numbers_.emplace_back(value);
  }

  std::size_t size() const { return numbers_.size(); }
  double log(std::size_t i) const { return numbers_[i].log(); }

  /// One number as a double: zero where that underflows.
  double value(std::size_t i) const { return numbers_[i].value(); }

  /// ⊗ by a likelihood given as its logarithm.
  void multiply(std::size_t i, double log_likelihood) { numbers_[i] = numbers_[i] * ScaledNumber::exp(log_likelihood); }

  bool is_zero() const {
    return std::all_of(numbers_.begin(), numbers_.end(), [](ScaledNumber number) { return number.is_zero(); });
  }

  /// Index of the greatest, the lowest on a tie.
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

  /// number(k) = ⊕_j number(j) ⊗ left(j, k). `winners`, if given, gets the first j that attains each.
  ///
  /// Numbers that doubles can hold together are composed by doubles, band by band: in one band as a rule.
  template <ScalingAlgebra A, class Left, class... Winners>
  void compose(const Left& left, Winners&... winners) {
    results_.assign(left.columns(), ScaledNumber{});
    (winners.assign(left.columns(), 0), ...);
    auto band_winners = std::tuple{Winners{}...};
    for (std::int64_t top = top_exponent(std::numeric_limits<std::int64_t>::max()); top > none;
         top = top_exponent(top - band_depth)) {
      sums_.assign(left.columns(), A::zero());
      std::apply([&](auto&... won) { (won.assign(left.columns(), 0), ...); }, band_winners);
      for (std::size_t j = 0; j < numbers_.size(); ++j) {
        const ScaledNumber number = numbers_[j];
        if (number.is_zero() || number.exponent() > top || number.exponent() <= top - band_depth) continue;
        const double weight = number.normal_value_in_units_of(top - weight_exponent);
        std::apply(
            [&](auto&... won) { accumulate_from<A>(weight, RaisedEntries{left.entries(j)}, sums_.data(), j, won...); },
            band_winners);
      }
      for (std::size_t k = 0; k < sums_.size(); ++k)
        add<A>(k, ScaledNumber(sums_[k], top - weight_exponent - 512), winners..., std::get<Winners>(band_winners)...);
    }
    std::swap(numbers_, results_);
  }

 private:
  // Powers of two between which no product of a weight and a raised number underflows, nor a sum overflows: weights lie
  // in [2^(478 − 901), 2^478), raised numbers in [2^(512 − 1074), 2^512], products in [2^−985, 2^990].
  static constexpr std::int64_t weight_exponent = 478, band_depth = 900;
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::min();

  /// The greatest exponent that is not above `limit`.
  std::int64_t top_exponent(std::int64_t limit) const {
    std::int64_t top = none;
    for (const ScaledNumber number : numbers_)
      if (!number.is_zero() && number.exponent() <= limit) top = std::max(top, number.exponent());
    return top;
  }

  /// Adds what one band gives to result k.
  template <ScalingAlgebra A>
  void add(std::size_t k, ScaledNumber term) {
    results_[k] = ScaledNumber::plus<A>(results_[k], term);
  }
  template <SelectiveAlgebra A>
  void add(std::size_t k, ScaledNumber term, std::vector<Winner>& winners, const std::vector<Winner>& band_winners) {
    if (term.is_zero()) return;
    if (term == results_[k])
      winners[k] = std::min(winners[k], band_winners[k]);
    else if (results_[k] < term)
      winners[k] = band_winners[k];
    results_[k] = ScaledNumber::plus<A>(results_[k], term);
  }

  std::vector<ScaledNumber> numbers_;
  std::vector<ScaledNumber> results_;  // of a composition while it lasts; kept for its memory
  std::vector<double> sums_;
};

/// The same where nothing underflows because ⊗ does not scale: the numbers as they are.
template <Algebra A>
class PlainRow {
 public:
  explicit PlainRow(std::span<const double> values) : numbers_(values.begin(), values.end()) {}

  std::size_t size() const { return numbers_.size(); }
  double log(std::size_t i) const { return std::log(numbers_[i]); }
  void multiply(std::size_t i, double likelihood) { numbers_[i] = A::times(numbers_[i], likelihood); }
  bool is_zero() const { return numbers_[greatest()] == A::zero(); }
  std::size_t greatest() const {
    return static_cast<std::size_t>(std::max_element(numbers_.begin(), numbers_.end()) - numbers_.begin());
  }
  template <Algebra>
  double log_total() const {
    double sum = A::zero();
    for (const double number : numbers_) sum = A::plus(sum, number);
    return std::log(sum);
  }
  void to_values(std::span<double> values) const { std::copy(numbers_.begin(), numbers_.end(), values.begin()); }

  template <Algebra, class Left, class... Winners>
  void compose(const Left& left, Winners&... winners) {
    sums_.assign(left.columns(), A::zero());
    (winners.assign(left.columns(), 0), ...);
    for (std::size_t j = 0; j < numbers_.size(); ++j)
      accumulate_from<A>(numbers_[j], left.entries(j), sums_.data(), j, winners...);
    std::swap(numbers_, sums_);
  }

 private:
  std::vector<double> numbers_, sums_;
};

/// What keeps a row of numbers of an algebra through a long chain.
template <Algebra A>
using RowThroughChain = std::conditional_t<ScalingAlgebra<A>, LongRow, PlainRow<A>>;

}  // namespace sigmax::kernels
