#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// The upper envelope of weighted Gaussians, p⁺(x) = max_l w_l N(x; m_l, P_l), and its integral: the exact and
/// which the paper approximates by one of the parts, (A-4).
///
/// It has no closed form. Each part is sampled at the same deterministic points, whose mean and covariance are exact,
/// and a point counts as the envelope does against the sum: ∫ p⁺ = Σ_l w_l E_l[p⁺ / Σ_m w_m N_m]. So parts that do not
/// overlap, and parts that are equal, come out exactly; between them β is right to about 1 % of itself in one or two
/// components, 2 % in nine.
///
/// A part may have no variance in some components, as Lift::zero gives, or in all. It then does not overlap parts that
/// vary in others, and its weight counts in full. The covariance of the components that vary is positive definite.
class Envelope {
 public:
  /// One whose memory the calling thread keeps.
  static Envelope& of_this_thread();

  /// No parts; those to come have `n` ≤ 32 components. Throws std::invalid_argument above.
  void clear(Eigen::Index n);

  /// A part of weight w ≥ 0 with a mean and a covariance, of which the lower triangle is read. Throws std::domain_error
  /// if the covariance of the components with a variance is not positive definite.
  void add(double weight, const Eigen::Ref<const Eigen::VectorXd>& mean,
           const Eigen::Ref<const Eigen::MatrixXd>& covariance);

  /// β = ∫ p⁺ in [max w, Σ w], and mean and covariance of p⁺/β. Throws std::logic_error if there is no part of positive
  /// weight.
  double match(Eigen::Ref<Eigen::VectorXd> mean, Eigen::Ref<Eigen::MatrixXd> covariance);

 private:
  static constexpr int max_size = 32;
  static constexpr int points = 128;
  using Column = Vector<Eigen::Dynamic, max_size>;
  using Square = SquareMatrix<Eigen::Dynamic, max_size>;
  using AtPoints = RectangularMatrix<Eigen::Dynamic, points, max_size, points>;

  struct Part {
    double weight = 0.0, log_scale = 0.0;  ///< log (w / |P|^½)
    Column mean;
    Square root;                               ///< L with P = L Lᵀ, in the components that vary
    std::vector<Eigen::Index> varies;          ///< the components with a variance
    double mass = 0.0;                         ///< its share of β
    Column shift;                              ///< mass times the mean of the deviations
    Square second;                             ///< mass times their second moment
    bool comparable(const Part& other) const;  ///< neither is singular to the other
  };

  static const AtPoints& normal_points(Eigen::Index n);
  void weigh(Part& part);
  const Part* begin() const { return parts_.data(); }
  const Part* end() const { return parts_.data() + count_; }

  Eigen::Index size_ = 0;
  std::size_t count_ = 0;
  std::vector<Part> parts_;  ///< kept for the memory they hold
  std::vector<Vector<points>> log_densities_;
  AtPoints whitened_;
  Square step_;
  Column apart_;
};

namespace detail {

/// One Gaussian with the moments of the envelope of a mixture, as `collapse` takes it; gives β.
template <class Mixture, class Weight, int N, int MaxN>
double match_envelope(const Mixture& mixture, const Weight& weight, Gaussian<N, MaxN>& result) {
  Envelope& envelope = Envelope::of_this_thread();
  envelope.clear(result.mean.size());
  mixture.visit_all([&](std::size_t l, const auto& part) {
    result.covariance.setZero();
    part.add_covariance(1.0, result.covariance);
    envelope.add(weight(l), part.mean(), result.covariance);
  });
  return envelope.match(result.mean, result.covariance);
}

}  // namespace detail

}  // namespace sigmax
