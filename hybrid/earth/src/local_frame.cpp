#include <sigmax/earth/local_frame.hpp>

#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <numbers>
#include <vector>

namespace sigmax {
namespace {

using GeographicLib::AzimuthalEquidistant;
using GeographicLib::LocalCartesian;

LocalCartesian cartesian(const Geodetic& origin) {
  return LocalCartesian(origin.latitude_deg, origin.longitude_deg, origin.altitude_m);
}

}  // namespace

Position LocalFrame::to_local(const Geodetic& point) const {
  Position p{};
  if (axes_ == 3)
    cartesian(origin_).Forward(point.latitude_deg, point.longitude_deg, point.altitude_m, p[0], p[1], p[2]);
  else
    AzimuthalEquidistant().Forward(origin_.latitude_deg, origin_.longitude_deg, point.latitude_deg, point.longitude_deg,
                                   p[0], p[1]);
  return p;
}

Geodetic LocalFrame::to_geodetic(const Position& p) const {
  Geodetic point;
  if (axes_ == 3)
    cartesian(origin_).Reverse(p[0], p[1], p[2], point.latitude_deg, point.longitude_deg, point.altitude_m);
  else
    AzimuthalEquidistant().Reverse(origin_.latitude_deg, origin_.longitude_deg, p[0], p[1], point.latitude_deg,
                                   point.longitude_deg);
  return point;
}

std::array<Position, 3> LocalFrame::local_axes(const Position& p) const {
  std::array<Position, 3> axes = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  double latitude = 0.0, longitude = 0.0;
  if (axes_ == 3) {
    double altitude = 0.0;
    std::vector<double> back(9);  // from there to here, row by row
    cartesian(origin_).Reverse(p[0], p[1], p[2], latitude, longitude, altitude, back);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) axes[i][j] = back[3 * j + i];
  } else if (p[0] != 0.0 || p[1] != 0.0) {
    constexpr double degree = std::numbers::pi / 180.0;
    const double here = std::atan2(p[0], p[1]) / degree;  // azimuths, in degrees
    double there = 0.0, shrinking = 1.0;
    AzimuthalEquidistant().Reverse(origin_.latitude_deg, origin_.longitude_deg, p[0], p[1], latitude, longitude, there,
                                   shrinking);
    constexpr double near_m = 100.0;  // lengths are right to nanometres, so what is divided by less is not
    if (std::hypot(p[0], p[1]) < near_m) shrinking = 1.0;
    const double s = std::sin(there * degree), c = std::cos(there * degree);
    const double sh = std::sin(here * degree), ch = std::cos(here * degree);
    // Along the azimuth, and to its right, where the map stretches.
    axes[0] = {s * sh + c * shrinking * ch, s * ch - c * shrinking * sh, 0.0};
    axes[1] = {c * sh - s * shrinking * ch, c * ch + s * shrinking * sh, 0.0};
  }
  return axes;
}

}  // namespace sigmax
