#pragma once

#include <cmath>
#include <concepts>
#include <span>

#include <sigmax/core/belief.hpp>

#include "algebras.hpp"
#include "kernels/exponential.hpp"

namespace sigmax::detail {

/// log ⊕ exp(log) of logarithms whose greatest is zero.
template <class A>
double log_of_total(A algebra, std::span<const double> logs) {
  if constexpr (std::same_as<A, Sigma>) return std::log(kernels::sum_of_exponentials(logs));
  double sum = algebra.zero();
  for (const double log : logs) sum = algebra.plus(sum, std::exp(log));
  return std::log(sum);
}

template <class A>
double normalize_logs(A algebra, std::span<double> logs) {
  // Shifted by the greatest first: far from zero, the logarithm of the ⊕ is too coarse a number to normalise by.
  const double greatest = kernels::greatest(logs);
  for (double& log : logs) log -= greatest;
  if (selects(algebra)) return greatest;
  const double log_total = log_of_total(algebra, logs);
  for (double& log : logs) log -= log_total;
  return greatest + log_total;
}

/// Sets all logarithms to log_weight(i), normalised.
template <class A, class LogWeight>
double assign_logs(A algebra, const Outcomes& variable, std::span<double> logs, const LogWeight& log_weight) {
  return assign_logs(variable, logs, log_weight,
                     [algebra](std::span<double> some) { return normalize_logs(algebra, some); });
}

}  // namespace sigmax::detail
