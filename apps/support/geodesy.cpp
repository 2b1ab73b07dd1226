#include "support/geodesy.hpp"
#include "support/angle.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/core.h>

namespace sigmax::apps {
namespace {

// WGS 84, NGA.STND.0036: semi-major axis and flattening; all else follows.
constexpr double a = 6378137.0;
constexpr double f = 1.0 / 298.257223563;
constexpr double b = a * (1.0 - f);
constexpr double e2 = f * (2.0 - f);
constexpr double e2_second = e2 / (1.0 - e2);

}  // namespace

Geodetic Geodetic::from_degrees(double latitude_deg, double longitude_deg, double altitude_m) {
  if (!(std::abs(latitude_deg) <= 90.0))
    throw std::invalid_argument(fmt::format("latitude {}°, expected −90° to 90°", latitude_deg));
  if (!(std::abs(longitude_deg) <= 360.0))
    throw std::invalid_argument(fmt::format("longitude {}°, expected −360° to 360°", longitude_deg));
  if (!std::isfinite(altitude_m))
    throw std::invalid_argument(fmt::format("altitude {} m, expected a finite number", altitude_m));
  return {latitude_deg * degree, longitude_deg * degree, altitude_m};
}

double Geodetic::latitude_deg() const { return latitude / degree; }

double Geodetic::longitude_deg() const { return longitude / degree; }

Ecef to_ecef(const Geodetic& point) {
  const double sin_latitude = std::sin(point.latitude);
  const double cos_latitude = std::cos(point.latitude);
  const double normal = a / std::sqrt(1.0 - e2 * sin_latitude * sin_latitude);
  const double from_axis = (normal + point.altitude) * cos_latitude;
  return {from_axis * std::cos(point.longitude), from_axis * std::sin(point.longitude),
          (normal * (1.0 - e2) + point.altitude) * sin_latitude};
}

Geodetic to_geodetic(const Ecef& point) {
  const double from_axis = std::hypot(point.x, point.y);
  // Bowring's iteration on the reduced latitude β, kept as a direction so that the poles need no case of their own:
  // tan φ = (z + e'² b sin³β) / (p − e² a cos³β), tan β = (1 − f) tan φ. One step is enough near the surface.
  double sin_reduced = a * point.z;
  double cos_reduced = b * from_axis;
  double across = 0.0;
  double along = 0.0;
  for (int step = 0; step < 6; ++step) {
    const double length = std::hypot(sin_reduced, cos_reduced);
    const double s = sin_reduced / length;
    const double c = cos_reduced / length;
    across = point.z + e2_second * b * s * s * s;
    along = from_axis - e2 * a * c * c * c;
    sin_reduced = (1.0 - f) * across;
    cos_reduced = along;
  }
  const double length = std::hypot(across, along);
  const double sin_latitude = across / length;
  const double cos_latitude = along / length;
  // p cos φ + z sin φ = a √(1 − e² sin²φ) + h, which divides by nothing.
  const double altitude =
      from_axis * cos_latitude + point.z * sin_latitude - a * std::sqrt(1.0 - e2 * sin_latitude * sin_latitude);
  return {std::atan2(across, along), from_axis > 0.0 ? std::atan2(point.y, point.x) : 0.0, altitude};
}

LocalFrame::LocalFrame(const Geodetic& origin)
    : origin_(origin),
      center_(apps::to_ecef(origin)),
      sin_latitude_(std::sin(origin.latitude)),
      cos_latitude_(std::cos(origin.latitude)),
      sin_longitude_(std::sin(origin.longitude)),
      cos_longitude_(std::cos(origin.longitude)) {}

EastNorthUp LocalFrame::to_local(const Ecef& point) const {
  const double x = point.x - center_.x;
  const double y = point.y - center_.y;
  const double z = point.z - center_.z;
  const double outward = cos_longitude_ * x + sin_longitude_ * y;
  return {cos_longitude_ * y - sin_longitude_ * x, cos_latitude_ * z - sin_latitude_ * outward,
          cos_latitude_ * outward + sin_latitude_ * z};
}

Geodetic LocalFrame::to_surface(double east, double north) const {
  // Each step leaves of the altitude the part 1 − cos of the angle between the two points' normals.
  EastNorthUp point{east, north, -origin_.altitude};
  Geodetic surface = to_geodetic(point);
  for (int step = 0; step < 50 && std::abs(surface.altitude) > 1e-9; ++step) {
    point.up -= surface.altitude;
    surface = to_geodetic(point);
  }
  return {surface.latitude, surface.longitude, 0.0};
}

Ecef LocalFrame::to_ecef(const EastNorthUp& point) const {
  const double outward = cos_latitude_ * point.up - sin_latitude_ * point.north;
  return {center_.x + cos_longitude_ * outward - sin_longitude_ * point.east,
          center_.y + sin_longitude_ * outward + cos_longitude_ * point.east,
          center_.z + cos_latitude_ * point.north + sin_latitude_ * point.up};
}

}  // namespace sigmax::apps
