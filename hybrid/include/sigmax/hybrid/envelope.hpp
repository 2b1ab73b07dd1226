#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/hybrid/estimates.hpp>

namespace sigmax {

/// The upper envelope of weighted Gaussians, p⁺(x) = max_l w_l N(x; m_l, P_l), and its integral: the exact and
/// which the paper approximates by one of the parts, (A-4).
///
/// It has no closed form. Each part is sampled at the same deterministic points, whose mean and covariance are exact,
/// and a point counts as the envelope does against the sum: ∫ p⁺ = Σ_l w_l E_l[p⁺ / Σ_m w_m N_m]. So parts that do not
/// overlap, and parts that are equal, come out exactly; between them β is right to about 1 % of itself in one or two
/// components, 2 % in nine.
///
/// A part may have no variance in some components, as StateAugmentation::zero gives, or in all. It then does not
/// overlap parts that vary in others, and its weight counts in full. The covariance of the components that vary is
/// positive definite.
class Envelope {
 public:
  static constexpr int max_size = detail::small_size;  ///< of components

  /// No parts; those to come have `n` ≤ max_size components. Throws std::invalid_argument above.
  void clear(int n);

  /// A part of weight w ≥ 0 with a mean and a covariance. The lower triangle is read. Throws std::domain_error
  /// if the covariance of the components with a variance is not positive definite.
  void add(double weight, detail::ConstView part);

  /// β = ∫ p⁺ in [max w, Σ w], and mean and covariance of p⁺/β. Throws std::logic_error if there is no part of positive
  /// weight.
  double match(detail::View result);

 private:
  using Square = detail::SmallMatrix;
  using Column = detail::SmallVector;

  struct Part {
    double weight = 0.0, log_scale = 0.0;  ///< log (w / |P|^½)
    Column mean;
    Square root;                                                   ///< L with P = L Lᵀ, in the components that vary
    Eigen::Matrix<int, Eigen::Dynamic, 1, 0, max_size, 1> varies;  ///< the components with a variance
    double mass = 0.0;                                             ///< its share of β
    Column shift;                                                  ///< mass times the mean of the deviations
    Square second;                                                 ///< mass times their second moment

    bool comparable(const Part& other) const;  ///< neither is singular to the other
  };

  void weigh(Part& part);

  int size_ = 0;
  std::size_t count_ = 0;
  std::vector<Part> parts_;  ///< kept for the memory they hold
};

}  // namespace sigmax
