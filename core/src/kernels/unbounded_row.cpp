#include "kernels/unbounded_row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "algebras.hpp"
#include "kernels/plain.hpp"

namespace sigmax::kernels {
namespace {

using sigmax::detail::Scaling;
using sigmax::detail::with;

/// ⊕ of numbers of any size; where ⊗ does not scale, all of them are doubles.
template <class A>
ScaledNumber plus(A algebra, ScaledNumber a, ScaledNumber b) {
  if constexpr (!Scaling<A>) return ScaledNumber{algebra.plus(a.value(), b.value())};
  return ScaledNumber::plus(a, b, [algebra](double x, double y) { return algebra.plus(x, y); });
}

double log_of(ScaledNumber number, const AnyAlgebra& algebra) {
  return algebra.scales ? number.log() : std::log(number.value());
}

/// Powers of two between which no product of a weight and a raised number underflows, nor a sum overflows: weights lie
/// in [2^(478 − 901), 2^478), raised numbers in [2^(512 − 1074), 2^512], products in [2^−985, 2^990].
constexpr std::int64_t weight_exponent = 478, band_depth = 900;
constexpr std::int64_t none = std::numeric_limits<std::int64_t>::min();

/// The greatest exponent that is not above `limit`.
std::int64_t top_exponent(std::span<const ScaledNumber> numbers, std::int64_t limit) {
  std::int64_t top = none;
  for (const ScaledNumber number : numbers)
    if (!number.is_zero() && number.exponent() <= limit) top = std::max(top, number.exponent());
  return top;
}

/// Numbers that doubles can hold together are composed by doubles, band by band: in one band as a rule, and always
/// where ⊗ does not scale, for then they are doubles.
template <class A>
struct Band {
  std::int64_t top;

  bool has(ScaledNumber number) const {
    return !number.is_zero() && (!Scaling<A> || (number.exponent() <= top && number.exponent() > top - band_depth));
  }
  double weight(ScaledNumber number) const {
    return Scaling<A> ? number.normal_value_in_units_of(top - weight_exponent) : number.value();
  }
  static double entry(double value) { return Scaling<A> ? raised(value) : value; }
  ScaledNumber number(double sum) const { return ScaledNumber(sum, Scaling<A> ? top - weight_exponent - 512 : 0); }
};

/// action(band) for every band, from the greatest numbers down.
template <class A, class Action>
void for_each_band(std::span<const ScaledNumber> numbers, const Action& action) {
  for (std::int64_t top = top_exponent(numbers, std::numeric_limits<std::int64_t>::max()); top > none;
       top = Scaling<A> ? top_exponent(numbers, top - band_depth) : none)
    action(Band<A>{top});
}

/// A row as a band reads it.
template <class A, class Entries>
struct EntriesOfBand {
  Entries entries;
  std::size_t size() const { return entries.size(); }
  std::size_t index(std::size_t k) const { return entries.index(k); }
  double value(std::size_t k) const { return Band<A>::entry(entries.value(k)); }
};

/// Where a term from another band, with a winner of its own, joins a number.
void merge(Winners::Index& winner, ScaledNumber number, ScaledNumber term, Winners::Index of_term) {
  if (term.is_zero()) return;
  if (term == number)
    winner = std::min(winner, of_term);
  else if (number < term)
    winner = of_term;
}

template <bool WithWinners, class A, class Left>
void compose(A algebra, const Left& left, std::span<const ScaledNumber> before, std::vector<ScaledNumber>& result,
             std::vector<double>& sums, Winners* winners) {
  result.resize(left.columns());
  bool fresh = true;  // nothing in `result` yet
  std::vector<Winners::Index> of_band;
  if constexpr (WithWinners && Scaling<A>) winners->first.assign(left.columns(), 0);
  if constexpr (WithWinners && !Scaling<A>) winners->attempts.assign(left.columns(), {});
  for_each_band<A>(before, [&](const Band<A>& band) {
    sums.assign(left.columns(), algebra.zero());
    if constexpr (WithWinners && Scaling<A>) of_band.assign(left.columns(), 0);
    double* const out = sums.data();
    for (std::size_t j = 0; j < before.size(); ++j) {
      if (!band.has(before[j])) continue;
      const EntriesOfBand<A, decltype(left.entries(j))> row{left.entries(j)};
      const auto index = static_cast<Winners::Index>(j);
      if constexpr (!WithWinners)
        accumulate(algebra, band.weight(before[j]), row, out);
      else
        accumulate(algebra, band.weight(before[j]), row, out, [&](std::size_t k, bool better, double value) {
          if constexpr (Scaling<A>)
            of_band[k] = better ? index : of_band[k];
          else if (better)
            winners->attempts[k].push_back({index, value});
        });
    }
    for (std::size_t k = 0; k < result.size(); ++k) {
      const ScaledNumber so_far = fresh ? ScaledNumber{} : result[k], term = band.number(sums[k]);
      if constexpr (WithWinners && Scaling<A>) merge(winners->first[k], so_far, term, of_band[k]);
      result[k] = fresh ? term : plus(algebra, so_far, term);
    }
    fresh = false;
  });
  if (fresh) std::fill(result.begin(), result.end(), ScaledNumber{});
}

template <class A, class Rows>
void carry_back(A algebra, const Rows& rows, std::span<const ScaledNumber> after, std::vector<ScaledNumber>& result,
                std::vector<double>& weights) {
  result.assign(rows.rows(), ScaledNumber{});
  for_each_band<A>(after, [&](const Band<A>& band) {
    weights.resize(after.size());
    for (std::size_t j = 0; j < after.size(); ++j) weights[j] = band.has(after[j]) ? band.weight(after[j]) : 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const auto row = rows.entries(i);
      double sum = algebra.zero();
      for (std::size_t k = 0; k < row.size(); ++k)
        sum = algebra.plus(sum, algebra.times(weights[row.index(k)], band.entry(row.value(k))));
      result[i] = plus(algebra, result[i], band.number(sum));
    }
  });
}

}  // namespace

