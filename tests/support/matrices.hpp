#pragma once

#include <rapidcheck.h>

#include <Eigen/Core>
#include <vector>

#include <sigmax/estimation/gaussian.hpp>

#include "support/near.hpp"
#include "support/property.hpp"

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

/// EXPECT_PRED_FORMAT3(near_matrix, found, expected, tolerance): of one shape, and near entry by entry.
inline testing::AssertionResult near_matrix(const char* a_text, const char* b_text, const char* tolerance_text,
                                            const AnyMatrix& a, const AnyMatrix& b, double tolerance) {
  if (a.rows() != b.rows() || a.cols() != b.cols())
    return testing::AssertionFailure() << a_text << " and " << b_text << " are not of one shape";
  return near(a_text, b_text, tolerance_text, entries(a), entries(b), tolerance);
}

/// Fails the current case of a property unless the matrices are of one shape and near entry by entry.
inline void require_near_matrix(const AnyMatrix& found, const AnyMatrix& expected, double tolerance = 1e-9) {
  if (const auto result = near_matrix("found", "expected", "", found, expected, tolerance); !result)
    RC_FAIL(std::string(result.message()));
}

/// A generated number between two, in steps fine enough to be generic.
inline double number_between(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::inRange(0, 1000001)) * 1e-6;
}

/// A generated matrix with entries in [−1, 1].
template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> generated_matrix() {
  Eigen::Matrix<double, Rows, Columns> result;
  for (Eigen::Index i = 0; i < Rows; ++i)
    for (Eigen::Index j = 0; j < Columns; ++j) result(i, j) = number_between(-1.0, 1.0);
  return result;
}

/// A generated covariance with eigenvalues between 0.5 and 0.5 + N².
template <int N>
SquareMatrix<N> generated_covariance() {
  const SquareMatrix<N> A = generated_matrix<N, N>();
  SquareMatrix<N> result = A * A.transpose() + 0.5 * SquareMatrix<N>::Identity();
  mirror_lower(result);
  return result;
}

template <int N>
Gaussian<N> generated_gaussian() {
  const Vector<N> mean = 10.0 * generated_matrix<N, 1>();
  return {mean, generated_covariance<N>()};
}

}  // namespace sigmax::support
