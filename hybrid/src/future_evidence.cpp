#include <sigmax/hybrid/future_evidence.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <sigmax/estimation/dense.hpp>
#include <sigmax/hybrid/estimates.hpp>

namespace sigmax {
namespace {

using detail::Scratch;

using Square = detail::SmallMatrix;
using Column = detail::SmallVector;
/// What has more rows lies in a Scratch. Products are lazy: without blocks for a cache, which small ones do not need.
using Tall = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Eigen::Dynamic, detail::small_size>>;
using Map = Eigen::Map<Eigen::MatrixXd>;
using ConstMap = Eigen::Map<const Eigen::MatrixXd>;

ConstMap R_of(const FutureEvidence& of) { return {of.R(), of.rows(), of.size()}; }
auto r_of(const FutureEvidence& of) { return Eigen::Map<const Eigen::VectorXd>(of.r(), of.rows()); }
/// [R r] of so many rows, to be written.
Map written(FutureEvidence& of, int rows) { return {of.write(rows), rows, of.size() + 1}; }

/// Turns the first `columns` of a matrix into an upper triangle by reflections of its rows, in place. The greatest
/// entry of each column leads, so that rows of very different size keep their digits (Cox, Higham 1998).
class Triangle {
 public:
  Triangle(double* numbers, Eigen::Index rows, Eigen::Index all_columns, Eigen::Index columns)
      : matrix_(numbers, rows, all_columns), columns_(std::min(columns, rows)) {
    for (Eigen::Index c = 0; c < columns_; ++c) {
      auto& [lead, v0, scale] = reflections_[c];
      auto column = matrix_.col(c).tail(rows - c);
      const double greatest = column.cwiseAbs().maxCoeff(&lead);
      lead += c;
      matrix_.row(c).swap(matrix_.row(lead));
      const double norm = greatest > 0.0 ? greatest * (column / greatest).norm() : 0.0;
      const double diagonal = std::copysign(norm, -column[0]);
      v0 = column[0] - diagonal;  // 1 − scale (v0, v)(v0, v)ᵀ, with v left below the diagonal
      scale = diagonal == 0.0 ? 0.0 : -1.0 / (diagonal * v0);
      for (Eigen::Index other = c + 1; other < all_columns; ++other) reflect(matrix_.col(other), c);
      column[0] = diagonal;
    }
  }

  /// The sum of the logarithms of the diagonal's sizes.
  double log_determinant() const { return matrix_.diagonal().head(columns_).array().abs().log().sum(); }

  /// The first columns of the orthogonal Q with matrix = Q · triangle, as many as Q has.
  void orthogonal(Tall Q) const {
    Q.setIdentity();
    for (Eigen::Index c = columns_; c-- > 0;)
      for (Eigen::Index other = c; other < Q.cols(); ++other) reflect(Q.col(other), c);
    for (Eigen::Index c = columns_; c-- > 0;)  // all last, as every exchange of rows moved the earlier v, too
      Q.row(c).swap(Q.row(reflections_[c].lead));
  }

  /// The triangle of a matrix with as many rows as columns or more.
  Square upper() const { return matrix_.topLeftCorner(columns_, columns_).triangularView<Eigen::Upper>(); }

  /// T⁻ᵀ Mᵀ with that triangle T.
  Square solve_transposed(const ConstMap& M) const {
    const Square L = upper().transpose();
    Square result = M.transpose();
    for (auto column : result.colwise()) detail::lower_solve(L.data(), static_cast<int>(columns_), column.data());
    return result;
  }

 private:
  struct Reflection {
    Eigen::Index lead;
    double v0, scale;
  };

  template <class Numbers>
  void reflect(Numbers column, Eigen::Index c) const {
    const auto& [lead, v0, scale] = reflections_[c];
    const auto v = matrix_.col(c).tail(matrix_.rows() - c - 1);
    auto below = column.tail(v.size());
    const double product = scale * (v0 * column[c] + v.dot(below));
    column[c] -= product * v0;
    below -= product * v;
  }

  Map matrix_;
  Eigen::Index columns_;
  Reflection reflections_[2 * detail::small_size];
};

}  // namespace

void FutureEvidence::clear(int n) {
  n_ = n;
  rows_ = 0;
  numbers_.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 1));
  numbers_.clear();
}

double* FutureEvidence::write(int rows) {
  rows_ = rows;
  numbers_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(n_ + 1));
  return numbers_.data();
}

