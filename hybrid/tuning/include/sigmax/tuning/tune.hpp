#pragma once

#include <sigmax/hybrid/cross_validation.hpp>
#include <sigmax/tuning/search.hpp>

namespace sigmax {

/// The numbers to tune, and the loss of each row by their values.
struct TuneProblem {
  std::vector<FitParameter> parameters;
  std::function<RowLosses(const std::vector<double>& values)> losses;  ///< may throw where a filter fails
  std::function<double(const RowLosses& losses, const RowCounts& counts)> objective = mean_loss;  ///< is made least
  bool likelihood = true;  ///< whether losses are in nats, so that two of all rows are two standard errors
};

/// Numbers that were fitted to all rows, and what rows lose by them.
struct Tuned {
  Fit fit;             ///< its loss is the objective
  RowLosses held_out;  ///< each row's by numbers that were fitted to the other folds
  LossSurface surface;
  std::vector<std::size_t> inside;  ///< the numbers of the surface: those that are not at a bound
};

/// Fits the numbers by `search` to all rows. Of each fold the numbers that have not seen it are one step of Newton's
/// from there, by the same curvature as the standard errors, if that is better for the other folds. The result is that
/// of the seed.
Tuned tune(const TuneProblem& problem, const RowFolds& folds, const SearchOptions& options = {});

/// Standard error of each number in its scale: H⁻¹ J H⁻¹ of the surface, or the profile likelihood's where that is
/// greater. The profile is the least loss with the number fixed and the others fitted again. A number at a bound, or
/// uncertain by more than a factor of e, is not identifiable: its error is infinite. With correlated errors the slopes
/// of `together` consecutive rows are summed first.
std::vector<double> standard_errors(const TuneProblem& problem, const Tuned& tuned, std::size_t together = 1);

}  // namespace sigmax
