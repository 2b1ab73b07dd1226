#pragma once

#include <limits>
#include <numbers>

namespace sigmax::apps {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< in rad

/// A number that is not known: a gap in a curve, an empty cell.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace sigmax::apps
