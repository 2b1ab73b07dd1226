#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <sigmax/core/tie.hpp>
#include <sigmax/core/uncertainty.hpp>
#include <sigmax/hybrid/envelope.hpp>
#include <sigmax/hybrid/lift.hpp>

namespace sigmax {

/// Which of several equally possible modes counts; weights within 1e-9 in their logarithms are equal.
enum class Tie {
  stay,   ///< the mode itself (mixing) or the previous winner (output) if it is among them, else the first
  first,  ///< the lowest index
  last    ///< the highest index
};

namespace detail {

/// Index of the greatest weight, given as logarithms. `current` is the mode that `Tie::stay` favours.
template <class LogWeight>
std::size_t select(std::size_t modes, const LogWeight& log_weight, std::size_t current, Tie tie) {
  double greatest = log_weight(0);
  for (std::size_t i = 1; i < modes; ++i) greatest = std::max(greatest, log_weight(i));
  const auto tied = [&](std::size_t i) { return ties(log_weight(i), greatest); };
  if (tie == Tie::stay && tied(current)) return current;
  std::size_t winner = 0;
  for (std::size_t i = 0; i < modes; ++i)
    if (tied(i)) {
      winner = i;
      if (tie != Tie::last) break;
    }
  return winner;
}

}  // namespace detail

/// Reading of the covariance (57) of a mixed start, with l the selected mode and j the receiving one.
enum class MixedCovariance {
  selected,       ///< Σˡ, as derived in (A-5)
  own,            ///< Σʲ, as printed: after (56) the printed spread is zero
  own_recentred,  ///< Σʲ + (xˡ − xʲ)(xˡ − xʲ)ᵀ
  released,       ///< Σʲ + (xˡ − x¹)(xˡ − x¹)ᵀ: the authors' program, with the first model for every j
  envelope  ///< none of them: mean and covariance of max_l π_l N(xˡ, Σˡ), (A-1), which (A-4) makes one part of
};

/// Weights of the covariance (59) of a mixed start.
enum class MixingWeights {
  correct,  ///< p(r_{k−1} = l | r_k = j), as of the mean
  released  ///< transposed, p(r_{k−1} = j | r_k = l), as in the authors' program: they do not sum to one
};

/// One Gaussian for a max-mixture is the one selected, (55)–(57), (64)–(66): max is selective. With
/// `MixedCovariance::envelope` it has the moments of the maximum itself, in the mixed starts, (A-1), and in the output,
/// its memory is the thread's, allocated once.
struct Selection {
  MixedCovariance mixed_covariance = MixedCovariance::own_recentred;
  Tie mixing_tie = Tie::stay;
};

/// Whether the covariance of the output, (68), has the spread of the means.
enum class OutputSpread {
  included,  ///< Σ w (P + (xʲ − x)(xʲ − x)ᵀ), the second moment
  omitted    ///< Σ w P, as printed
};

/// One Gaussian for a sum-mixture matches its first two moments, (58), (59), (67), (68).
struct MomentMatching {
  MixingWeights mixing_weights = MixingWeights::correct;
  OutputSpread output_spread = OutputSpread::included;
};

/// How mixtures over a mode of this kind collapse. It is here that IMM and HIMM part.
template <ScalableUncertainty Kind>
using Collapse = std::conditional_t<SelectiveAlgebra<AlgebraOf<Kind>>, Selection, MomentMatching>;

namespace detail {

/// The mean of the mixture Σ weight(l) N(l).
template <class Mixture, class Weight, int N, int MaxN>
void average_means(const Mixture& mixture, const Weight& weight, Vector<N, MaxN>& result) {
  result.setZero();
  mixture.visit_all([&](std::size_t l, const auto& part) {
    if (weight(l) > 0.0) result += weight(l) * part.mean();
  });
}

/// Mean and covariance of the mixture Σ weight(l) N(l), whose covariance may have weights of its own.
template <class Mixture, class Weight, class CovarianceWeight, int N, int MaxN>
void match_moments(const Mixture& mixture, const Weight& weight, const CovarianceWeight& covariance_weight,
                   Gaussian<N, MaxN>& result) {
  average_means(mixture, weight, result.mean);
  result.covariance.setZero();
  mixture.visit_all([&](std::size_t l, const auto& part) {
    if (!(covariance_weight(l) > 0.0)) return;
    const Vector<N, MaxN> spread = part.mean() - result.mean;
    part.add_covariance(covariance_weight(l), result.covariance);
    result.covariance += (covariance_weight(l) * spread).lazyProduct(spread.transpose());
  });
  mirror_lower(result.covariance);
}

}  // namespace detail

/// One Gaussian for a mixture of Gaussians. `mixture.visit_all(visit)` calls visit(l, part) for every part and
/// `mixture.visit(l, visit)` for one; a part has mean() and add_covariance(weight, covariance). `weight(l)` is the
/// part's weight, `winner` the one selected by it. `result` has its size already.
template <class Mixture, class Weight, int N, int MaxN>
void collapse(const Selection& rule, const Mixture& mixture, const Weight& weight, std::size_t winner,
              Gaussian<N, MaxN>& result) {
  if (rule.mixed_covariance == MixedCovariance::envelope) {
    detail::match_envelope(mixture, weight, result);
    return;
  }
  result.covariance.setZero();
  mixture.visit(winner, [&](const auto& part) {
    result.mean = part.mean();
    part.add_covariance(1.0, result.covariance);
  });
}
template <class Mixture, class Weight, int N, int MaxN>
void collapse(const MomentMatching& rule, const Mixture& mixture, const Weight& weight, std::size_t,
              Gaussian<N, MaxN>& result) {
  if (rule.output_spread == OutputSpread::included) return detail::match_moments(mixture, weight, weight, result);
  detail::average_means(mixture, weight, result.mean);
  result.covariance.setZero();
  mixture.visit_all([&](std::size_t l, const auto& part) { part.add_covariance(weight(l), result.covariance); });
}

/// The mixed start of a mode, (55)–(57) or (58), (59). `weight(l)` is that of mode l before, given what the mode is
/// now; `transposed(l)` the one that the authors' program uses for covariances; `own` is the mode's estimate, and
/// `favoured` wins ties if they are to stay.
template <class Mixture, class Weight, class Transposed, int N, int MaxN>
void mix(const Selection& rule, const Mixture& mixture, const Weight& weight, const Transposed&, std::size_t modes,
         std::size_t favoured, const Gaussian<N, MaxN>& own, Gaussian<N, MaxN>& result) {
  if (rule.mixed_covariance == MixedCovariance::envelope) {
    detail::match_envelope(mixture, weight, result);
    return;
  }
  const std::size_t l = detail::select(
      modes, [&](std::size_t i) { return std::log(weight(i)); }, favoured, rule.mixing_tie);
  collapse(rule, mixture, weight, l, result);
  if (rule.mixed_covariance == MixedCovariance::selected) return;
  result.covariance = own.covariance;
  if (rule.mixed_covariance == MixedCovariance::own) return;
  Vector<N, MaxN> spread = result.mean - own.mean;
  if (rule.mixed_covariance == MixedCovariance::released)
    mixture.visit(0, [&](const auto& first) { spread = result.mean - first.mean(); });
  result.covariance += spread * spread.transpose();
}
template <class Mixture, class Weight, class Transposed, int N, int MaxN>
void mix(const MomentMatching& rule, const Mixture& mixture, const Weight& weight, const Transposed& transposed,
         std::size_t, std::size_t, const Gaussian<N, MaxN>&, Gaussian<N, MaxN>& result) {
  if (rule.mixing_weights == MixingWeights::correct)
    detail::match_moments(mixture, weight, weight, result);
  else
    detail::match_moments(mixture, weight, transposed, result);
}

}  // namespace sigmax
