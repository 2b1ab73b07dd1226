#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// A box of equal cells on a lattice in one to three dimensions. Cells are numbered row by row, the last axis fastest.
///
///     const Grid<2> grid{{-100.0, 0.0}, {100.0, 50.0}, {1.0, 0.5}};   // from, to, step
///
/// The lattice goes on outside the box, cell i along an axis reaching from anchor + i·step to anchor + (i + 1)·step:
/// windows of it, and lattices of half or of double the step, have cells that fit into each other exactly.
template <int N>
class Grid {
  static_assert(N >= 1 && N <= 3, "one to three dimensions");

 public:
  using Lattice = Eigen::Matrix<Eigen::Index, N, 1>;

  /// The box from `lower` to `upper`; the last cell may reach further. Throws std::invalid_argument unless the numbers
  /// are finite, `lower` is below `upper` and the steps are positive, or if there were more than 10⁹ cells.
  Grid(const Vector<N>& lower, const Vector<N>& upper, const Vector<N>& step)
      : anchor_(lower), step_(step), first_(Lattice::Zero()) {
    if (!lower.allFinite() || !upper.allFinite() || !step.allFinite() || !((upper - lower).minCoeff() > 0.0) ||
        !(step.minCoeff() > 0.0))
      throw std::invalid_argument("a grid needs a finite lower corner below its upper one, and positive steps");
    const Vector<N> cells = ((upper - lower).array() / step.array()).ceil();
    if (!(cells.prod() <= 1e9))
      throw std::invalid_argument("a grid of " + std::to_string(cells.prod()) + " cells; expected 1e9 at most");
    extent_ = cells.template cast<Eigen::Index>();
  }

  std::size_t size() const { return static_cast<std::size_t>(extent_.prod()); }
  const Lattice& first() const { return first_; }
  const Lattice& extent() const { return extent_; }
  const Vector<N>& step() const { return step_; }

  /// Where a cell of the box lies on the lattice, and the other way.
  Lattice place(std::size_t cell) const {
    assert(cell < size());
    auto rest = static_cast<Eigen::Index>(cell);
    Lattice result;
    for (Eigen::Index axis = N - 1; axis >= 0; --axis) {
      result(axis) = first_(axis) + rest % extent_(axis);
      rest /= extent_(axis);
    }
    return result;
  }
  std::size_t cell(const Lattice& place) const {
    Eigen::Index result = 0;
    for (Eigen::Index axis = 0; axis < N; ++axis) {
      assert(place(axis) >= first_(axis) && place(axis) < first_(axis) + extent_(axis));
      result = result * extent_(axis) + place(axis) - first_(axis);
    }
    return static_cast<std::size_t>(result);
  }

  /// The place of the cell, in the box or not, that has x in it. x is finite and within 10⁹ cells of the anchor.
  Lattice place_of(const Vector<N>& x) const {
    return ((x - anchor_).array() / step_.array()).floor().matrix().template cast<Eigen::Index>();
  }

  Vector<N> centre(const Lattice& place) const {
    return anchor_ + (step_.array() * (place.template cast<double>().array() + 0.5)).matrix();
  }
  Vector<N> centre(std::size_t cell) const { return centre(place(cell)); }

  /// The box of the same lattice from `first` to `last`, both in it.
  Grid window(const Lattice& first, const Lattice& last) const {
    Grid result = *this;
    result.first_ = first;
    result.extent_ = last - first + Lattice::Ones();
    return result;
  }

  /// The same box with every cell cut into two along an axis: cell i becomes 2i and 2i + 1.
  Grid halved(Eigen::Index axis) const {
    Grid result = *this;
    result.step_(axis) /= 2.0;
    result.first_(axis) *= 2;
    result.extent_(axis) *= 2;
    return result;
  }

  /// The cells 2i and 2i + 1 along an axis become i; the box grows at either end if it began or ended between them.
  Grid doubled(Eigen::Index axis) const {
    const Eigen::Index last = half(first_(axis) + extent_(axis) - 1);
    Grid result = *this;
    result.step_(axis) *= 2.0;
    result.first_(axis) = half(first_(axis));
    result.extent_(axis) = last - result.first_(axis) + 1;
    return result;
  }

  /// Index of the cell that contains this one after the step is doubled: ⌊place/2⌋.
  static Eigen::Index half(Eigen::Index place) { return (place - (place < 0 ? 1 : 0)) / 2; }

  /// action(place) for every place from `first` to `last`, in the order of the cells.
  template <class Action>
  static void for_each_place(const Lattice& first, const Lattice& last, const Action& action) {
    if ((last - first).minCoeff() < 0) return;
    for (Lattice place = first;;) {
      action(place);
      Eigen::Index axis = N - 1;
      for (; axis >= 0 && place(axis) == last(axis); --axis) place(axis) = first(axis);
      if (axis < 0) return;
      ++place(axis);
    }
  }

 private:
  Vector<N> anchor_;
  Vector<N> step_;
  Lattice first_;
  Lattice extent_;
};

}  // namespace sigmax
