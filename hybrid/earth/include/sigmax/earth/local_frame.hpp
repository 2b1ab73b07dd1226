#pragma once

#include <array>
#include <cmath>

namespace sigmax {

/// x, y and z, or east, north and up, in m; 0 along the axes that there are not.
using Position = std::array<double, 3>;

/// A point above the WGS 84 ellipsoid: degrees, and metres along the ellipsoid's normal.
struct Geodetic {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_m = 0.0;

  /// Whether |latitude| ≤ 90°, |longitude| ≤ 360° and the altitude is finite.
  bool is_valid() const {
    return std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 360.0 && std::isfinite(altitude_m);
  }
};

/// East, north and, with three axes, up about an origin. At a pole the origin's longitude says which way is north.
///
/// Three axes are Cartesian. Two axes are a map of the ellipsoid that keeps distances and directions from the origin
/// (azimuthal equidistant), so that no point of the Earth comes out near another.
class LocalFrame {
 public:
  LocalFrame(const Geodetic& origin, int axes) : origin_(origin), axes_(axes) {}

  const Geodetic& origin() const { return origin_; }

  Position to_local(const Geodetic& point) const;

  /// With two axes the altitude is 0.
  Geodetic to_geodetic(const Position& position) const;

  /// What a velocity at this position is to east, north and up there, row by row: a rotation; with two axes it also
  /// undoes the map's stretching. Along the axes that there are not, it leaves everything as it is.
  std::array<Position, 3> local_axes(const Position& position) const;

 private:
  Geodetic origin_;
  int axes_;
};

}  // namespace sigmax
