#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <sigmax/core/condition.hpp>
#include <sigmax/core/relation.hpp>
#include <sigmax/estimation/covariance_root.hpp>
#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/grid.hpp>

namespace sigmax {

/// Where one cell of a grid goes: cells in ascending order with the logarithms of weights, up to a common factor.
class GridRow {
 public:
  void add(std::size_t cell, double log_weight) {
    cells_.push_back(cell);
    numbers_.push_back(log_weight);
    greatest_ = std::max(greatest_, log_weight);
  }
  void clear() {
    cells_.clear();
    numbers_.clear();
    greatest_ = -std::numeric_limits<double>::infinity();
  }

  /// Turns the logarithms into parts of the greatest weight and leaves out those below `negligible`.
  void finish(double negligible) {
    const double least = greatest_ + std::log(negligible);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      if (numbers_[k] < least) continue;
      cells_[kept] = cells_[k];
      numbers_[kept++] = std::exp(numbers_[k] - greatest_);
    }
    cells_.resize(kept);
    numbers_.resize(kept);
  }

  std::span<const std::size_t> cells() const { return cells_; }
  std::span<double> numbers() { return numbers_; }

 private:
  std::vector<std::size_t> cells_;
  std::vector<double> numbers_;
  double greatest_ = -std::numeric_limits<double>::infinity();
};

/// The relation from the cells of one grid to the cells of another, stored sparsely. fill(to, i, row) adds where cell i
/// goes. Weights below `negligible` times the greatest of a row are left out. Each row is normalised by its own ⊕: its
/// sum if the state is random, its maximum if it is fuzzy. So the numbers of a density need no common factor, and a row
/// is a distribution whatever was cut off.
template <Uncertainty Kind, int N, class Fill>
Relation<Kind, Kind> grid_transition(const Grid<N>& to, Variable<Kind> to_cell, Variable<Kind> from_cell,
                                     double negligible, const Fill& fill) {
  SparseRows rows(to.size());
  GridRow row;
  for (std::size_t i = 0; i < from_cell.size(); ++i) {
    row.clear();
    fill(to, i, row);
    assert(!row.cells().empty());
    row.finish(negligible);
    condition<AlgebraOf<Kind>>(row.numbers());
    for (std::size_t k = 0; k < row.cells().size(); ++k) rows.append_entry(row.cells()[k], row.numbers()[k]);
    rows.end_row();
  }
  return {std::move(to_cell), std::move(from_cell), std::move(rows)};
}

/// Gaussian noise on a grid: exp(−½ (x−m)ᵀ Q⁻¹ (x−m)) at the cells' centres x.
template <int N>
class GridNoise {
 public:
  /// `negligible` is the part of the greatest value below which the noise ends. Throws std::domain_error if Q is not
  /// positive definite.
  GridNoise(const SquareMatrix<N>& Q, double negligible) {
    SquareMatrix<N> root;
    if (!detail::cholesky_factor(Q.data(), N, root.data()))
      throw std::domain_error("the process covariance of a grid filter is not positive definite");
    inverse_.setIdentity();
    for (int k = 0; k < N; ++k) detail::solve_by_root(root.data(), N, inverse_.data() + k * N);
    reach_ = std::sqrt(-2.0 * std::log(negligible)) * Q.diagonal().cwiseSqrt();
  }

  /// How far along each axis the noise reaches.
  const Vector<N>& reach() const { return reach_; }

  /// The deviation along each axis when the other components are known: cells should not be wider.
  Vector<N> widths() const { return inverse_.diagonal().cwiseSqrt().cwiseInverse(); }

  /// The logarithm of noise w, less that of none.
  double log(const Vector<N>& w) const { return -0.5 * w.dot(inverse_ * w); }

  /// Adds the cells within reach of m. Beside the nearest of them, those further than the noise is wide weigh nothing:
  /// noise narrower than a cell leads to the nearest one.
  void fill(const Grid<N>& grid, const Vector<N>& m, GridRow& row) const {
    using Lattice = typename Grid<N>::Lattice;
    const Lattice last_of_grid = grid.first() + grid.extent() - Lattice::Ones();
    const Lattice first = grid.place_of(m - reach_).cwiseMax(grid.first());
    const Lattice last = grid.place_of(m + reach_).cwiseMin(last_of_grid);
    Grid<N>::for_each_place(first, last,
                            [&](const Lattice& place) { row.add(grid.cell(place), log(grid.centre(place) - m)); });
  }

 private:
  SquareMatrix<N> inverse_;
  Vector<N> reach_;
};

}  // namespace sigmax
