#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <sigmax/hybrid/future_evidence.hpp>

namespace sigmax {

/// One evidence for a mixture of parts that an estimate m + L ξ meets: what makes of N(m, LLᵀ) the Gaussian with the
/// moments of the mixture.
///
/// Its information is S⁻¹ − P⁻¹, where P is the covariance of the estimate and S that of the mixture, and is computed
/// without that difference. Let GᵀG = Σ wⱼ RⱼᵀRⱼ, RⱼᵀRⱼ = Gᵀ(1 − Nⱼ)G and H = G (P⁻¹ + GᵀG)⁻¹ Gᵀ. Then it is
///
///   Gᵀ(1 − Ξ)G,   Ξ = (X⁻¹ + H)⁻¹,   X = Σ wⱼ [(1 − Nⱼ H)⁻¹ Nⱼ + (qⱼ − q)(qⱼ − q)ᵀ],   q = Σ wⱼ qⱼ,
///
/// where H qⱼ is by how much G u moves in part j. All these matrices are at most of the size of 1, for parts that are
/// alike Ξ is zero.
template <int MaxN>
class EvidenceCollapse {
  static constexpr int dynamic = Eigen::Dynamic;
  using Evidence = FutureEvidence<MaxN>;
  using Matrix = SquareMatrix<dynamic, MaxN>;
  using State = Vector<dynamic, MaxN>;
  using Stack = Eigen::Map<Eigen::MatrixXd>;

 public:
  /// For mixtures of so many parts. Nothing is allocated afterwards.
  explicit EvidenceCollapse(std::size_t parts)
      : rows_((parts + 1) * MaxN * (MaxN + 1)), orthogonal_((parts + 1) * MaxN * MaxN) {}

  /// A part of weight zero does not count; `seen` is more evidence of the same state, of the same point. The result is
  /// both together. In a direction in which the mixture is so wide that the result had no information, it says nothing.
  void operator()(const std::vector<Evidence>& parts, std::span<const double> weights, const Matrix& L,
                  const Evidence& seen, Evidence& result);

 private:
  /// G (P⁻¹ + GᵀG)⁻¹ Gᵀ with P = L Lᵀ.
  static Matrix known(const Matrix& G, const Matrix& L);

  /// The evidence with the information GᵀZG and the vector Gᵀy, with what was seen.
  static void finish(const Matrix& G, Matrix& Z, State& y, const Evidence& seen, Evidence& result);

  std::vector<double> rows_, orthogonal_;
};

template <int MaxN>
void EvidenceCollapse<MaxN>::operator()(const std::vector<Evidence>& parts, std::span<const double> weights,
                                        const Matrix& L, const Evidence& seen, Evidence& result) {
  const Eigen::Index n = L.rows();
  Eigen::Index count = 0;
  for (std::size_t j = 0; j < parts.size(); ++j)
    if (weights[j] > 0.0) count += parts[j].R.rows();
  Stack stack(rows_.data(), std::max(count, n), n);
  stack.setZero();
  Eigen::Index row = 0;
  for (std::size_t j = 0; j < parts.size(); ++j) {
    if (!(weights[j] > 0.0)) continue;
    stack.middleRows(row, parts[j].R.rows()) = std::sqrt(weights[j]) * parts[j].R;
    row += parts[j].R.rows();
  }
  Stack U(orthogonal_.data(), stack.rows(), n);
  const detail::Triangle<2 * MaxN> triangle(stack, n);
  triangle.orthogonal(U);
  const Matrix G = stack.topRows(n).template triangularView<Eigen::Upper>();
  const Matrix H = known(G, L);
  const Matrix empty = U.bottomRows(stack.rows() - count).transpose() * U.bottomRows(stack.rows() - count);

  Matrix X = Matrix::Zero(n, n);
  Matrix squares = Matrix::Zero(n, n);
  State q = State::Zero(n);
  const auto for_each_part = [&](const auto& visit) {
    Eigen::Index first = 0;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      const double w = weights[j];
      if (!(w > 0.0)) continue;
      const Matrix E =
          empty + U.middleRows(first, parts[j].R.rows()).transpose() * U.middleRows(first, parts[j].R.rows()) / w;
      const Matrix N = Matrix::Identity(n, n) - E;
      const Matrix rest = Matrix::Identity(n, n) - N * H;
      const Eigen::PartialPivLU<Matrix> factor(rest);
      const State e = U.middleRows(first, parts[j].R.rows()).transpose() * parts[j].r / std::sqrt(w);
      visit(w, N, factor, State(factor.solve(e)));
      first += parts[j].R.rows();
    }
  };
  for_each_part([&](double w, const Matrix& N, const auto& factor, const State& q_j) {
    X += w * factor.solve(N);
    q += w * q_j;
  });
  for_each_part([&](double w, const Matrix&, const auto&, const State& q_j) {
    squares += w * (q_j - q) * (q_j - q).transpose();
  });
  X += squares;
  X = (0.5 * (X + X.transpose())).eval();
  const Matrix whole = Matrix::Identity(n, n) + X * H;
  const Eigen::PartialPivLU<Matrix> factor(whole);
  const Matrix Xi = factor.solve(X);
  Matrix Z = Matrix::Identity(n, n) - 0.5 * (Xi + Xi.transpose());
  State y = q - Xi * (H * q);
  finish(G, Z, y, seen, result);
}

