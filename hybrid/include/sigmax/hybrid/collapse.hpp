#pragma once

#include <cstddef>
#include <type_traits>

#include <sigmax/core/tie.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax {

/// Which of several equally possible modes counts; weights within 1e-9 in their logarithms are equal.
enum class Tie {
  stay,   ///< the mode itself (mixing) or the previous winner (output) if it is among them, else the first
  first,  ///< the lowest index
  last    ///< the highest index
};

namespace detail {

/// Index of the greatest weight of those that tie: `tied` compares one with the greatest, `index` makes a number of an
/// index, and `current` is the one that `Tie::stay` favours. Of numbers, or of vectors with a number for each track.
template <class Weight, class Tied, class Index, class V>
[[gnu::always_inline]] inline V select(std::size_t modes, const Weight& weight, const Tied& tied, const Index& index,
                                       V current, Tie tie) {
  auto greatest = weight(0);
  for (std::size_t i = 1; i < modes; ++i) greatest = weight(i) > greatest ? weight(i) : greatest;
  V winner{};
  for (std::size_t i = 0; i < modes; ++i) {
    const std::size_t place = tie == Tie::last ? i : modes - 1 - i;
    winner = tied(weight(place), greatest) ? index(place) : winner;
  }
  for (std::size_t i = 0; i < modes && tie == Tie::stay; ++i)
    winner = current == index(i) ? (tied(weight(i), greatest) ? current : winner) : winner;
  return winner;
}

/// The same of weights given as logarithms.
template <class LogWeight>
std::size_t select(std::size_t modes, const LogWeight& log_weight, std::size_t current, Tie tie) {
  return select(
      modes, log_weight, ties, [](std::size_t i) { return i; }, current, tie);
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

}  // namespace sigmax
