#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <sigmax/core/algebra.hpp>

namespace sigmax {

namespace detail {

/// ⊕ of numbers, those of a long row in eight parts that do not wait for each other.
template <Algebra A>
constexpr double total_in_parts(std::span<const double> values) {
  constexpr std::size_t parts = 8;
  double sum = A::zero();
  if (values.size() >= 8 * parts) {
    double sums[parts];
    std::fill_n(sums, parts, A::zero());
    for (; values.size() >= parts; values = values.subspan(parts))
      for (std::size_t p = 0; p < parts; ++p) sums[p] = A::plus(sums[p], values[p]);
    for (const double part : sums) sum = A::plus(sum, part);
  }
  for (const double value : values) sum = A::plus(sum, value);
  return sum;
}

/// ⊕ of numbers in their order, which is that of sparse ones as well.
template <Algebra A>
constexpr double total(std::span<const double> values) {
  if constexpr (SelectiveAlgebra<A>) return total_in_parts<A>(values);
  double sum = A::zero();
  for (const double value : values) sum = A::plus(sum, value);
  return sum;
}

}  // namespace detail

/// Turns a joint, finite numbers that are not all zero, into the conditional: the greatest c with c ⊗ (⊕ joint) =
/// joint.
///
/// Where ⊗ has an inverse that is division by the ⊕, (8), (14), (19), (20). For `MaxMin` it is the residuum: 1 where
/// the joint equals its maximum, the joint elsewhere.
template <Algebra A>
void condition(std::span<double> joint) {
  if constexpr (ScalingAlgebra<A>) {
    // Divided by the greatest first, so that their ⊕ neither overflows nor rounds a lone number away from one.
    const double greatest = detail::total<Max>(joint);
    double sum = A::zero();
    for (double& value : joint) sum = A::plus(sum, value /= greatest);
    if (sum == A::one()) return;
    for (double& value : joint) value = A::divide(value, sum);
  } else {
    const double sum = detail::total<A>(joint);
    for (double& value : joint) value = value == sum ? A::one() : value;
  }
}

/// How far the ⊕ of a composition may lie from one before it is divided out.
inline constexpr double drift_tolerance = 1e-12;

namespace detail {

/// Divides a composition of normalised parts by its ⊕ if that has drifted: the rows of the parts are one only to within
/// `normalization_tolerance`, and that would add up along a chain of compositions. Nothing drifts where ⊗ selects.
template <Algebra A>
void settle(std::span<double> row) {
  if constexpr (ScalingAlgebra<A>) {
    const double sum = total_in_parts<A>(row);
    if (std::abs(sum - 1.0) <= drift_tolerance) return;
    for (double& value : row) value = A::divide(value, sum);
  }
}

}  // namespace detail

/// Each of n equal numbers, conditioned: 1/n if they are added, else one.
template <Algebra A>
double equal_share(std::size_t n) {
  double sum = A::zero();
  for (std::size_t i = 0; i < n; ++i) sum = A::plus(sum, A::one());
  if constexpr (ScalingAlgebra<A>)
    return A::divide(A::one(), sum);
  else
    return A::one();
}

namespace detail {

/// Conditions every row of a joint. A row without mass becomes uninformative and is listed in `unreachable`.
template <Algebra A, class Rows>
void condition_rows(Rows& rows, std::vector<std::size_t>& unreachable) {
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    const std::span<double> row = rows.values(r);
    if (std::all_of(row.begin(), row.end(), [](double value) { return value == A::zero(); }))
      unreachable.push_back(r);
    else
      condition<A>(row);
  }
  rows.fill_rows(unreachable, equal_share<A>(rows.columns()));
}

}  // namespace detail

}  // namespace sigmax
