#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/estimation/refs.hpp>

namespace sigmax {

/// What came to be known of a state of n components: the likelihood exp(−|R u − r|²/2) of its distance u from a point.
/// The rows of R are the square root of its information, which is never a difference of two others; without a row it
/// knows nothing.
class FutureEvidence {
 public:
  /// Nothing is known of a state of n components.
  explicit FutureEvidence(int n = 0) { clear(n); }
  void clear(int n);

  int size() const { return n_; }
  int rows() const { return rows_; }
  /// R, rows × n by columns, and r behind it.
  const double* R() const { return numbers_.data(); }
  const double* r() const { return numbers_.data() + rows_ * n_; }

  /// So many rows, to be written; of more than n rows only what is told of n is kept, see `add`.
  double* write(int rows);

  /// Two pieces of evidence about the same point become one of at most n rows; the other may have more.
  void add(const double* R, const double* r, int rows);
  void add(const FutureEvidence& other) { add(other.R(), other.r(), other.rows()); }

  /// Tells it in other coordinates of the state, as a filter's `transform` does an estimate: A, by columns, of the
  /// position and its derivatives.
  void transform(const double* A, int axes);

  /// The evidence on an earlier state x of m components, where u = offset + B x + A η and η ~ N(0, 1) has q components.
  /// Returns the logarithm of the factor that η leaves.
  double carry_back(const double* offset, const double* B, int m, const double* A, int q, FutureEvidence& result) const;

  /// The estimate m + L ξ, ξ ~ N(0, 1), meets the evidence about m; returns the logarithm of how well.
  double meet(const double* L, detail::View estimate) const;

 private:
  int n_ = 0, rows_ = 0;
  std::vector<double> numbers_;  ///< [R r], by columns
};

namespace detail {

/// One evidence for a mixture of parts that an estimate m + L ξ meets: what makes of N(m, LLᵀ) the Gaussian with the
/// moments of the mixture. A part of weight zero does not count; `seen` is more evidence about the same point, which is
/// added. In a direction in which the mixture is so wide that the result had no information, it says nothing.
///
/// Its information is S⁻¹ − P⁻¹, where P is the covariance of the estimate and S that of the mixture, and is computed
/// without that difference. Let GᵀG = Σ wⱼ RⱼᵀRⱼ, RⱼᵀRⱼ = Gᵀ(1 − Nⱼ)G and H = G (P⁻¹ + GᵀG)⁻¹ Gᵀ. Then it is
///
///   Gᵀ(1 − Ξ)G,   Ξ = (X⁻¹ + H)⁻¹,   X = Σ wⱼ [(1 − Nⱼ H)⁻¹ Nⱼ + (qⱼ − q)(qⱼ − q)ᵀ],   q = Σ wⱼ qⱼ,
///
/// where H qⱼ is by how much G u moves in part j. All these matrices are at most of the size of 1, for parts that are
/// alike Ξ is zero.
void collapse(const std::vector<FutureEvidence>& parts, const std::vector<double>& weights, const double* L,
              const FutureEvidence& seen, FutureEvidence& result);

}  // namespace detail

}  // namespace sigmax
