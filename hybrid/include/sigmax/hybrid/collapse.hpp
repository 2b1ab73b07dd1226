#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <sigmax/core/uncertainty.hpp>
#include <sigmax/hybrid/lift.hpp>

namespace sigmax {

/// Which of several equally possible modes counts; weights within 1e-9 in their logarithms are equal.
enum class Tie {
  stay,   ///< the mode itself (mixing) or the previous winner (output) if it is among them, else the first
  first,  ///< the lowest index
  last    ///< the highest index
};

inline constexpr double tie_tolerance = 1e-9;

/// Index of the greatest weight, given as logarithms. `current` is the mode that `Tie::stay` favours.
template <class LogWeight>
std::size_t select(std::size_t modes, const LogWeight& log_weight, std::size_t current, Tie tie) {
  double greatest = log_weight(0);
  for (std::size_t i = 1; i < modes; ++i) greatest = std::max(greatest, log_weight(i));
  const auto ties = [&](std::size_t i) { return log_weight(i) >= greatest - tie_tolerance; };
  if (tie == Tie::stay && ties(current)) return current;
  std::size_t winner = 0;
  for (std::size_t i = 0; i < modes; ++i)
    if (ties(i)) {
      winner = i;
      if (tie != Tie::last) break;
    }
  return winner;
}

/// Reading of the covariance (57) of a mixed start, with l the selected mode and j the receiving one.
enum class MixedCovariance {
  selected,       ///< Σˡ, as derived in (A-5)
  own,            ///< Σʲ, as printed: after (56) the printed spread is zero
  own_recentred,  ///< Σʲ + (xˡ − xʲ)(xˡ − xʲ)ᵀ
  released        ///< Σʲ + (xˡ − x¹)(xˡ − x¹)ᵀ: the authors' program, with the first model for every j
};

/// Weights of the covariance (59) of a mixed start.
enum class MixingWeights {
  correct,  ///< p(r_{k−1} = l | r_k = j), as of the mean
  released  ///< transposed, p(r_{k−1} = j | r_k = l), as in the authors' program: they do not sum to one
};

/// One Gaussian for a max-mixture is the one selected, (55)–(57), (64)–(66): max is selective.
struct Selection {
  MixedCovariance mixed_covariance = MixedCovariance::own_recentred;
  Tie mixing_tie = Tie::stay;
};

/// One Gaussian for a sum-mixture matches its first two moments, (58), (59), (67), (68).
struct MomentMatching {
  MixingWeights mixing_weights = MixingWeights::correct;
};

/// How mixtures over a mode of this kind collapse: the only place where IMM and HIMM part.
template <Uncertainty Kind>
using Collapse = std::conditional_t<SelectiveAlgebra<AlgebraOf<Kind>>, Selection, MomentMatching>;

/// Mean and covariance of the mixture Σ weight(l) N(l), whose covariance may have weights of its own.
template <class Mixture, class Weight, class CovarianceWeight, int N, int MaxN>
void match_moments(const Mixture& mixture, const Weight& weight, const CovarianceWeight& covariance_weight,
                   Gaussian<N, MaxN>& result) {
  result.mean.setZero();
  mixture.visit_all([&](std::size_t l, const auto& part) {
    if (weight(l) > 0.0) result.mean += weight(l) * part.mean();
  });
  result.covariance.setZero();
  mixture.visit_all([&](std::size_t l, const auto& part) {
    if (!(covariance_weight(l) > 0.0)) return;
    const Vector<N, MaxN> spread = part.mean() - result.mean;
    part.add_covariance(covariance_weight(l), result.covariance);
    result.covariance += (covariance_weight(l) * spread).lazyProduct(spread.transpose());
  });
  mirror_lower(result.covariance);
}

/// One Gaussian for a mixture of Gaussians. `mixture.visit_all(visit)` calls visit(l, part) for every mode and
/// `mixture.visit(l, visit)` for one; a part has mean() and add_covariance(weight, covariance). `weight(l)` is the
/// mode's weight, `winner` the mode selected by it. `result` has its size already.
template <class Mixture, class Weight, int N, int MaxN>
void collapse(const Selection&, const Mixture& mixture, const Weight&, std::size_t winner, Gaussian<N, MaxN>& result) {
  result.covariance.setZero();
  mixture.visit(winner, [&](const auto& part) {
    result.mean = part.mean();
    part.add_covariance(1.0, result.covariance);
  });
}
template <class Mixture, class Weight, int N, int MaxN>
void collapse(const MomentMatching&, const Mixture& mixture, const Weight& weight, std::size_t,
              Gaussian<N, MaxN>& result) {
  match_moments(mixture, weight, weight, result);
}

/// The mixed start of mode j, (55)–(57) or (58), (59). `move_in(l, j)` is the weight of mode l before, given mode j
/// now; `own` is the estimate of j.
template <class Mixture, class MoveIn, int N, int MaxN>
void mix(const Selection& rule, const Mixture& mixture, const MoveIn& move_in, std::size_t modes, std::size_t j,
         const Gaussian<N, MaxN>& own, Gaussian<N, MaxN>& result) {
  const std::size_t l = select(
      modes, [&](std::size_t i) { return std::log(move_in(i, j)); }, j, rule.mixing_tie);
  collapse(rule, mixture, move_in, l, result);
  if (rule.mixed_covariance == MixedCovariance::selected) return;
  result.covariance = own.covariance;
  if (rule.mixed_covariance == MixedCovariance::own) return;
  Vector<N, MaxN> spread = result.mean - own.mean;
  if (rule.mixed_covariance == MixedCovariance::released)
    mixture.visit(0, [&](const auto& first) { spread = result.mean - first.mean(); });
  result.covariance += spread * spread.transpose();
}
template <class Mixture, class MoveIn, int N, int MaxN>
void mix(const MomentMatching& rule, const Mixture& mixture, const MoveIn& move_in, std::size_t, std::size_t j,
         const Gaussian<N, MaxN>&, Gaussian<N, MaxN>& result) {
  const bool transposed = rule.mixing_weights == MixingWeights::released;
  match_moments(
      mixture, [&](std::size_t l) { return move_in(l, j); },
      [&](std::size_t l) { return transposed ? move_in(j, l) : move_in(l, j); }, result);
}

}  // namespace sigmax
