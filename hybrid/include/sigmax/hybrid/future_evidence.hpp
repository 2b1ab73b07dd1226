#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/LU>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

namespace detail {

/// Turns the first `columns` columns of a matrix into an upper triangle by reflections of its rows, in place. The
/// greatest entry of each column leads, so that rows of very different size keep their digits (Cox, Higham 1998).
template <int MaxColumns>
class Triangle {
 public:
  using Rows = Eigen::Ref<Eigen::MatrixXd>;

  Triangle(Rows rows, Eigen::Index columns);

  /// The sum of the logarithms of the diagonal's sizes.
  double log_determinant() const { return rows_.diagonal().head(columns_).array().abs().log().sum(); }

  /// The first columns of the orthogonal Q with rows = Q · triangle.
  void orthogonal(Rows Q) const;

 private:
  struct Reflection {
    Eigen::Index lead;
    double v0, scale;
  };

  void reflect(Rows& target, Eigen::Index c, Eigen::Index column) const;

  Rows rows_;
  Eigen::Index columns_;
  std::array<Reflection, static_cast<std::size_t>(MaxColumns)> reflections_;
};

template <int MaxColumns>
Triangle<MaxColumns>::Triangle(Rows rows, Eigen::Index columns)
    : rows_(rows), columns_(std::min(columns, rows.rows())) {
  for (Eigen::Index c = 0; c < columns_; ++c) {
    auto& [lead, v0, scale] = reflections_[static_cast<std::size_t>(c)];
    const Eigen::Index below = rows.rows() - c - 1;
    rows.col(c).tail(below + 1).cwiseAbs().maxCoeff(&lead);
    lead += c;
    if (lead != c) rows.row(c).swap(rows.row(lead));
    const double first = rows(c, c);
    const double diagonal = std::copysign(rows.col(c).tail(below + 1).stableNorm(), -first);
    v0 = first - diagonal;  // 1 − scale (v0, v)(v0, v)ᵀ, with v left below the diagonal
    scale = diagonal == 0.0 ? 0.0 : -1.0 / (diagonal * v0);
    for (Eigen::Index other = c + 1; other < rows.cols(); ++other) reflect(rows_, c, other);
    rows(c, c) = diagonal;
  }
}

template <int MaxColumns>
void Triangle<MaxColumns>::orthogonal(Rows Q) const {
  Q.setIdentity();
  for (Eigen::Index c = columns_; c-- > 0;)
    for (Eigen::Index other = c; other < Q.cols(); ++other) reflect(Q, c, other);
  for (Eigen::Index c = columns_; c-- > 0;) {  // all last, as every exchange of rows moved the earlier v, too
    const Eigen::Index lead = reflections_[static_cast<std::size_t>(c)].lead;
    if (lead != c) Q.row(c).swap(Q.row(lead));
  }
}

template <int MaxColumns>
void Triangle<MaxColumns>::reflect(Rows& target, Eigen::Index c, Eigen::Index column) const {
  const auto& [lead, v0, scale] = reflections_[static_cast<std::size_t>(c)];
  const Eigen::Index below = rows_.rows() - c - 1;
  const auto v = rows_.col(c).tail(below);
  auto rest = target.col(column).tail(below);
  const double product = scale * (v0 * target(c, column) + v.dot(rest));
  target(c, column) -= product * v0;
  rest -= product * v;
}

}  // namespace detail

/// What came to be known of a state of n components: the likelihood exp(−|R u − r|²/2) of its distance u from a point.
/// The rows of R are the square root of its information, which is never a difference of two others; without a row it
/// knows nothing.
template <int MaxN>
struct FutureEvidence {
  static constexpr int dynamic = Eigen::Dynamic;
  using Rows = RectangularMatrix<dynamic, dynamic, MaxN, MaxN>;
  using State = Vector<dynamic, MaxN>;
  using Noise = RectangularMatrix<dynamic, dynamic, MaxN, 2 * MaxN>;

  Rows R;
  State r;

  /// Nothing is known of a state of n components.
  void clear(Eigen::Index n) {
    R.resize(0, n);
    r.resize(0);
  }

