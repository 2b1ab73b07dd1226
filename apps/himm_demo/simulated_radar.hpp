#pragma once

#include <array>
#include <string>
#include <string_view>

#include "himm_demo/recording.hpp"
#include "support/random.hpp"

namespace sigmax::apps {

/// A stream of random numbers for each track, whichever others a file holds.
RandomStream stream_of(std::uint64_t seed, std::string_view track);

/// Takes the position for the truth and sees it by a simulated radar with these standard deviations, in m and degrees.
/// Throws InputError with file and line where it comes out behind the radar.
void see_by_radar(Fix& fix, const std::array<double, 3>& radar, const Vector<3>& radar_at, RandomStream& random,
                  const std::string& file);

}  // namespace sigmax::apps
