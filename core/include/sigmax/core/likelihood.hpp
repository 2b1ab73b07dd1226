#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/belief.hpp>
#include <sigmax/core/check.hpp>
#include <sigmax/core/kernels/unbounded_row.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/core/variable.hpp>

namespace sigmax {

/// How well each outcome of a variable explains a piece of evidence, up to a common factor. Never normalised; kept as
/// it was given: numbers as numbers that neither round nor underflow, logarithms as logarithms. Those of an ordinal
/// variable are numbers, none above one. `Kind` is that of the variable over which it is a function; the evidence may
/// be of the other kind, (19), (20).
template <Uncertainty Kind>
class Likelihood {
 public:
  using kind = Kind;
  static constexpr bool has_logs = ScalingAlgebra<AlgebraOf<Kind>>;

  /// Likelihoods, not logarithms. Throws std::invalid_argument unless all are finite and none is negative; those of an
  /// ordinal variable are at most one.
  Likelihood(Variable<Kind> variable, std::initializer_list<double> values)
      : Likelihood(std::move(variable), std::span<const double>(values.begin(), values.size())) {}
  Likelihood(Variable<Kind> variable, const std::vector<double>& values)
      : Likelihood(std::move(variable), std::span<const double>(values.data(), values.size())) {}
  Likelihood(Variable<Kind> variable, std::span<const double> values) : variable_(std::move(variable)), table_(values) {
    check::size(variable_, {}, values.size());
    check::likelihoods(variable_, {}, values, detail::algebra_of<Kind>());
    if constexpr (has_logs) take(kernels::UnboundedRow(values));
  }

  /// One for every outcome: evidence that says nothing.
  explicit Likelihood(Variable<Kind> variable)
      : variable_(std::move(variable)), table_(1, variable_.size(), has_logs ? 0.0 : 1.0) {}

  /// What is believed, read as evidence.
  template <Uncertainty Same>
    requires std::same_as<Same, Kind>
  explicit Likelihood(const Belief<Same>& belief) : variable_(belief.variable()), table_(belief.log_table()) {}

  /// Numbers of any size, or logarithms, for the verbs.
  Likelihood(Variable<Kind> variable, kernels::UnboundedRow numbers, detail::ByLaw)
      : variable_(std::move(variable)), table_(0, 0) {
    take(std::move(numbers));
  }
  Likelihood(Variable<Kind> variable, Table logs, detail::ByLaw) requires has_logs : variable_(std::move(variable)),
                                                                                     table_(std::move(logs)) {}

  /// Sets the logarithm of one likelihood, −∞ for an excluded outcome; logarithms are all that is kept then. Throws
  /// std::invalid_argument for NaN or +∞.
  void set_log(std::size_t index, double log_likelihood) requires has_logs {
    check::log_likelihood(variable_, index, log_likelihood);
    numbers_.clear();
    table_(0, index) = log_likelihood;
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return variable_.size(); }

  /// The logarithms: a view that lives as long as the likelihood; of a temporary, a copy.
  std::span<const double> logs() const& requires has_logs { return table_.values(); }
  std::vector<double> logs() const&& requires has_logs { return Table(table_).values(); }
  double log(std::size_t index) const requires has_logs { return table_(0, index); }

  /// One likelihood as a number that does not underflow; of an ordinal variable a double.
  auto number(std::size_t index) const {
    if constexpr (!has_logs)
      return table_(0, index);
    else
      return numbers_.size() == 0 ? ScaledNumber::exp(table_(0, index)) : numbers_[index];
  }

  /// All that is known, for the verbs: a view that lives as long as the likelihood.
  kernels::Evidence evidence() const& { return {numbers_.numbers(), table_.values()}; }

  bool excludes(std::size_t index) const { return table_(0, index) == (has_logs ? log_zero : 0.0); }

  /// One likelihood as a double, exactly as it was given unless that was a logarithm. `at` throws std::invalid_argument
  /// if there is no such index, [] does not look.
  double operator[](std::size_t index) const {
    if constexpr (!has_logs)
      return table_(0, index);
    else
      return number(index).value();
  }
  double operator[](std::string_view label) const { return (*this)[variable_.index_of(label)]; }
  double at(std::size_t index) const {
    check::index(variable_, index);
    return (*this)[index];
  }

 private:
  void take(kernels::UnboundedRow numbers) {
    table_ = numbers.logs_or_plain(detail::algebra_of<Kind>());
    if constexpr (has_logs) numbers_ = std::move(numbers);
  }

  Variable<Kind> variable_;
  kernels::UnboundedRow numbers_;  // empty if only logarithms are known, and where there are none
  Table table_;                    // the logarithms; of an ordinal variable the numbers
};

template <Uncertainty Kind>
Likelihood(const Belief<Kind>&) -> Likelihood<Kind>;

}  // namespace sigmax
