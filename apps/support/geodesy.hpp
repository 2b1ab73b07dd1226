#pragma once

namespace sigmax::apps {

/// A point above the WGS 84 ellipsoid: radians, and metres along the ellipsoid's normal.
struct Geodetic {
  double latitude = 0.0;
  double longitude = 0.0;
  double altitude = 0.0;

  /// Throws std::invalid_argument unless |latitude| ≤ 90°, |longitude| ≤ 360° and the altitude is finite.
  static Geodetic from_degrees(double latitude_deg, double longitude_deg, double altitude_m);

  double latitude_deg() const;
  double longitude_deg() const;
};

/// Metres in the frame that turns with the Earth: x to latitude and longitude zero, z to the north pole.
struct Ecef {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// Metres in the plane that touches the ellipsoid's surface of equal altitude at an origin, and above it.
struct EastNorthUp {
  double east = 0.0;
  double north = 0.0;
  double up = 0.0;
};

Ecef to_ecef(const Geodetic& point);

/// The inverse, good to rounding for altitudes above −5000 km; longitude in (−π, π], and 0 at the poles.
Geodetic to_geodetic(const Ecef& point);

/// East, north and up about an origin; at a pole the origin's longitude says which way is north.
class LocalFrame {
 public:
  explicit LocalFrame(const Geodetic& origin);

  const Geodetic& origin() const { return origin_; }

  EastNorthUp to_local(const Ecef& point) const;
  EastNorthUp to_local(const Geodetic& point) const { return to_local(apps::to_ecef(point)); }
  Ecef to_ecef(const EastNorthUp& point) const;
  Geodetic to_geodetic(const EastNorthUp& point) const { return apps::to_geodetic(to_ecef(point)); }

  /// The point of altitude 0 this far east and north, for distances that are small beside the Earth's radius.
  Geodetic to_surface(double east, double north) const;

 private:
  Geodetic origin_;
  Ecef center_;
  double sin_latitude_;
  double cos_latitude_;
  double sin_longitude_;
  double cos_longitude_;
};

}  // namespace sigmax::apps
