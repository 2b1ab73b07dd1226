#pragma once

#include <optional>

#include <sigmax/earth/local_frame.hpp>
#include <sigmax/hybrid/any_detection.hpp>

namespace sigmax {

// A detection on the Earth is an AnyDetection whose position is latitude and longitude in degrees and, with three axes,
// the altitude in m, whose velocity is along east, north and up of that place, and whose origin is such a place, too.
// Its angles are from the east and the horizon of the origin. Covariances of positions are in m².

/// The place that its components tell, at this altitude in space if they tell none; nothing without a latitude and a
/// longitude.
std::optional<Geodetic> place_of(const AnyDetection& detection, int axes, double altitude_m = 0.0);

/// Its components in a frame, where its position is `at`.
AnyDetection in_frame(AnyDetection detection, const LocalFrame& frame, const Position& at, int axes);

/// What a radar or a station of bearings at this place measured, in a frame. It does not use the origin that it has.
AnyDetection seen_from(const Geodetic& sensor, AnyDetection detection, const LocalFrame& frame, int axes);

}  // namespace sigmax
