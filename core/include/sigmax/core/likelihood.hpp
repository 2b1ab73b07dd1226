#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/core/check.hpp>
#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/table.hpp>
#include <sigmax/core/variable.hpp>

namespace sigmax {

/// How well each outcome of a variable explains a piece of evidence, up to a common factor. Never normalised; kept as
/// logarithms. `Kind` is that of the variable over which it is a function; the evidence may be of the other kind, (19),
/// (20).
template <Uncertainty Kind>
class Likelihood {
 public:
  using kind = Kind;

  /// Likelihoods, not logarithms. Throws std::invalid_argument unless all are finite and none is negative.
  Likelihood(Variable<Kind> variable, std::initializer_list<double> values)
      : Likelihood(std::move(variable), std::span(values.begin(), values.size())) {}
  Likelihood(Variable<Kind> variable, const std::vector<double>& values)
      : Likelihood(std::move(variable), std::span(values)) {}
  Likelihood(Variable<Kind> variable, std::span<const double> values)
      : variable_(std::move(variable)), logs_(1, values.size()) {
    check::size(variable_, {}, values.size());
    check::values(variable_, {}, values, std::numeric_limits<double>::max());
    std::transform(values.begin(), values.end(), logs_.data(), [](double value) { return std::log(value); });
  }

  /// One for every outcome: evidence that says nothing.
  explicit Likelihood(Variable<Kind> variable) : variable_(std::move(variable)), logs_(1, variable_.size(), 0.0) {}

  /// Sets the logarithm of one likelihood, −∞ for an excluded outcome. Throws std::invalid_argument for NaN or +∞.
  void set_log(std::size_t index, double log_likelihood) {
    if (!(log_likelihood <= std::numeric_limits<double>::max()))
      throw std::invalid_argument("the log-likelihood of '" + variable_.name() + "' at outcome '" +
                                  variable_.label(index) + "' is not a number below infinity");
    logs_(0, index) = log_likelihood;
  }

  const Variable<Kind>& variable() const { return variable_; }
  std::size_t size() const { return logs_.size(); }
  std::span<const double> logs() const { return logs_.values(); }
  double log(std::size_t index) const { return logs_(0, index); }
  double operator[](std::size_t index) const { return std::exp(log(index)); }
  double operator[](std::string_view label) const { return (*this)[variable_.index_of(label)]; }

 private:
  Variable<Kind> variable_;
  Table logs_;
};

}  // namespace sigmax