  /// Two pieces of evidence about the same point become one of at most n rows; the other may have more.
  template <int MaxRows>
  void add(const RectangularMatrix<dynamic, dynamic, MaxRows, MaxN>& other_R, const Vector<dynamic, MaxRows>& other_r) {
    if (other_R.rows() == 0) return;
    const Eigen::Index n = R.cols();
    Eigen::Matrix<double, dynamic, dynamic, 0, MaxN + MaxRows, MaxN + 1> stack(R.rows() + other_R.rows(), n + 1);
    stack << R, r, other_R, other_r;
    const detail::Triangle<2 * MaxN> triangle(stack, n);
    take(stack, std::min(n, stack.rows()), n);
  }

  /// Tells it in other coordinates of the state, as `transform` does an estimate: A of the position and its
  /// derivatives.
  void transform(const SquareMatrix<dynamic, 3>& A);

  /// The evidence of a state x of which this state was made, u = offset + B x + A η with η ~ N(0, 1); returns the
  /// logarithm of the factor that η leaves.
  double carry_back(const State& offset, const Rows& B, const Noise& A, FutureEvidence& result) const;

  /// The estimate m + L ξ, ξ ~ N(0, 1), meets the evidence about m; returns the logarithm of how well.
  double meet(const SquareMatrix<dynamic, MaxN>& L, Gaussian<dynamic, MaxN>& estimate) const;

  /// Takes the triangle of n columns on top of a matrix, and the column beside it.
  void take(const Eigen::Ref<const Eigen::MatrixXd>& matrix, Eigen::Index rows, Eigen::Index n) {
    R = matrix.topLeftCorner(rows, n).template triangularView<Eigen::Upper>();
    r = matrix.col(n).head(rows);
  }
};

template <int MaxN>
void FutureEvidence<MaxN>::transform(const SquareMatrix<dynamic, 3>& A) {
  const SquareMatrix<dynamic, 3> inverse = A.inverse();
  for (Eigen::Index d = 0; d + A.rows() <= R.cols(); d += A.rows())
    R.middleCols(d, A.rows()) = (R.middleCols(d, A.rows()) * inverse).eval();
}

template <int MaxN>
double FutureEvidence<MaxN>::carry_back(const State& offset, const Rows& B, const Noise& A,
                                        FutureEvidence& result) const {
  const Eigen::Index q = A.cols();
  const Eigen::Index n = B.cols();
  if (R.rows() == 0) {
    result.clear(n);
    return 0.0;
  }
  Eigen::Matrix<double, dynamic, dynamic, 0, 3 * MaxN, 3 * MaxN + 1> work(R.rows() + q, q + n + 1);
  work.topLeftCorner(R.rows(), q) = R.lazyProduct(A);
  work.block(0, q, R.rows(), n) = R.lazyProduct(B);
  work.col(q + n).head(R.rows()) = r - R.lazyProduct(offset);
  work.bottomRows(q).setIdentity();
  work.bottomRows(q).rightCols(n + 1).setZero();
  const detail::Triangle<2 * MaxN> triangle(work, q);
  result.R = work.block(q, q, R.rows(), n);
  result.r = work.col(q + n).tail(R.rows());
  return -triangle.log_determinant();
}

template <int MaxN>
double FutureEvidence<MaxN>::meet(const SquareMatrix<dynamic, MaxN>& L, Gaussian<dynamic, MaxN>& estimate) const {
  const Eigen::Index n = estimate.size();
  Eigen::Matrix<double, dynamic, dynamic, 0, 2 * MaxN, MaxN + 1> work(R.rows() + n, n + 1);
  work.topLeftCorner(R.rows(), n) = R.lazyProduct(L);
  work.col(n).head(R.rows()) = r;
  work.bottomRows(n).setIdentity();
  work.col(n).tail(n).setZero();
  const detail::Triangle<2 * MaxN> triangle(work, n);
  const auto T = work.topLeftCorner(n, n).template triangularView<Eigen::Upper>();
  SquareMatrix<dynamic, MaxN> root = L.transpose();  // T⁻ᵀ Lᵀ, whose columns are those of (L T⁻¹)ᵀ
  T.transpose().solveInPlace(root);
  estimate.mean += root.transpose().lazyProduct(work.col(n).head(n));
  estimate.covariance = root.transpose().lazyProduct(root);
  detail::mirror_lower(estimate.covariance);
  return -triangle.log_determinant() - 0.5 * work.col(n).tail(R.rows()).squaredNorm();
}

}  // namespace sigmax
