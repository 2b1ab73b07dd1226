#pragma once

namespace sigmax {

/// Log weights closer than this are equal wherever one of them is to be chosen: a tie.
inline constexpr double tie_tolerance = 1e-9;

}  // namespace sigmax
