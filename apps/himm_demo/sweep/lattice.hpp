#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace sigmax::apps {

/// A list of numbers in ascending order, continued at both ends.
struct Axis {
  std::vector<double> numbers;
  std::size_t first = 0;    ///< of the list itself
  std::size_t last = 0;     ///< of the list itself
  bool more_below = false;  ///< whether smaller numbers were left out
  bool more_above = false;
};

/// What an axis is made of.
struct AxisRange {
  std::vector<double> list;  ///< ascending; one number is fixed and has no continuation
  double least, greatest;    ///< of the continuation
};

/// Beyond each end by the ratio of the last two numbers, as many steps, in six digits.
Axis continued(const AxisRange& range, int steps);

/// The settings of one filter that may be tried: four numbers and a lift.
class SweepLattice {
 public:
  static constexpr std::size_t axes = 4;
  /// Where a setting is on each axis, and which lift it has.
  using Place = std::array<std::size_t, axes + 1>;

  SweepLattice(const std::array<AxisRange, axes>& ranges, std::size_t lifts, int beyond);

  double number(std::size_t axis, const Place& place) const { return axes_[axis].numbers[place[axis]]; }

  /// Every combination of the lists. The lift changes fastest.
  std::vector<Place> grid() const;

  /// The places one step along one axis, and those of another lift.
  std::vector<Place> neighbours(const Place& place) const;

  /// Whether a number is the last one before those left out, so that better ones may be beyond.
  bool at_the_limit(const Place& place) const;

 private:
  std::array<Axis, axes> axes_;
  std::size_t lifts_;
};

/// The best place that was found, and how many were tried.
struct BestPlace {
  SweepLattice::Place place;
  double score;
  std::size_t tried;
};

/// Gives the scores of places, of which the least is the best.
using ScoresOf = std::function<std::vector<double>(const std::vector<SweepLattice::Place>&)>;

/// The best of the grid, then from neighbour to better neighbour until none is better. The first of equals is taken.
BestPlace search(const SweepLattice& lattice, const ScoresOf& scores_of);

}  // namespace sigmax::apps
