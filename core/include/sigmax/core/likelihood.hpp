#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
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
  using Row = kernels::LosslessRow<AlgebraOf<Kind>>;
  static constexpr bool has_logs = ScalingAlgebra<AlgebraOf<Kind>>;

  /// Likelihoods, not logarithms. Throws std::invalid_argument unless all are finite and none is negative; those of an
  /// ordinal variable are at most one.
  Likelihood(Variable<Kind> variable, std::initializer_list<double> values)
      : Likelihood(std::move(variable), std::span(values.begin(), values.size())) {}
  Likelihood(Variable<Kind> variable, const std::vector<double>& values)
      : Likelihood(std::move(variable), std::span(values)) {}
  Likelihood(Variable<Kind> variable, std::span<const double> values) : variable_(std::move(variable)) {
    check::size(variable_, {}, values.size());
    check::values(variable_, {}, values, detail::greatest_weight<AlgebraOf<Kind>>);
    numbers_ = Row(values);
    take_logs();
  }

  /// One for every outcome: evidence that says nothing.
  explicit Likelihood(Variable<Kind> variable)
      : variable_(std::move(variable)), logs_(1, has_logs ? variable_.size() : 0) {
    if constexpr (!has_logs) numbers_ = Row(variable_.size(), 1.0);
  }

  /// What is believed, read as evidence.
  template <Uncertainty Same>
    requires std::same_as<Same, Kind>
  explicit Likelihood(const Belief<Same>& belief) : variable_(belief.variable()) {
    logs_.reshape(1, belief.size());
    std::copy(belief.logs().begin(), belief.logs().end(), logs_.data());
  }

  /// Numbers of any size, and logarithms, for the verbs.
  Likelihood(Variable<Kind> variable, Row numbers, detail::ByLaw)
      : variable_(std::move(variable)), numbers_(std::move(numbers)) {
    take_logs();
  }
  Likelihood(Variable<Kind> variable, Table logs, detail::ByLaw) requires has_logs : variable_(std::move(variable)),
                                                                                     logs_(std::move(logs)) {}

  /// Sets the logarithm of one likelihood, −∞ for an excluded outcome; logarithms are all that is kept then. Throws
  /// std::invalid_argument for NaN or +∞.
  void set_log(std::size_t index, double log_likelihood) requires has_logs {
    if (!(log_likelihood <= std::numeric_limits<double>::max()))
      throw std::invalid_argument("the log-likelihood of '" + variable_.name() + "' at outcome '" +
                                  variable_.label(index) + "' is not a number below infinity");
    numbers_.clear();
    logs_(0, index) = log_likelihood;
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return variable_.size(); }

  /// The logarithms: a view that lives as long as the likelihood; of a temporary, a copy.
  std::span<const double> logs() const& requires has_logs { return logs_.values(); }
  std::vector<double> logs() const&& requires has_logs { return Table(logs_).values(); }
  double log(std::size_t index) const requires has_logs { return logs_(0, index); }

  /// One likelihood as a number that does not underflow; of an ordinal variable a double.
  typename Row::Number number(std::size_t index) const {
    if constexpr (has_logs)
      if (numbers_.size() == 0) return ScaledNumber::exp(logs_(0, index));
    return numbers_[index];
  }
  /// All of them, as they are kept; none if only logarithms are known.
  std::span<const typename Row::Number> numbers() const& { return numbers_.numbers(); }

  bool excludes(std::size_t index) const {
    if constexpr (has_logs)
      return logs_(0, index) == log_zero;
    else
      return Row::is_zero(numbers_[index]);
  }

  /// One likelihood as a double, exactly as it was given unless that was a logarithm. `at` throws std::invalid_argument
  /// if there is no such index, [] does not look.
  double operator[](std::size_t index) const { return Row::value_of(number(index)); }
  double operator[](std::string_view label) const { return (*this)[variable_.index_of(label)]; }
  double at(std::size_t index) const {
    check::index(variable_, index);
    return (*this)[index];
  }

 private:
  void take_logs() {
    if constexpr (has_logs) {
      logs_.reshape(1, numbers_.size());
      for (std::size_t i = 0; i < numbers_.size(); ++i) logs_(0, i) = numbers_.log(i);
    }
  }

  Variable<Kind> variable_;
  Row numbers_;  // empty if only logarithms are known
  Table logs_{0, 0};
};

template <Uncertainty Kind>
Likelihood(const Belief<Kind>&) -> Likelihood<Kind>;

}  // namespace sigmax
