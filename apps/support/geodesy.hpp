#pragma once

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax::apps {

/// A point above the WGS 84 ellipsoid: degrees, and metres along the ellipsoid's normal.
struct Geodetic {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;

  /// Throws std::invalid_argument unless |latitude| ≤ 90°, |longitude| ≤ 360° and the altitude is finite.
  static Geodetic checked(double latitude_deg, double longitude_deg, double altitude_m);
};

/// East, north and, with three axes, up about an origin, in m. At a pole the origin's longitude says which way is
/// north.
///
/// Three axes are Cartesian; a single one is the height. Two axes are a map of the ellipsoid that keeps distances and
/// directions from the origin (azimuthal equidistant), so that no point of the Earth comes out near another.
template <int Axes>
class LocalFrame {
 public:
  explicit LocalFrame(const Geodetic& origin) : origin_(origin) {}

  const Geodetic& origin() const { return origin_; }

  Vector<Axes> to_local(const Geodetic& point) const;

  /// With two axes the altitude is 0.
  Geodetic to_geodetic(const Vector<Axes>& position) const;

  /// What a velocity at this position is to east, north and up there: a rotation; with two axes it also undoes the
  /// map's stretching.
  SquareMatrix<Axes> local_axes(const Vector<Axes>& position) const;

 private:
  Geodetic origin_;
};

extern template class LocalFrame<1>;
extern template class LocalFrame<2>;
extern template class LocalFrame<3>;

}  // namespace sigmax::apps
