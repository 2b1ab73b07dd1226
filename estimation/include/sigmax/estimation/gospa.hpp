#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace sigmax {

/// Positions of several targets at one time, or of several estimates; each point has the same number of coordinates.
using PointSet = std::vector<std::vector<double>>;

/// When a target counts as missed, and how errors are added.
struct GospaSettings {
  double cutoff = 10.0;  ///< c in m: an estimate at this distance or farther belongs to another target
  double order = 2.0;    ///< p ≥ 1; larger orders punish outliers more
};

/// GOSPA of estimates against the truth, and its parts, which are p-th powers: value^p is their sum.
struct Gospa {
  double value = 0.0;
  double localisation = 0.0;                            ///< Σ dᵖ over targets with an estimate
  double missed = 0.0;                                  ///< cᵖ/2 for each target without an estimate
  double false_targets = 0.0;                           ///< cᵖ/2 for each estimate without a target
  std::vector<std::optional<std::size_t>> estimate_of;  ///< the estimate of each target, or none
};

/// Generalised optimal sub-pattern assignment metric with α = 2 (Rahmathullah, García-Fernández and Svensson, FUSION
/// 2017). It is a minimum over assignments γ of targets to estimates, each used at most once:
///
///   (Σ_{(i,j) ∈ γ} d(xᵢ, yⱼ)ᵖ + cᵖ/2 (|X| + |Y| − 2 |γ|))^(1/p).
///
/// d is Euclidean. Throws std::invalid_argument unless c is positive and finite, 1 ≤ p < ∞, and points have one size
/// and finite coordinates.
Gospa gospa(const PointSet& truth, const PointSet& estimates, const GospaSettings& settings = {});

/// Optimal sub-pattern assignment metric (Schuhmacher, Vo and Vo, IEEE TSP 56:3447, 2008), an error for each point of
/// the larger set. Sets have n and m ≤ n points:
///
///   (1/n (min_π Σᵢ min(c, d(xᵢ, y_π(i)))ᵖ + cᵖ (n − m)))^(1/p), and 0 if both sets are empty.
///
/// Takes and refuses the same as `gospa`. It does not tell missed targets from false ones.
double ospa(const PointSet& truth, const PointSet& estimates, const GospaSettings& settings = {});

}  // namespace sigmax
