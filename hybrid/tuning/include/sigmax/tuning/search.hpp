#pragma once

#include <cstdint>
#include <functional>

#include <sigmax/hybrid/fit.hpp>

namespace sigmax {

/// How much a search asks of a function.
struct SearchOptions {
  std::size_t samples = 64;  ///< for each number: points of a Sobol sequence within all bounds, beside the start
  std::size_t starts = 2;    ///< of all these the best so many are where a local search begins
  std::size_t local = 25;    ///< evaluations of a local search, for each number and one more
  std::size_t rounds = 1;    ///< further local searches about the best of all, while they gain
  std::uint64_t seed = 1;    ///< which part of the sequence
};

/// Finds numbers with a small loss by NLopt. The best points of a Sobol sequence start local searches by BOBYQA (Powell
/// 2009), or by Sbplx where there is one number. A last search starts from the best result. For the loss see `fit`. One
/// thread evaluates it, and the result depends on the seed alone. Without parameters it is evaluated once.
///
///     const Fit best = search({{.name = "sigma_w", .start = 3.0, .least = 0.01, .most = 100.0}},
///                             [&](const std::vector<double>& x) { return rmse(x[0]); });
///
/// Throws std::invalid_argument as fit_search.
Fit search(const std::vector<FitParameter>& parameters, const std::function<double(const std::vector<double>&)>& loss,
           const SearchOptions& options = {});

}  // namespace sigmax
