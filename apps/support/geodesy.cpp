#include "support/geodesy.hpp"

#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>

#include "support/angle.hpp"

namespace sigmax::apps {
namespace {

using GeographicLib::AzimuthalEquidistant;
using GeographicLib::LocalCartesian;

LocalCartesian cartesian(const Geodetic& origin) {
  return LocalCartesian(origin.latitude_deg, origin.longitude_deg, origin.altitude_m);
}

/// Unit vectors along an azimuth and to the right of it.
SquareMatrix<2> along_and_right(double azimuth_deg) {
  const double s = std::sin(azimuth_deg * degree), c = std::cos(azimuth_deg * degree);
  return SquareMatrix<2>{{s, c}, {c, -s}};
}

}  // namespace

Geodetic Geodetic::checked(double latitude_deg, double longitude_deg, double altitude_m) {
  if (!(std::abs(latitude_deg) <= 90.0))
    throw std::invalid_argument(fmt::format("latitude {}°, expected −90° to 90°", latitude_deg));
  if (!(std::abs(longitude_deg) <= 360.0))
    throw std::invalid_argument(fmt::format("longitude {}°, expected −360° to 360°", longitude_deg));
  if (!std::isfinite(altitude_m))
    throw std::invalid_argument(fmt::format("altitude {} m, expected a finite number", altitude_m));
  return {latitude_deg, longitude_deg, altitude_m};
}

template <int Axes>
Vector<Axes> LocalFrame<Axes>::to_local(const Geodetic& point) const {
  Vector<Axes> position;
  if constexpr (Axes == 3)
    cartesian(origin_).Forward(point.latitude_deg, point.longitude_deg, point.altitude_m, position(0), position(1),
                               position(2));
  else if constexpr (Axes == 1)
    position(0) = point.altitude_m - origin_.altitude_m;
  else
    AzimuthalEquidistant().Forward(origin_.latitude_deg, origin_.longitude_deg, point.latitude_deg, point.longitude_deg,
                                   position(0), position(1));
  return position;
}

template <int Axes>
Geodetic LocalFrame<Axes>::to_geodetic(const Vector<Axes>& position) const {
  Geodetic point;
  if constexpr (Axes == 3)
    cartesian(origin_).Reverse(position(0), position(1), position(2), point.latitude_deg, point.longitude_deg,
                               point.altitude_m);
  else if constexpr (Axes == 1)
    point = {origin_.latitude_deg, origin_.longitude_deg, origin_.altitude_m + position(0)};
  else
    AzimuthalEquidistant().Reverse(origin_.latitude_deg, origin_.longitude_deg, position(0), position(1),
                                   point.latitude_deg, point.longitude_deg);
  return point;
}

template <int Axes>
SquareMatrix<Axes> LocalFrame<Axes>::local_axes(const Vector<Axes>& position) const {
  double latitude = 0.0, longitude = 0.0;
  if constexpr (Axes == 1) {
    return SquareMatrix<1>::Identity();
  } else if constexpr (Axes == 3) {
    double altitude = 0.0;
    std::vector<double> rows(9);  // from there to here
    cartesian(origin_).Reverse(position(0), position(1), position(2), latitude, longitude, altitude, rows);
    return Eigen::Map<const SquareMatrix<3>>(rows.data());  // by columns: the transpose
  } else {
    if (position.isZero()) return SquareMatrix<2>::Identity();
    double azimuth = 0.0, shrinking = 1.0;
    AzimuthalEquidistant().Reverse(origin_.latitude_deg, origin_.longitude_deg, position(0), position(1), latitude,
                                   longitude, azimuth, shrinking);
    const double azimuth_here = std::atan2(position(0), position(1)) / degree;
    return along_and_right(azimuth) * Vector<2>(1.0, shrinking).asDiagonal() *
           along_and_right(azimuth_here).transpose();
  }
}

template class LocalFrame<1>;
template class LocalFrame<2>;
template class LocalFrame<3>;

}  // namespace sigmax::apps
