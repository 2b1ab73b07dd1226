#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sigmax {

/// In what form a search sees a number: as it is, or a positive one as its logarithm. There a step means the same
/// wherever it is taken.
enum class Scale { linear, logarithmic };

/// A number that is to be fitted.
struct FitParameter {
  std::string name;
  double start = 1.0;
  Scale scale = Scale::logarithmic;
  /// @{
  /// The bounds of a search; where they are NaN, nine units of the scale from the start.
  double least = std::numeric_limits<double>::quiet_NaN();
  double most = std::numeric_limits<double>::quiet_NaN();
  /// @}
  double unit = 1.0;  ///< of a linear one, scaled
  double step = 0.5;  ///< what a search tries first, scaled

  double scaled(double value) const { return scale == Scale::logarithmic ? std::log(value) : value / unit; }
  double value(double scaled) const { return scale == Scale::logarithmic ? std::exp(scaled) : scaled * unit; }
};

/// What is asked of a search, all in scaled numbers.
struct FitSearch {
  std::vector<double> start, lower, upper, step;
};

/// What a fit found.
struct Fit {
  std::vector<double> values;  ///< of the parameters
  double loss = std::numeric_limits<double>::infinity();
  std::size_t evaluations = 0;
};

/// The numbers of a search, scaled; a start beyond its bounds begins at them. Throws std::invalid_argument, naming it,
/// for a parameter that cannot start where it is, or whose bounds are none.
inline FitSearch fit_search(const std::vector<FitParameter>& parameters) {
  constexpr double reach = 9.0;
  FitSearch search;
  for (const auto& parameter : parameters) {
    const double start = parameter.scaled(parameter.start);
    const double lower = std::isnan(parameter.least) ? start - reach : parameter.scaled(parameter.least);
    const double upper = std::isnan(parameter.most) ? start + reach : parameter.scaled(parameter.most);
    if (!std::isfinite(start) || !(parameter.step > 0.0) || !(lower < upper) || !std::isfinite(upper - lower))
      throw std::invalid_argument("the parameter '" + parameter.name + "' cannot start at " +
                                  std::to_string(parameter.start) + " and be fitted in its scale and bounds");
    search.lower.push_back(lower);
    search.upper.push_back(upper);
    search.start.push_back(std::clamp(start, lower, upper));
    search.step.push_back(parameter.step);
  }
  return search;
}

/// Finds numbers with a small loss. `loss(values)` is any function of the numbers: minus the log_score of a filter with
/// these settings over a recording, an error against the truth, …; where it throws std::domain_error or is no number,
/// it counts as infinite. `minimise(function, search)` is any search without derivatives: it calls function(scaled
/// numbers) and never sees an infinite loss, but 1e100. What counts is the best that the function was ever asked, and
/// never worse than the start. The library brings a search along in `sigmax/tuning/search.hpp`, by NLopt:
///
///     const Fit best = fit({{.name = "sigma_w", .start = 3.0}, {.name = "sigma_position_m", .start = 10.0}},
///                          [&](const std::vector<double>& x) { return -score(x[0], x[1]); }, by_my_search);
template <class Loss, class Minimise>
Fit fit(const std::vector<FitParameter>& parameters, const Loss& loss, const Minimise& minimise) {
  const FitSearch search = fit_search(parameters);
  Fit best;
  const auto values = [&](const std::vector<double>& scaled) {
    std::vector<double> result(scaled.size());
    for (std::size_t i = 0; i < scaled.size(); ++i) result[i] = parameters[i].value(scaled[i]);
    return result;
  };
  const auto function = [&](const std::vector<double>& scaled) {
    constexpr double worst = 1e100;
    std::vector<double> numbers = values(scaled);
    double found = worst;
    try {
      found = loss(std::as_const(numbers));
    } catch (const std::domain_error&) {
    }
    ++best.evaluations;
    if (!(found < worst)) return worst;
    if (found < best.loss) {
      best.loss = found;
      best.values = std::move(numbers);
    }
    return found;
  };
  best.values = values(search.start);
  function(search.start);
  if (!parameters.empty()) minimise(function, search);
  return best;
}

}  // namespace sigmax