void FutureEvidence::add(const double* other_R, const double* other_r, int other_rows) {
  if (other_rows == 0) return;
  const int all = rows_ + other_rows;
  Scratch<640> numbers(all * (n_ + 1));
  Map stack(numbers, all, n_ + 1);
  stack.topRows(rows_) = ConstMap(R(), rows_, n_ + 1);
  stack.bottomLeftCorner(other_rows, n_) = ConstMap(other_R, other_rows, n_);
  stack.col(n_).tail(other_rows) = ConstMap(other_r, other_rows, 1);
  const Triangle triangle(numbers, all, n_ + 1, n_);
  const int kept = std::min(n_, all);
  written(*this, kept) = stack.topRows(kept).triangularView<Eigen::Upper>();
}

void FutureEvidence::transform(const double* A, int axes) {
  const Square inverse =
      Eigen::PartialPivLU<Square>(ConstMap(A, axes, axes)).solve(Square(Square::Identity(axes, axes)));
  Map all(numbers_.data(), rows_, n_);
  for (int d = 0; d + axes <= n_; d += axes)
    all.middleCols(d, axes) = all.middleCols(d, axes).lazyProduct(inverse).eval();
}

double FutureEvidence::carry_back(const double* offset, const double* B, int m, const double* A, int q,
                                  FutureEvidence& result) const {
  result.clear(m);
  if (rows_ == 0) return 0.0;
  const int all = rows_ + q;
  Scratch<640> numbers(all * (q + m + 1));
  Map work(numbers, all, q + m + 1);
  const ConstMap R = R_of(*this);
  work.topLeftCorner(rows_, q).noalias() = R.lazyProduct(ConstMap(A, n_, q));
  work.block(0, q, rows_, m).noalias() = R.lazyProduct(ConstMap(B, n_, m));
  work.col(q + m).head(rows_) = r_of(*this);
  work.col(q + m).head(rows_).noalias() -= R.lazyProduct(ConstMap(offset, n_, 1));
  work.bottomRows(q).setIdentity();
  const Triangle triangle(numbers, all, q + m + 1, q);
  written(result, rows_) = work.bottomRightCorner(rows_, m + 1);
  return -triangle.log_determinant();
}

double FutureEvidence::meet(const double* L, detail::View estimate) const {
  const int n = estimate.n, all = rows_ + n;
  const ConstMap root(L, n, n);
  Scratch<640> numbers(all * (n + 1));
  Map work(numbers, all, n + 1);
  work.topLeftCorner(rows_, n).noalias() = R_of(*this).lazyProduct(root);
  work.col(n).head(rows_) = r_of(*this);
  work.bottomRows(n).setIdentity();
  const Triangle triangle(numbers, all, n + 1, n);
  const Square half = triangle.solve_transposed(root);  // (L T⁻¹)ᵀ
  Eigen::Map<Eigen::VectorXd>(estimate.mean, n).noalias() += half.transpose().lazyProduct(work.col(n).head(n));
  Map(estimate.covariance, n, n).noalias() = half.transpose().lazyProduct(half);
  detail::mirror_lower(estimate.covariance, n);
  return -triangle.log_determinant() - 0.5 * work.col(n).tail(rows_).squaredNorm();
}

