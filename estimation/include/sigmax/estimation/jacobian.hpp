#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// A column of numbers that carry their derivatives by N variables: what a function must take to be differentiated
/// automatically.
template <int N, int MaxN = N>
using DifferentiableVector = Eigen::Matrix<Eigen::AutoDiffScalar<Vector<N, MaxN>>, N, 1, 0, MaxN, 1>;

/// The Jacobian ∂f/∂x at x by forward automatic differentiation, exact to rounding; `f` takes a DifferentiableVector
/// and returns `Rows` numbers of its scalar type.
template <int Rows, int MaxRows, int N, int MaxN, class Function>
RectangularMatrix<Rows, N, MaxRows, MaxN> jacobian(const Function& f, const Vector<N, MaxN>& x) {
  using Scalar = typename DifferentiableVector<N, MaxN>::Scalar;
  const Eigen::Index n = x.size();
  DifferentiableVector<N, MaxN> variables(n);
  for (Eigen::Index i = 0; i < n; ++i) variables(i) = Scalar(x(i), Vector<N, MaxN>::Unit(n, i));
  const Eigen::Matrix<Scalar, Rows, 1, 0, MaxRows, 1> values = f(variables);
  RectangularMatrix<Rows, N, MaxRows, MaxN> result(values.size(), n);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values(i).derivatives().size() == 0)  // of run-time size: a constant knows of no variables
      result.row(i).setZero();
    else
      result.row(i) = values(i).derivatives().transpose();
  }
  return result;
}

}  // namespace sigmax
