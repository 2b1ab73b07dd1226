#pragma once

#include <cstddef>
#include <limits>

namespace sigmax {

/// What to do with measurements that are late, missing or not of the target.
struct TargetRules {
  double gate_probability = 0.9999;  ///< of the target's own measurement to pass the gate; 1 is no gate
  std::size_t rejections = 3;        ///< so many in a row, and the target starts again from them; 0 is never
  double longest_gap = std::numeric_limits<double>::infinity();  ///< s; if none was accepted for longer, the next
                                                                 ///< starts the target again
  std::size_t buffer = 0;    ///< steps that are kept: a measurement that belongs among them may come late
  std::size_t waiting = 16;  ///< detections that are kept for a start that wants several
  bool record = false;       ///< whether all steps are kept, for `smoothed`
};

/// What became of a detection.
enum class Verdict {
  accepted,
  rejected,
  missed,
  waiting,   ///< kept for a start that wants more
  started,   ///< the target starts with it
  restarted  ///< the same, after another start
};

}  // namespace sigmax
