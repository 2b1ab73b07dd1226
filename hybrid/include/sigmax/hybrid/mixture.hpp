#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <sigmax/estimation/refs.hpp>
#include <sigmax/hybrid/collapse.hpp>
#include <sigmax/hybrid/state_augmentation.hpp>

namespace sigmax::detail {

/// Gaussians that are to become one, each read in the components of a receiver: dropped, augmented, or as it is. A
/// view.
struct Mixture {
  struct Part {
    ConstView estimate;
    const Correspondence* map = nullptr;  ///< of the receiver's components in the part; null if they are the same
    /// Where the part has component i of the receiver; −1 if it lacks it.
    int place(int i) const { return map ? map->in_source[static_cast<std::size_t>(i)] : i; }
  };
  ConstView receiver;  ///< lends what a part lacks, by the rule of augmenting
  std::span<const Part> parts;
  StateAugmentation augmentation = StateAugmentation::zero;

  int size() const { return receiver.n; }
  /// The mean of a part, and covariance += weight · that of a part, on and below the diagonal.
  void mean_of(const Part& part, double* mean) const;
  void add_covariance(const Part& part, double weight, double* covariance) const;
  /// One part, augmented.
  void read(const Part& part, View result) const;
};

/// @{
/// One Gaussian for a mixture; `weights` of the parts, `winner` the one that they select. Results are not among what
/// they are made of.
void collapse(const Selection& rule, const Mixture& mixture, const double* weights, std::size_t winner, View result);
void collapse(const MomentMatching& rule, const Mixture& mixture, const double* weights, std::size_t winner,
              View result);
/// @}

/// Mean and covariance of the mixture Σ weight N, whose covariance may have weights of its own, or lack the spread of
/// the means.
void match_moments(const Mixture& mixture, const double* weights, const double* covariance_weights, View result,
                   OutputSpread spread = OutputSpread::included);

/// Mean and covariance of the envelope max weight N, (A-1); returns its integral β, (A-11).
double match_envelope(const Mixture& mixture, const double* weights, View result);

/// @{
/// The mixed start of a mode, (55)–(57) or (58), (59). `weights` are those of the modes before, given what the mode is
/// now; `transposed` the ones that the authors' program uses for covariances; `own` is the mode's estimate, and
/// `favoured` wins ties if they are to stay.
void mix(const Selection& rule, const Mixture& mixture, const double* weights, const double* transposed,
         std::size_t favoured, ConstView own, View result);
void mix(const MomentMatching& rule, const Mixture& mixture, const double* weights, const double* transposed,
         std::size_t favoured, ConstView own, View result);
/// @}

}  // namespace sigmax::detail
