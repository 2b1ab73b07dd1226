#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/core/kernels/exponential.hpp>
#include <sigmax/core/logarithm.hpp>

namespace sigmax {

/// A distribution that accumulates evidence over time: its logarithms are kept, so that an outcome that was almost
/// excluded can come back. Normalised: ⊕ exp(log) = 1.
template <Uncertainty Kind>
  requires ScalingAlgebra<AlgebraOf<Kind>>
class Belief {
 public:
  using kind = Kind;

  explicit Belief(const Distribution<Kind>& distribution)
      : variable_(distribution.variable()), logs_(1, distribution.size()) {
    const auto values = distribution.values();
    std::transform(values.begin(), values.end(), logs_.data(), [](double value) { return std::log(value); });
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return logs_.size(); }

  /// A view that lives as long as the belief; of a temporary, a copy.
  std::span<const double> logs() const& { return logs_.values(); }
  std::vector<double> logs() const&& { return Table(logs_).values(); }
  double log(std::size_t index) const { return logs_(0, index); }

  /// The same, for a verb that writes them here; it alone knows that they are normalised.
  std::span<double> logs(detail::ByLaw) & { return logs_.values(); }

  /// The probability or possibility of one outcome.
  double operator[](std::size_t index) const { return std::exp(log(index)); }
  double operator[](std::string_view label) const { return (*this)[variable_.index_of(label)]; }

  /// The belief as numbers; weights below the smallest double become zero here, and only here.
  Distribution<Kind> distribution() const {
    Table table(1, size());
    std::transform(logs().begin(), logs().end(), table.data(), [](double log) { return std::exp(log); });
    return {variable_, std::move(table), detail::ByLaw{}};
  }

  /// Replaces the logarithms by log_weight(i), normalised; returns the logarithm of the ⊕ they had.
  /// Throws std::domain_error if every outcome is excluded, and is then unchanged.
  template <class LogWeight>
  double assign(const LogWeight& log_weight) {
    std::size_t left = 0;
    while (left < size() && log_weight(left) == log_zero) ++left;
    if (left == size()) check::excluded(variable_);
    const std::span<double> logs = logs_.values();
    for (std::size_t i = 0; i < logs.size(); ++i) logs[i] = log_weight(i);
    // Shifted by the greatest first: far from zero, the logarithm of the ⊕ is too coarse a number to normalise by.
    const double greatest = kernels::greatest(logs);
    for (double& log : logs) log -= greatest;
    const double log_total = log_of_total(logs);
    for (double& log : logs) log -= log_total;
    return greatest + log_total;
  }

 private:
  /// log ⊕ exp(log) of logarithms whose greatest is zero.
  static double log_of_total(std::span<const double> logs) {
    using A = AlgebraOf<Kind>;
    if constexpr (SelectiveAlgebra<A>) return 0.0;
    if constexpr (std::same_as<A, Sigma>) return std::log(kernels::sum_of_exponentials(logs));
    return detail::log_combine<A>(
        logs.size(), [logs](std::size_t i) { return logs[i]; }, [](std::size_t) { return 1.0; });
  }

  Variable<Kind> variable_;
  Table logs_;
};

template <Uncertainty Kind>
std::string most_likely(const Belief<Kind>& belief) {
  return belief.variable().label(index_of_greatest(belief.logs()));
}

}  // namespace sigmax
