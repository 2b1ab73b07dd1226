#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sigmax/core/choices.hpp>
#include <sigmax/hybrid/multi_target_tracker.hpp>

#include "chosen.hpp"
#include "clutter_estimate.hpp"
#include "sorted_boxes.hpp"

namespace sigmax::detail {

/// What a tracker of any kinds has: what is assumed, the scan in hand, and what was counted.
class Tracking {
 public:
  Tracking(const TargetChoice& choice, const MultiTargetRules& rules);
  Tracking(const Tracking&) = default;
  Tracking& operator=(const Tracking&) = delete;
  virtual ~Tracking() = default;
  virtual std::unique_ptr<Tracking> clone() const = 0;

  void scan(std::span<const AnyDetection> detections);
  virtual std::vector<TrackedTarget> tracks(std::optional<double> time) const = 0;
  virtual const std::vector<std::string>& components() const = 0;
  const std::vector<DetectionOwner>& owners() const { return owners_; }
  std::size_t scans() const { return scans_; }
  double time() const { return time_; }
  bool exact() const { return exact_; }
  std::optional<std::string> finding() const;

 protected:
  /// A detection of the scan in hand.
  struct Spot {
    Detection detection;
    std::size_t given;  ///< its place in the scan
    DetectionOwner owner;
    std::size_t type = 0;  ///< of the clutter
    bool placed = false;   ///< whether it tells the whole position
    double limit = 0.0;    ///< of its gate
    double log_clutter = 0.0;
    double explained = 0.0, explained_by_confirmed = 0.0;
    std::size_t first_taker = no_column;  ///< the oldest track whose best one it is

    Seen seen() const { return {detection.measurement(), sensor_of_models(detection.sensor())}; }
  };

  virtual void take_scan() = 0;

  TargetChoice choice_;
  MultiTargetRules rules_;
  std::vector<AnyModel> models_;
  Gate gate_;
  std::vector<Spot> spots_;  ///< in the order of their times
  std::vector<Spot> read_;   ///< of a scan that may be refused; else memory for the next one
  double greatest_limit_ = 0.0;
  SortedBoxes boxes_;
  ClutterEstimate clutter_;
  std::vector<DetectionOwner> owners_;
  double time_ = -std::numeric_limits<double>::infinity();
  double elapsed_ = 0.0;  ///< from the scan before
  std::size_t scans_ = 0;
  std::size_t detections_ = 0;
  bool exact_ = true;
  bool confirmed_any_ = false;
  double looks_ = 0.0, detected_ = 0.0;  ///< at confirmed targets, up to the last detection of each
};

std::unique_ptr<Tracking> chosen_tracking(const TargetChoice& choice, const AssociationChoice& kinds,
                                          const MultiTargetRules& rules);

}  // namespace sigmax::detail