template <int MaxN>
auto EvidenceCollapse<MaxN>::known(const Matrix& G, const Matrix& L) -> Matrix {
  const Eigen::Index n = L.rows();
  const Matrix K = G * L;
  Eigen::Matrix<double, dynamic, dynamic, 0, 2 * MaxN, MaxN> work(2 * n, n);
  work << K, Matrix::Identity(n, n);
  const detail::Triangle<2 * MaxN> triangle(work, n);
  Matrix half = K.transpose();
  work.topRows(n).template triangularView<Eigen::Upper>().transpose().solveInPlace(half);
  return half.transpose() * half;
}

template <int MaxN>
void EvidenceCollapse<MaxN>::finish(const Matrix& G, Matrix& Z, State& y, const Evidence& seen, Evidence& result) {
  const Eigen::Index n = G.rows();
  Matrix triangle = G;
  if (seen.R.rows() > 0) {
    Eigen::Matrix<double, dynamic, dynamic, 0, 2 * MaxN, MaxN> stack(n + seen.R.rows(), n);
    stack << G, seen.R;
    const detail::Triangle<2 * MaxN> both(stack, n);
    Eigen::Matrix<double, dynamic, dynamic, 0, 2 * MaxN, MaxN> U(stack.rows(), n);
    both.orthogonal(U);
    const auto of_G = U.topRows(n);
    const auto of_seen = U.bottomRows(seen.R.rows());
    Z = (of_G.transpose() * Z * of_G + of_seen.transpose() * of_seen).eval();
    y = (of_G.transpose() * y + of_seen.transpose() * seen.r).eval();
    triangle = stack.topRows(n).template triangularView<Eigen::Upper>();
  }
  constexpr double least = 1e-8;
  const Eigen::LLT<Matrix> factor(Z);
  if (factor.info() == Eigen::Success && factor.matrixLLT().diagonal().minCoeff() > std::sqrt(least)) {
    result.R = factor.matrixU() * triangle;
    result.r = factor.matrixL().solve(y);
    return;
  }
  // Along its axes, within what the triangle can reach: beyond that Z has no meaning.
  const State scale = triangle.colwise().norm().cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  const Matrix scaled = triangle * scale.asDiagonal();
  Eigen::ColPivHouseholderQR<Matrix> reached(scaled);
  reached.setThreshold(1e-12);
  if (reached.rank() == 0) {  // nothing was told
    result.clear(n);
    return;
  }
  const Matrix basis = reached.matrixQ();
  const auto range = basis.leftCols(reached.rank());
  const Matrix within = range.transpose() * Z * range;
  const Eigen::SelfAdjointEigenSolver<Matrix> axes(within);
  Eigen::Index kept = 0;
  result.R.resize(n, n);
  result.r.resize(n);
  for (Eigen::Index a = 0; a < reached.rank(); ++a) {
    const double value = axes.eigenvalues()(a);
    if (!(value > least)) continue;
    const State axis = range * axes.eigenvectors().col(a);
    result.R.row(kept) = std::sqrt(value) * axis.transpose() * triangle;
    result.r(kept) = axis.dot(y) / std::sqrt(value);
    ++kept;
  }
  result.R.conservativeResize(kept, n);
  result.r.conservativeResize(kept);
}

}  // namespace sigmax
