#pragma once

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/check.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/core/variable.hpp>
#include <sigmax/core/weight.hpp>

namespace sigmax {

/// How well each outcome of a variable explains a piece of evidence, up to a common factor. Never normalised; kept as
/// weights: logarithms, and for an ordinal variable the numbers themselves, none above one. `Kind` is that of the
/// variable over which it is a function; the evidence may be of the other kind, (19), (20).
template <Uncertainty Kind>
class Likelihood {
 public:
  using kind = Kind;
  static constexpr bool has_logs = ScalingAlgebra<AlgebraOf<Kind>>;

  /// Likelihoods, not logarithms. Throws std::invalid_argument unless all are finite and none is negative; those of an
  /// ordinal variable are at most one.
  Likelihood(Variable<Kind> variable, std::initializer_list<double> values)
      : Likelihood(std::move(variable), std::span(values.begin(), values.size())) {}
  Likelihood(Variable<Kind> variable, const std::vector<double>& values)
      : Likelihood(std::move(variable), std::span(values)) {}
  Likelihood(Variable<Kind> variable, std::span<const double> values)
      : variable_(std::move(variable)), weights_(1, values.size()) {
    check::size(variable_, {}, values.size());
    check::values(variable_, {}, values, Scale::greatest_value);
    std::transform(values.begin(), values.end(), weights_.data(), [](double value) { return Scale::of(value); });
  }

  /// One for every outcome: evidence that says nothing.
  explicit Likelihood(Variable<Kind> variable)
      : variable_(std::move(variable)), weights_(1, variable_.size(), Scale::of(1.0)) {}

  Likelihood(Variable<Kind> variable, Table weights, detail::ByLaw)
      : variable_(std::move(variable)), weights_(std::move(weights)) {}

  /// Sets the logarithm of one likelihood, −∞ for an excluded outcome. Throws std::invalid_argument for NaN or +∞.
  void set_log(std::size_t index, double log_likelihood) requires has_logs {
    if (!(log_likelihood <= std::numeric_limits<double>::max()))
      throw std::invalid_argument("the log-likelihood of '" + variable_.name() + "' at outcome '" +
                                  variable_.label(index) + "' is not a number below infinity");
    weights_(0, index) = log_likelihood;
  }

  const Variable<Kind>& variable() const& { return variable_; }
  Variable<Kind> variable() const&& { return variable_; }
  std::size_t size() const { return weights_.size(); }
  std::vector<double> all_logs() const requires has_logs { return Table(weights_).values(); }
  double log(std::size_t index) const requires has_logs { return weights_(0, index); }

  /// Likelihood on the scale on which evidence adds up: `Weight<AlgebraOf<Kind>>`.
  double weight(std::size_t index) const { return weights_(0, index); }
  double operator[](std::size_t index) const { return Scale::value(weight(index)); }
  double operator[](std::string_view label) const { return (*this)[variable_.index_of(label)]; }

 private:
  using Scale = Weight<AlgebraOf<Kind>>;
  Variable<Kind> variable_;
  Table weights_;
};

}  // namespace sigmax
