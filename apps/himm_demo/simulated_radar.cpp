#include "himm_demo/simulated_radar.hpp"

#include <utility>

#include <fmt/format.h>

#include "himm_demo/experiment/scenario.hpp"
#include "support/angle.hpp"
#include "support/error.hpp"
#include "support/output.hpp"

namespace sigmax::apps {

/// The 64-bit FNV-1a of its name.
RandomStream stream_of(std::uint64_t seed, std::string_view track) {
  if (track.empty()) return {seed, 0};
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char byte : track) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
  return {seed, hash};
}

void see_by_radar(Fix& fix, const std::array<double, 3>& radar, const Vector<3>& radar_at, RandomStream& random,
                  const std::string& file) {
  const auto& [range, azimuth, elevation] = radar;
  const Polar seen = measure(to_polar(*fix.position - radar_at), {range, azimuth * degree, elevation * degree}, random);
  if (!(seen.range > 0.0))
    throw InputError(message({.where = fmt::format("{}:{}", file, fix.line),
                              .what = "the simulated radar",
                              .found = fmt::format("a range of {} m", shortest(seen.range)),
                              .expected = "a positive one",
                              .remedy = "put the radar farther from the track with --radar-at=E,N,U"}));
  fix.truth = std::exchange(fix.position, std::nullopt);
  fix.seen = seen;
}

}  // namespace sigmax::apps
