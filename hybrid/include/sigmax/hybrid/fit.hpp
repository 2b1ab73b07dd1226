#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sigmax {

/// In what form a search sees a number: as it is, a positive one as its logarithm, one between 0 and 1 as its logit.
/// There a step means the same wherever it is taken, and every number is possible.
enum class Scale { linear, logarithmic, logistic };

/// A number that is to be fitted.
struct FitParameter {
  std::string name;
  double start = 1.0;
  Scale scale = Scale::logarithmic;
  double unit = 1.0;   ///< of a linear one, scaled
  double step = 0.5;   ///< what a search tries first, and further starts are away, scaled
  double reach = 9.0;  ///< how far from the start the search goes, scaled

  double scaled(double value) const {
    if (scale == Scale::logistic) return std::log(value) - std::log1p(-value);
    return scale == Scale::logarithmic ? std::log(value) : value / unit;
  }
  double value(double scaled) const {
    if (scale == Scale::logistic) return 1.0 / (1.0 + std::exp(-scaled));
    return scale == Scale::logarithmic ? std::exp(scaled) : scaled * unit;
  }
};

/// What is asked of a search, all in scaled numbers.
struct FitSearch {
  std::vector<double> start, lower, upper, step;
};

/// How often a fit starts, and from where.
struct FitOptions {
  std::size_t starts = 1;  ///< the first where the parameters say, others about it
  std::uint64_t seed = 1;  ///< of the others
};

/// What a fit found.
struct Fit {
  std::vector<double> values;  ///< of the parameters
  double loss = std::numeric_limits<double>::infinity();
  std::size_t evaluations = 0;
};

/// Start number s of a fit. It depends on the seed and s alone, so that starts may be fitted in any order, on any
/// number of threads: the first is where the parameters start, the others within two steps of it.
/// Throws std::invalid_argument, naming it, for a parameter that cannot start where it is.
inline FitSearch fit_search(const std::vector<FitParameter>& parameters, std::uint64_t seed, std::size_t s) {
  std::seed_seq seeds{seed & 0xFFFFFFFFU, seed >> 32U, std::uint64_t{s}};
  std::mt19937_64 random(seeds);
  FitSearch search;
  for (const auto& parameter : parameters) {
    const double start = parameter.scaled(parameter.start);
    if (!std::isfinite(start) || !(parameter.step > 0.0) || !(parameter.reach > 0.0))
      throw std::invalid_argument("the parameter '" + parameter.name + "' cannot start at " +
                                  std::to_string(parameter.start) + " and be fitted in its scale");
    const double away = 4.0 * static_cast<double>(random() >> 11U) * 0x1p-53 - 2.0;
    search.lower.push_back(start - parameter.reach);
    search.upper.push_back(start + parameter.reach);
    search.start.push_back(
        s == 0 ? start : std::clamp(start + away * parameter.step, search.lower.back(), search.upper.back()));
    search.step.push_back(parameter.step);
  }
  return search;
}

/// Finds numbers with a small loss, from start number s. `loss(values)` is any function of the numbers: minus the
/// log_score of a filter with these settings over a recording, an error against the truth, …; where it throws
/// std::domain_error or is no number, it counts as infinite. `minimise(function, search)` is any search without
/// derivatives, say one of NLopt's: it calls function(scaled numbers) and never sees an infinite loss, but 1e100. What
/// counts is the best that the function was ever asked, and never worse than the start.
template <class Loss, class Minimise>
Fit fit_from(const std::vector<FitParameter>& parameters, const Loss& loss, const Minimise& minimise,
             const FitSearch& search) {
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

/// The best of several starts, the first of those that are as good. The library brings no search along:
///
///     const Fit best = fit({{.name = "sigma_w", .start = 3.0}, {.name = "sigma_position_m", .start = 10.0}},
///                          [&](const std::vector<double>& x) { return -score(x[0], x[1]); }, by_nlopt, {.starts = 3});
///
/// The result is that of the seed.
template <class Loss, class Minimise>
Fit fit(const std::vector<FitParameter>& parameters, const Loss& loss, const Minimise& minimise,
        const FitOptions& options = {}) {
  Fit best;
  std::size_t evaluations = 0;
  for (std::size_t s = 0; s < std::max<std::size_t>(options.starts, 1); ++s) {
    Fit found = fit_from(parameters, loss, minimise, fit_search(parameters, options.seed, s));
    evaluations += found.evaluations;
    if (s == 0 || found.loss < best.loss) best = std::move(found);
  }
  best.evaluations = evaluations;
  return best;
}

}  // namespace sigmax