namespace detail {
namespace {

/// G (P⁻¹ + GᵀG)⁻¹ Gᵀ with P = L Lᵀ.
Square known(const Square& G, const double* L) {
  const auto n = static_cast<int>(G.rows());
  Scratch<640> numbers(2 * n * n);
  Tall work(numbers, 2 * n, n);
  const Square K = G.lazyProduct(ConstMap(L, n, n));
  work << K, Square::Identity(n, n);
  const Square half = Triangle(numbers, 2 * n, n, n).solve_transposed({K.data(), n, n});
  return half.transpose().lazyProduct(half);
}

/// The evidence with the information GᵀZG and the vector Gᵀy, with what was seen.
void finish(Square G, Square Z, Column y, const FutureEvidence& seen, FutureEvidence& result) {
  constexpr double least = 1e-8;
  const auto n = static_cast<int>(G.rows());
  if (seen.rows() > 0) {
    const int all = n + seen.rows();
    Scratch<640> numbers(all * n), of_U(all * n);
    Tall stack(numbers, all, n), U(of_U, all, n);
    stack << G, R_of(seen);
    const Triangle both(numbers, all, n, n);
    both.orthogonal(U);
    G = both.upper();
    // Z and y of both, in the new triangle's directions: Z of G's rows, and one of those of what was seen.
    const auto old = U.topRows(n), added = U.bottomRows(seen.rows());
    const Square product = Z.lazyProduct(old);
    Z.noalias() = old.transpose().lazyProduct(product) + added.transpose().lazyProduct(added);
    y = (old.transpose().lazyProduct(y) + added.transpose().lazyProduct(r_of(seen))).eval();
  }
  result.clear(n);
  Square factor(n, n);
  if (cholesky_factor(Z.data(), n, factor.data()) && factor.diagonal().minCoeff() > std::sqrt(least)) {
    Map numbers = written(result, n);
    numbers.leftCols(n).noalias() = factor.transpose().lazyProduct(G);
    lower_solve(factor.data(), n, y.data());
    numbers.col(n) = y;
    return;
  }
  // Along its axes, within what the triangle can reach: beyond that Z has no meaning.
  Square rest = G * G.colwise().norm().cwiseMax(std::numeric_limits<double>::min()).cwiseInverse().asDiagonal();
  Square basis(n, 0);
  for (Eigen::Index lead = 0; basis.cols() < n;) {
    const double length = rest.colwise().norm().maxCoeff(&lead);
    if (!(length > 1e-12)) break;
    basis.conservativeResize(n, basis.cols() + 1);
    basis.rightCols(1) = rest.col(lead) / length;
    for (int again = 0; again < 2; ++again)  // the second time for the rounding of the first
      for (auto column : rest.colwise()) column -= column.dot(basis.rightCols(1).col(0)) * basis.rightCols(1);
  }
  if (basis.cols() == 0) return;  // nothing was told
  const Square product = Z.lazyProduct(basis), within = basis.transpose().lazyProduct(product);
  const Eigen::SelfAdjointEigenSolver<Square> axes(within);
  const auto kept = static_cast<int>((axes.eigenvalues().array() > least).count());  // they ascend
  const Square along = basis.lazyProduct(axes.eigenvectors().rightCols(kept));
  const Column roots = axes.eigenvalues().tail(kept).cwiseSqrt();
  Map numbers = written(result, kept);
  numbers.leftCols(n).noalias() = along.transpose().lazyProduct(G);
  numbers.leftCols(n).array().colwise() *= roots.array();
  numbers.col(n) = along.transpose().lazyProduct(y).cwiseQuotient(roots);
}

}  // namespace

void collapse(const std::vector<FutureEvidence>& parts, const std::vector<double>& weights, const double* L,
              const FutureEvidence& seen, FutureEvidence& result) {
  const int n = seen.size();
  const auto count = static_cast<int>(parts.size());
  /// act(j, weight, part, its first row) of all that count; returns how many rows they have.
  const auto for_parts = [&](const auto& act) {
    int first = 0;
    for (int j = 0; j < count; ++j) {
      const auto at = static_cast<std::size_t>(j);
      if (!(weights[at] > 0.0)) continue;
      act(j, weights[at], parts[at], first);
      first += parts[at].rows();
    }
    return first;
  };
  const int rows = for_parts([](const auto&...) {}), all = std::max(rows, n);
  Scratch<640> numbers(all * n), of_U(all * n), of_q(n * count);
  Tall stack(numbers, all, n), U(of_U, all, n);
  Map q_of(of_q, n, count);
  stack.setZero();
  for_parts([&](int, double w, const FutureEvidence& part, int first) {
    stack.middleRows(first, part.rows()) = std::sqrt(w) * R_of(part);
  });
  const Triangle triangle(numbers, all, n, n);
  triangle.orthogonal(U);
  const Square G = triangle.upper(), H = known(G, L), one = Square::Identity(n, n);
  const auto empty = U.bottomRows(all - rows);
  const Square reached = one - empty.transpose().lazyProduct(empty);
  Square X = Square::Zero(n, n);
  Column q = Column::Zero(n);
  for_parts([&](int j, double w, const FutureEvidence& part, int first) {
    const auto own = U.middleRows(first, part.rows());
    const Square N = reached - own.transpose().lazyProduct(own) / w;
    const Eigen::PartialPivLU<Square> rest(one - N.lazyProduct(H));
    q_of.col(j) = rest.solve(Column(own.transpose().lazyProduct(r_of(part)) / std::sqrt(w)));
    q += w * q_of.col(j);
    X += w * rest.solve(N);
  });
  for_parts([&](int j, double w, const FutureEvidence&, int) {
    const Column apart = q_of.col(j) - q;
    X += w * apart.lazyProduct(apart.transpose());
  });
  X = (0.5 * (X + X.transpose())).eval();
  const Square Xi = Eigen::PartialPivLU<Square>(one + X.lazyProduct(H)).solve(X);
  const Column moved = H.lazyProduct(q);
  finish(G, one - 0.5 * (Xi + Xi.transpose()), q - Xi.lazyProduct(moved), seen, result);
}

}  // namespace detail
}  // namespace sigmax
