#pragma once

#include <utility>

#include <Eigen/Core>

namespace sigmax {

/// A column of N numbers; N may be Eigen::Dynamic with at most MaxN, which never allocates.
template <int N, int MaxN = N>
using Vector = Eigen::Matrix<double, N, 1, 0, MaxN, 1>;

/// A square matrix of size N.
template <int N, int MaxN = N>
using SquareMatrix = Eigen::Matrix<double, N, N, 0, MaxN, MaxN>;

/// A matrix of any shape; Eigen requires RowMajor for a single row.
template <int Rows, int Columns, int MaxRows = Rows, int MaxColumns = Columns>
using RectangularMatrix =
    Eigen::Matrix<double, Rows, Columns, MaxRows == 1 && MaxColumns != 1 ? Eigen::RowMajor : Eigen::ColMajor, MaxRows,
                  MaxColumns>;

/// A Gaussian N(x; mean, covariance): an estimate with its uncertainty, or a measurement with its R.
template <int N, int MaxN = N>
struct Gaussian {
  Vector<N, MaxN> mean;
  SquareMatrix<N, MaxN> covariance;

  Gaussian() = default;
  Gaussian(Vector<N, MaxN> m, SquareMatrix<N, MaxN> c) : mean(std::move(m)), covariance(std::move(c)) {}

  Eigen::Index size() const { return mean.size(); }
};

}  // namespace sigmax
