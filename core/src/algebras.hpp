#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <sigmax/core/condition.hpp>
#include <sigmax/core/uncertainty.hpp>

/// Algebras as objects of a type of their own, for the templates that are compiled for each of them.
namespace sigmax::detail {

/// A user's own algebra, whose ⊗ does not scale, or does.
struct OtherAlgebra {
  const AnyAlgebra* any;
  double zero() const { return any->zero; }
  double one() const { return any->one; }
  double plus(double a, double b) const { return any->plus(a, b); }
  double times(double a, double b) const { return any->times(a, b); }
};
struct OtherScalingAlgebra : OtherAlgebra {
  double divide(double a, double b) const { return any->divide(a, b); }
};

/// An algebra whose ⊗ scales, as an object.
template <class A>
concept Scaling = requires(A algebra) {
  algebra.divide(1.0, 1.0);
};

/// Whether ⊕ selects.
template <class A>
bool selects(A algebra) {
  if constexpr (requires { algebra.any; })
    return algebra.any->selective;
  else
    return A::selective;
}

/// action(algebra) for one whose ⊗ scales, and for any.
template <class Action>
decltype(auto) with_scaling(const AnyAlgebra& algebra, const Action& action) {
  if (algebra.name == AnyAlgebra::sigma) return action(Sigma{});
  if (algebra.name == AnyAlgebra::max) return action(Max{});
  return action(OtherScalingAlgebra{{&algebra}});
}
template <class Action>
decltype(auto) with(const AnyAlgebra& algebra, const Action& action) {
  if (algebra.scales) return with_scaling(algebra, action);
  if (algebra.name == AnyAlgebra::max_min) return action(MaxMin{});
  return action(OtherAlgebra{&algebra});
}

/// ⊕ of numbers; of a long row in eight independent partial sums.
template <class A>
double total_in_parts(A algebra, std::span<const double> values) {
  constexpr std::size_t parts = 8;
  double sum = algebra.zero();
  if (values.size() >= 8 * parts) {
    double sums[parts];
    std::fill_n(sums, parts, algebra.zero());
    for (; values.size() >= parts; values = values.subspan(parts))
      for (std::size_t p = 0; p < parts; ++p) sums[p] = algebra.plus(sums[p], values[p]);
    for (const double part : sums) sum = algebra.plus(sum, part);
  }
  for (const double value : values) sum = algebra.plus(sum, value);
  return sum;
}

/// ⊕ of numbers in their order, which is that of sparse ones as well.
template <class A>
double total(A algebra, std::span<const double> values) {
  if (selects(algebra)) return total_in_parts(algebra, values);
  double sum = algebra.zero();
  for (const double value : values) sum = algebra.plus(sum, value);
  return sum;
}

template <class A>
void condition(A algebra, std::span<double> joint) {
  if constexpr (Scaling<A>) {
    // Divided by the greatest first, so that their ⊕ neither overflows nor rounds a lone number away from one.
    const double greatest = total_in_parts(Max{}, joint);
    double sum = algebra.zero();
    for (double& value : joint) sum = algebra.plus(sum, value /= greatest);
    if (sum == algebra.one()) return;
    for (double& value : joint) value = algebra.divide(value, sum);
  } else {
    const double sum = total(algebra, joint), one = algebra.one();
    for (double& value : joint) value = value == sum ? one : value;
  }
}

/// Divides a composition of normalised parts by its ⊕ if that has drifted: the rows of the parts are one only to within
/// `normalization_tolerance`, and that would add up along a chain of compositions. Nothing drifts where ⊗ selects.
template <class A>
void settle(A algebra, std::span<double> row) {
  if constexpr (Scaling<A>) {
    const double sum = total_in_parts(algebra, row);
    if (std::abs(sum - 1.0) <= drift_tolerance) return;
    for (double& value : row) value = algebra.divide(value, sum);
  }
}

/// Each of n equal numbers, conditioned.
template <class A>
double equal_share(A algebra, [[maybe_unused]] std::size_t n) {
  if constexpr (Scaling<A>) {
    double sum = algebra.zero();
    for (std::size_t i = 0; i < n; ++i) sum = algebra.plus(sum, algebra.one());
    return algebra.divide(algebra.one(), sum);
  } else {
    return algebra.one();
  }
}

}  // namespace sigmax::detail
