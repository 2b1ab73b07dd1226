#pragma once

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/member.hpp>

namespace sigmax {

/// The cubature Kalman filter over a motion: 2n points of equal weight at x ± √n Lᵢ. This spherical–radial rule is
/// exact for polynomials of degree three (Arasaratnam and Haykin 2009). Nothing to tune, no negative weight.
///
/// Of a quadratic z = c + gᵀy + ½ yᵀBy of y = L⁻¹(x − x̄) it gives the exact mean c + ½ tr B and covariance with x,
/// and the variance gᵀg + ¼ n Σ B_ii² − ¼ (tr B)², in one dimension gᵀg; the exact one is gᵀg + ½ Σ B_ij².
template <Motion Moves>
class Cubature : public Member<Moves> {
 public:
  using Member<Moves>::Member;

  SigmaPointWeights weights() const { return {static_cast<double>(this->size()), 0.0, 0.0}; }
};

template <Motion Moves>
Cubature(Moves) -> Cubature<Moves>;

}  // namespace sigmax
