#pragma once

#include <vector>

#include <sigmax/estimation/dense.hpp>

/// Factorisations that smoothing needs.
namespace sigmax::detail {

/// Turns the first `columns` of a matrix into an upper triangle by reflections of its rows, in place. The greatest
/// entry of each column leads, so that rows of very different size keep their digits (Cox, Higham 1998).
class Triangle {
 public:
  Triangle(double* matrix, int rows, int all_columns, int columns);

  /// The sum of the logarithms of the diagonal's sizes.
  double log_determinant() const;

  /// The first `count` columns of the orthogonal Q with matrix = Q · triangle.
  void orthogonal(double* Q, int count) const;

  /// The triangle, columns × columns, of a matrix with as many rows or more.
  void copy_to(double* triangle) const;

 private:
  struct Reflection {
    int lead;
    double v0, scale;
  };

  void reflect(double* column, int c) const;

  double* matrix_;
  int rows_, columns_;
  Reflection reflections_[64];
};

/// X = M⁻¹ B, in the place of B, n × columns; M is destroyed. By elimination with pivots.
void solve(double* M, int n, double* B, int columns);

/// Eigenvalues and, in columns, eigenvectors of a symmetric matrix, which is destroyed, by Jacobi's rotations.
void eigen(double* M, int n, double* values, double* vectors);

/// An orthonormal basis of the space of the columns of a square matrix, in columns; returns how many. What is left of a
/// column beside `negligible` times the greatest is nothing.
int basis_of(const double* M, int n, double negligible, double* basis);

}  // namespace sigmax::detail
