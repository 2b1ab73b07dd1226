#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <sigmax/estimation/trajectory_gospa.hpp>

#include "records/recording.hpp"

namespace sigmax::apps {

/// What makes association hard.
enum class Situation {
  crossing,     ///< two targets cross at 30°
  parallel,     ///< two targets approach, fly 100 m apart for 60 s, and separate
  splitting,    ///< a second target begins where the first one is, and turns away
  manoeuvring,  ///< three targets turn at 6°/s, two of them towards each other
  dense,        ///< twelve targets in 8 km × 8 km, with 60 false detections a scan
  meeting  ///< four targets meet in a point, and one dies there, as in García-Fernández et al. (IEEE TAES 54:1883)
};

inline constexpr std::array<const char*, 6> situation_names = {"crossing",    "parallel", "splitting",
                                                               "manoeuvring", "dense",    "meeting"};

/// How the targets are seen. What is absent is the situation's own.
struct Visibility {
  double detection_probability = 0.9;
  std::optional<double> false_detections{};  ///< the mean number in a scan
  int radars = 0;  ///< that take turns, at the corners of the area, with ranges and azimuths; 0: positions are measured
};

/// A situation as a seed draws it.
struct Scene {
  double false_detections;  ///< the mean number in a scan
  /// Of each scan all detections in no order, then a row without a measurement for each target that was missed. Their
  /// tracks are the targets, "1", "2", …, or empty; their truth is where the target was, x and y in m.
  std::vector<std::vector<Row>> scans{};
  std::vector<Trajectory> truth{};  ///< x and y in m of each target
};

/// Draws a situation: truth and detections depend on the seed alone, and the truth not on the visibility. Throws
/// std::invalid_argument unless the probability of detection is in [0, 1], and numbers are in [0, 500] and [0, 4].
Scene simulate(Situation situation, std::uint64_t seed, const Visibility& visibility = {});

}  // namespace sigmax::apps
