#pragma once

#include <sigmax/estimation/gaussian.hpp>

#include "support/restatement.hpp"

namespace sigmax::support {

/// Any matrix, seen without its type: one instantiation of what follows serves all.
using AnyMatrix = Eigen::Ref<const Eigen::MatrixXd>;

/// The entries of a matrix row by row, for `near`.
inline std::vector<double> entries(const AnyMatrix& matrix) {
  std::vector<double> result;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) result.push_back(matrix(i, j));
  return result;
}

/// The same matrix in the restatement's terms, where laws are written out without Eigen.
inline restatement::Matrix dense(const AnyMatrix& matrix) {
  return {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()), entries(matrix)};
}

/// And back.
template <int Rows, int Columns>
RectangularMatrix<Rows, Columns> fixed(const restatement::Matrix& matrix) {
  RectangularMatrix<Rows, Columns> result;
  for (Eigen::Index i = 0; i < Rows; ++i)
    for (Eigen::Index j = 0; j < Columns; ++j)
      result(i, j) = matrix(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  return result;
}

inline Eigen::MatrixXd matrix_of(const restatement::Matrix& matrix) {
  return Eigen::MatrixXd::NullaryExpr(
      static_cast<Eigen::Index>(matrix.rows), static_cast<Eigen::Index>(matrix.columns),
      [&](Eigen::Index i, Eigen::Index j) { return matrix(static_cast<std::size_t>(i), static_cast<std::size_t>(j)); });
}
inline Eigen::VectorXd vector_of(const restatement::Vector& vector) {
  return Eigen::Map<const Eigen::VectorXd>(vector.data(), static_cast<Eigen::Index>(vector.size()));
}

/// EXPECT_CLOSE(found, expected, tolerance) for matrices: of one shape, and near entry by entry.
inline testing::AssertionResult near(const char* a_text, const char* b_text, const char* tolerance_text,
                                     const AnyMatrix& a, const AnyMatrix& b, double tolerance) {
  if (a.rows() != b.rows() || a.cols() != b.cols())
    return testing::AssertionFailure() << a_text << " and " << b_text << " are not of one shape";
  return near(a_text, b_text, tolerance_text, entries(a), entries(b), tolerance);
}

template <class T>
concept Estimated = requires(const T& estimate) {
  AnyMatrix(estimate.mean);
  AnyMatrix(estimate.covariance);
};

/// EXPECT_CLOSE(found, expected, tolerance) for Gaussians and views of them; to the bit if the tolerance is zero.
template <Estimated A, Estimated B>
testing::AssertionResult near(const char* a_text, const char* b_text, const char* tolerance_text, const A& a,
                              const B& b, double tolerance) {
  const auto mean = near(a_text, b_text, tolerance_text, a.mean, b.mean, tolerance);
  if (!mean) return testing::AssertionResult(mean) << ", of the mean";
  return near(a_text, b_text, tolerance_text, a.covariance, b.covariance, tolerance);
}

/// A restated state, and EXPECT_CLOSE(found, expected, tolerance) for Gaussians beside one.
using Estimate = Gaussian<Eigen::Dynamic, 40>;
inline Estimate estimate_of(const restatement::State& state) {
  return {vector_of(state.mean), matrix_of(state.covariance)};
}
template <Estimated A>
testing::AssertionResult near(const char* a_text, const char* b_text, const char* tolerance_text, const A& a,
                              const restatement::State& b, double tolerance) {
  return near(a_text, b_text, tolerance_text, a, estimate_of(b), tolerance);
}

/// Fails the current case of a property unless the matrices are of one shape and near entry by entry.
inline void require_near(const AnyMatrix& found, const AnyMatrix& expected, double tolerance = 1e-9) {
  if (const auto result = near("found", "expected", "", found, expected, tolerance); !result)
    RC_FAIL(std::string(result.message()));
}
inline void require_near(const AnyMatrix& found, const restatement::Matrix& expected, double tolerance = 1e-9) {
  require_near(found, matrix_of(expected), tolerance);
}

template <int N, int MaxN, int OtherN, int OtherMaxN>
void require_near(const Gaussian<N, MaxN>& found, const Gaussian<OtherN, OtherMaxN>& expected, double tolerance) {
  require_near(found.mean, expected.mean, tolerance);
  require_near(found.covariance, expected.covariance, tolerance);
}

/// A generated number between two, in steps fine enough to be generic.
inline double number_between(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::inRange(0, 1000001)) * 1e-6;
}

/// A generated matrix with entries in [−1, 1].
inline restatement::Matrix generated(std::size_t rows, std::size_t columns) {
  restatement::Matrix result(rows, columns);
  for (double& value : result.values) value = number_between(-1.0, 1.0);
  return result;
}
template <int Rows, int Columns>
RectangularMatrix<Rows, Columns> generated_matrix() {
  return fixed<Rows, Columns>(generated(Rows, Columns));
}

/// A generated covariance with eigenvalues between 0.5 and 0.5 + n².
inline restatement::Matrix generated_covariance(std::size_t n) {
  const auto A = generated(n, n);
  return restatement::symmetrised(A * restatement::transposed(A) + 0.5 * restatement::identity(n));
}

template <int N>
Gaussian<N> generated_gaussian() {
  return {fixed<N, 1>(10.0 * generated(N, 1)), fixed<N, N>(generated_covariance(N))};
}

}  // namespace sigmax::support
