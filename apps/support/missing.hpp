#pragma once

#include <limits>

namespace sigmax::apps {

/// A number that is not known: a gap in a curve, an empty cell.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace sigmax::apps
