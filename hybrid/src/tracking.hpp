#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/choices.hpp>
#include <sigmax/hybrid/multi_target_tracker.hpp>

#include "chosen.hpp"
#include "clutter_estimate.hpp"

namespace sigmax::detail {

/// A detection of the scan in hand.
struct Spot {
  Detection detection;
  std::size_t given;  ///< its place among those that saw something
  DetectionOwner owner;
  std::optional<Gaussian<Eigen::Dynamic, 3>> position = {};  ///< if it tells the whole position
  ClutterEstimate* clutter = nullptr;
  double explained = 0.0, explained_by_confirmed = 0.0;
  std::size_t first_taker = no_column;  ///< the oldest track whose best one it is
};

/// What a tracker of any kinds has: what is assumed, the scan in hand, and what was counted.
struct Tracking {
  using Box = Eigen::AlignedBox3d;

  Tracking(const TargetChoice& choice, const MultiTargetRules& rules);

  void scan(std::span<const AnyDetection> detections);
  virtual void take_scan(double elapsed) = 0;
  virtual std::vector<TrackedTarget> tracks(std::optional<double> at) const = 0;
  virtual const std::vector<std::string>& components() const = 0;

  /// Writes the numbers of the spots that a target may have which is somewhere in the box, ascending.
  void overlapping(const Box& box, std::vector<std::size_t>& found) const;

  std::optional<std::string> finding() const;

  TargetChoice choice;
  MultiTargetRules rules;
  Gate gate;
  std::vector<Spot> spots;                         ///< in the order of their times
  std::vector<std::pair<Box, std::size_t>> boxes;  ///< where their targets may be; sorted along x
  double longest = 0.0;                            ///< of the boxes, along x
  double greatest_limit = 0.0;                     ///< of the gates
  std::map<std::pair<AnyDetection::Sensor, int>, ClutterEstimate> clutter;  ///< of sensors and sizes
  std::vector<DetectionOwner> owners;
  double time = -std::numeric_limits<double>::infinity();
  std::size_t scans = 0, detections = 0;
  bool exact = true;
  double looks = 0.0, detected = 0.0;  ///< at confirmed targets, up to the last detection of each

 protected:
  ~Tracking() = default;
};

/// The tracker of a choice, with its tracks, `held`.
std::function<Tracking&()> chosen_tracking(const TargetChoice& choice, const AssociationChoice& kinds,
                                           const MultiTargetRules& rules);

}  // namespace sigmax::detail
