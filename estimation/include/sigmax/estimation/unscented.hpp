#pragma once

#include <string_view>
#include <utility>

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/member.hpp>

namespace sigmax {

/// Scaling of the unscented transform (Julier and Uhlmann 1997; Wan and van der Merwe 2000). Its spread is
/// c = α² (n + κ). The weight of the centre is 1 − n/c for means and 1 − n/c + 1 − α² + β for covariances.
///
/// The defaults are such that no weight is negative, so no covariance loses its definiteness. κ = 3 − n with β = 0
/// matches the fourth moment along each axis, but has negative weights from four states on.
struct UnscentedScaling {
  double alpha = 1.0;
  double beta = 2.0;
  double kappa = 0.0;
};

namespace detail {
/// Throws std::invalid_argument, naming the model, of n states, unless α² (n + κ) is positive and all three are finite.
SigmaPointWeights unscented_weights(const UnscentedScaling& scaling, std::string_view model, int n);
}  // namespace detail

/// The unscented Kalman filter over a motion: no Jacobians, 2n + 1 evaluations of f and of h.
///
/// Of a quadratic z = c + gᵀy + ½ yᵀBy of y = L⁻¹(x − x̄) it gives the exact mean c + ½ tr B and covariance with x,
/// and the variance gᵀg + ¼ c Σ B_ii² + ¼ (β − α²)(tr B)²; the exact one is gᵀg + ½ Σ B_ij².
template <Motion Moves>
class Unscented : public Member<Moves> {
 public:
  /// Throws std::invalid_argument unless α² (n + κ) is positive and all three numbers are finite.
  explicit Unscented(Moves motion, const UnscentedScaling& scaling = {})
      : Member<Moves>(std::move(motion)),
        scaling_(scaling),
        weights_(detail::unscented_weights(scaling, this->name(), static_cast<int>(this->size()))) {}

  const UnscentedScaling& scaling() const { return scaling_; }
  const SigmaPointWeights& weights() const { return weights_; }

 private:
  UnscentedScaling scaling_;
  SigmaPointWeights weights_;
};

}  // namespace sigmax
