#pragma once

#include "support/core.hpp"

namespace sigmax::support {

/// The small world of the readings.
inline const FuzzyVariable age{"age", {"young", "middle", "old"}};
inline const FuzzyVariable mood{"mood", {"calm", "wild"}};
inline const RandomVariable speed{"speed", {"slow", "fast"}};
inline const Relation mood_given_age{mood, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};
inline const Relation speed_given_mood{speed, mood, {{0.9, 0.1}, {0.3, 0.7}}};

}  // namespace sigmax::support
