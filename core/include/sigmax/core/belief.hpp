#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/core/logarithm.hpp>

namespace sigmax {

namespace detail {

/// Divides numbers by their ⊕, both given as logarithms, and returns that of the ⊕. Some number is not zero.
double normalize_logs(std::span<double> logs, const AnyAlgebra& algebra);

/// Sets all logarithms to log_weight(i), normalised by normalize(logs), as `Belief::assign` does.
template <class LogWeight, class Normalize>
double assign_logs(const Outcomes& variable, std::span<double> logs, const LogWeight& log_weight,
                   const Normalize& normalize) {
  std::size_t left = 0;
  while (left < logs.size() && log_weight(left) == log_zero) ++left;
  if (left == logs.size()) check::excluded(variable);
  for (std::size_t i = 0; i < logs.size(); ++i) logs[i] = log_weight(i);
  return normalize(logs);
}

}  // namespace detail

/// A distribution that accumulates evidence over time: its logarithms are kept, so that an outcome that was almost
/// excluded can come back. Normalised: ⊕ exp(log) = 1.
template <Uncertainty Kind>
  requires ScalingAlgebra<AlgebraOf<Kind>>
class Belief {
 public:
  using kind = Kind;

  explicit Belief(const Distribution<Kind>& distribution)
      : variable_(distribution.variable()), logs_(1, distribution.size()) {
    for (std::size_t i = 0; i < size(); ++i) logs_(0, i) = std::log(distribution[i]);
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return logs_.size(); }

  /// A view that lives as long as the belief; of a temporary, a copy.
  std::span<const double> logs() const& { return logs_.values(); }
  std::vector<double> logs() const&& { return Table(logs_).values(); }
  double log(std::size_t index) const { return logs_(0, index); }
  const Table& log_table() const& { return logs_; }

  /// The same, for a verb that writes them here; it alone knows that they are normalised.
  std::span<double> logs(detail::ByLaw) & { return logs_.values(); }

  /// The probability or possibility of one outcome.
  double operator[](std::size_t index) const { return std::exp(log(index)); }
  double operator[](std::string_view label) const { return (*this)[variable_.index_of(label)]; }

  /// The belief as numbers; weights below the smallest double become zero here, and only here.
  Distribution<Kind> distribution() const {
    Table table(1, size());
    for (std::size_t i = 0; i < size(); ++i) table(0, i) = std::exp(log(i));
    return {variable_, std::move(table), detail::ByLaw{}};
  }

  /// Replaces the logarithms by log_weight(i), normalised; returns the logarithm of the ⊕ they had.
  /// Throws std::domain_error if every outcome is excluded, and is then unchanged.
  template <class LogWeight>
  double assign(const LogWeight& log_weight) {
    return detail::assign_logs(variable_, logs_.values(), log_weight, [](std::span<double> logs) {
      return detail::normalize_logs(logs, detail::algebra_of<Kind>());
    });
  }

 private:
  Variable<Kind> variable_;
  Table logs_;
};

template <Uncertainty Kind>
std::string most_likely(const Belief<Kind>& belief) {
  return belief.variable().label(index_of_greatest(belief.logs()));
}

}  // namespace sigmax
