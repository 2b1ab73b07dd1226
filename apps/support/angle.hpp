#pragma once

#include <numbers>

namespace sigmax::apps {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< in rad

}  // namespace sigmax::apps