UnboundedRow::UnboundedRow(std::size_t size, double value) : numbers_(size, ScaledNumber{value}) {}

UnboundedRow::UnboundedRow(std::span<const double> values) {
  for (const double value : values) numbers_.emplace_back(value);
}

std::size_t UnboundedRow::greatest() const {
  return static_cast<std::size_t>(std::max_element(numbers_.begin(), numbers_.end()) - numbers_.begin());
}

bool UnboundedRow::is_zero() const {
  return std::all_of(numbers_.begin(), numbers_.end(), [](ScaledNumber number) { return number.is_zero(); });
}

ScaledNumber UnboundedRow::total(const AnyAlgebra& algebra) const {
  return with(algebra, [&](auto a) {
    ScaledNumber sum;
    for (const ScaledNumber number : numbers_) sum = plus(a, sum, number);
    return sum;
  });
}

double UnboundedRow::log(std::size_t i, const AnyAlgebra& algebra) const { return log_of(numbers_[i], algebra); }

double UnboundedRow::log_total(const AnyAlgebra& algebra) const { return log_of(total(algebra), algebra); }

Table UnboundedRow::logs_or_plain(const AnyAlgebra& algebra) const {
  Table result(1, size());
  for (std::size_t i = 0; i < size(); ++i) result(0, i) = algebra.scales ? numbers_[i].log() : numbers_[i].value();
  return result;
}

Table UnboundedRow::conditioned(const AnyAlgebra& algebra) const {
  // In proportion, the greatest in [½, 1): what is too small for a double is zero.
  const std::int64_t unit = algebra.scales ? numbers_[greatest()].exponent() : 0;
  Table result(1, size());
  for (std::size_t i = 0; i < size(); ++i) result(0, i) = numbers_[i].value_in_units_of(unit);
  condition(algebra, result.values());
  return result;
}

bool UnboundedRow::take(const Evidence& evidence, const AnyAlgebra& algebra) {
  const std::span<const double> likelihoods = evidence.logs_or_plain;
  const double nothing = algebra.scales ? log_zero : algebra.zero;
  bool some_left = false;
  for (std::size_t i = 0; i < size() && !some_left; ++i)
    some_left = !numbers_[i].is_zero() && likelihoods[i] != nothing;
  if (!some_left) return false;
  with(algebra, [&]<class A>(A a) {
    for (std::size_t i = 0; i < size(); ++i)
      numbers_[i] = Scaling<A> ? numbers_[i] * number_of(evidence, i)
                               : ScaledNumber{a.times(numbers_[i].value(), likelihoods[i])};
  });
  return true;
}

void UnboundedRow::assign_composition(const AnyRows& left, const UnboundedRow& before, const AnyAlgebra& algebra,
                                      Winners* winners) {
  with(algebra, [&](auto a) {
    std::visit(
        [&](const auto& rows) {
          if (winners)
            compose<true>(a, rows, before.numbers_, numbers_, doubles_, winners);
          else
            compose<false>(a, rows, before.numbers_, numbers_, doubles_, nullptr);
        },
        left);
  });
}

void UnboundedRow::assign_carried_back(const AnyRows& rows, const UnboundedRow& after, const AnyAlgebra& algebra) {
  with(algebra, [&](auto a) {
    std::visit([&](const auto& stored) { carry_back(a, stored, after.numbers_, numbers_, doubles_); }, rows);
  });
}

}  // namespace sigmax::kernels
