#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sigmax/hybrid/any_detection.hpp>
#include <sigmax/hybrid/any_target.hpp>

namespace sigmax {

namespace detail {
struct Tracking;
}

/// The kinds of the two variables that association eliminates, see `match`: their sums and maxima are what the field
/// knows as JPDA, JPDA*, and GNN.
struct AssociationChoice {
  bool fuzzy_pattern = false;      ///< which targets were detected, and which detections are theirs
  bool fuzzy_permutation = false;  ///< which of these detections belongs to which of those targets
};

/// What is assumed of sensor, clutter and targets, and when a track begins and ends.
struct MultiTargetRules {
  double detection_probability = 0.9;  ///< P_D: that a target is detected in a scan
  double gate_probability = 0.9999;    ///< P_G: that a target's own detection passes the gate; 1 is no gate
  /// λ: false detections a scan and unit of what is measured, as m² or m·rad. Without a value it is estimated from the
  /// detections that no confirmed track explains, per volume of all that was measured so far. With
  /// LikelihoodForm::possibility it is the possibility that a detection is false, 1 without a value.
  std::optional<double> clutter_density;
  double survival_per_s = 0.999;  ///< that a target which exists does so a second later
  double birth_existence = 0.02;  ///< of a track that begins: a probability, of a fuzzy pattern a possibility
  double confirmation = 0.95;     ///< a track is confirmed when the necessity of its existence reaches this
  double deletion = 0.005;        ///< a track ends when the probability, or possibility, of its existence falls to this
  double explained = 0.25;        ///< a detection that tracks explain less than this begins a track
  double greatest_speed = 300.0;  ///< m/s: two standard deviations of a new track's velocity
  std::size_t duplicate_scans = 4;   ///< after so many scans in a row the younger of two tracks of one target ends
  std::size_t tentative_scans = 10;  ///< a track that was not confirmed after so many ends if its existence is below ½
  /// Possibilities of a target to be missed and to be detected, the greatest of them 1, for a fuzzy pattern; without a
  /// value 1 − P_D and P_D over the greater. {1, 1} says that P_D is unknown.
  std::optional<std::array<double, 2>> detection_possibilities;
};

/// A target as a track knows it.
struct TrackedTarget {
  std::size_t number;    ///< of the track: 1, 2, … in the order of their first detections, each given once
  TargetPoint point;     ///< with the tag of the detection that has the most weight in it; no innovation
  double existence;      ///< the probability that it exists; of a fuzzy pattern the possibility
  double necessity;      ///< the same probability; of a fuzzy pattern one minus the possibility that it does not
  bool confirmed;        ///< whether it reached the confirmation, and the existence is at least one half now
  double first_time;     ///< s, of the detection that it began with
  std::size_t detected;  ///< in how many scans a detection, rather than none, had the greatest weight
};

/// Whose a detection of the last scan is.
struct DetectionOwner {
  std::size_t tag;                   ///< of the detection
  std::optional<std::size_t> track;  ///< the number of the track that explains it best, or that begins with it
  double support = 0.0;  ///< the marginal probability, or possibility, that it is that track's; 0 of a start
  bool begins = false;   ///< whether that track begins with it
};

/// Tracks of many targets among false detections, chosen at run time in plain data. Which detection is whose is a
/// matching of either kind; each track has a multiple-model filter of any scheme and kind.
///
///     MultiTargetTracker tracker{choice, {.fuzzy_permutation = true}, {.detection_probability = 0.9}};
///     for (const auto& scan : scans) tracker.scan(scan);
///     for (const TrackedTarget& target : tracker.tracks())
///       if (target.confirmed) show(target.number, target.point.mean);
///
/// A detection weighs r P_D Λ/λ for a target, none r (1 − P_D P_G) or, if there is no target, 1 − r; r is the
/// existence, Λ the evidence of the filter's step. Given that the target exists, its posterior is the mixture of its
/// hypotheses by their marginals: of a random pattern moment-matched, mode by mode, of a fuzzy one selected. The
/// existence is a variable of the pattern's kind, see Existence.
///
/// Of the choice, `start` and `rules` are not read. A track begins at the position of a detection, with no velocity
/// and acceleration, whose standard deviations are half the greatest speed and those of `entry`. A detection without a
/// position, as a bearing, begins none, and is compared with every track.
class MultiTargetTracker {
 public:
  /// Throws std::invalid_argument, saying what, if choice or rules make no sense, and for Scheme::histories with a
  /// random pattern: mixtures of histories have no moments that are histories.
  explicit MultiTargetTracker(const TargetChoice& choice, const AssociationChoice& association = {},
                              const MultiTargetRules& rules = {});

  /// Takes what one sensor saw while it looked at every target once, in any order, each at its own time: one turn of a
  /// radar. A target has at most one detection in it. `AnyDetection::missed(time)` tells only that a scan went on until
  /// then. A detection that is earlier than a track is not that track's.
  /// Throws std::invalid_argument for numbers that are not finite, or do not fit their sensor; nothing has changed
  /// then.
  void scan(std::span<const AnyDetection> detections);

  /// The names of what is estimated, as AnyTarget::components.
  const std::vector<std::string>& components() const;

  /// All tracks in the order of their numbers, confirmed or not. Each is at the time of its last detection, or
  /// predicted to a time, in s, where that is later.
  std::vector<TrackedTarget> tracks(std::optional<double> time = {}) const;

  /// Whose each detection of the last scan is, in the order in which they were given, without those that saw nothing.
  const std::vector<DetectionOwner>& owners() const;

  std::size_t scans() const;

  /// The latest time of all detections, in s; −∞ before the first.
  double time() const;

  /// Whether all marginals so far are exact, see `match`: else some are of message passing.
  bool exact() const;

  /// A sentence if rules contradict the data, with its numbers and the rule to set.
  std::optional<std::string> finding() const;

 private:
  std::function<detail::Tracking&()> tracking_;  ///< what it returns is inside it, and copied with it
};

}  // namespace sigmax
