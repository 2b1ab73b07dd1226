#pragma once

#include "recording/recording.hpp"

namespace sigmax::apps {

inline constexpr double metres_a_degree = 60.0 * units::nautical_mile;  // of latitude

/// The standard deviation of the rounding of numbers that come in whole steps; else 0, and infinite where they never
/// change.
double rounding_of(std::vector<double> numbers);

/// Signs that a recording's numbers mean something else than they were taken for, gathered row by row.
class Doubts {
 public:
  Doubts();

  /// A row, and where its measurement was, in m; of a place on the Earth, in this frame.
  void see(const Row& row, const std::optional<Position>& position, const LocalFrame* frame, int axes);

  /// The standard deviation of the rounding of coordinates in m, if they come in whole steps; of several the greatest.
  double rounding(const RecordingReader& recording) const;

  /// By what noise that is another one in each row positions scatter about their way, along an axis in m, where that is
  /// most of how they bend; nothing where they bend by another law, or steps are uneven.
  std::optional<double> scatter() const;

  /// The standard deviation along an axis that rows tell of positions, if hundreds and nine in ten do.
  std::optional<double> told_sigma() const;

  /// How far positions and the ways by velocities that change are apart, in standard deviations that are expected.
  double apart(double sigma_position, double sigma_velocity) const;

  /// Whether bearings come from one place that moves.
  bool from_one_that_moves() const;

  /// So far, in m, lines of sight from sensors on the Earth are off the straight ones of a map of two axes, at most.
  double off_the_map(const RecordingReader& recording) const;

  /// Sentences, each with the name or the option that mends it.
  std::vector<std::string> sentences(const RecordingReader& recording) const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;  // which alone need Eigen; shared, as their type is not whole here
};

}  // namespace sigmax::apps
