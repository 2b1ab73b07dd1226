#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "himm_demo/track_page.hpp"

namespace sigmax::apps {
namespace {

/// A round number of degrees that parts a range into three to seven.
double round_step(double range) {
  constexpr std::array steps = {0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05,
                                0.1,    0.2,    0.5,    1.0,   2.0,   5.0,   10.0, 20.0};
  const auto step = std::find_if(steps.begin(), steps.end(), [&](double one) { return range / one <= 7.0; });
  return step == steps.end() ? 30.0 : *step;
}

std::string degrees_text(double value, const char* positive, const char* negative) {
  return fmt::format("{:.6g}° {}", std::abs(value), value < 0.0 ? negative : positive);
}

}  // namespace

std::vector<GraticuleLine> graticule(const Geodetic& anchor, double west, double east, double south, double north) {
  constexpr int points = 24;
  const LocalFrame<2> frame(anchor);
  double least_latitude = 90.0, greatest_latitude = -90.0, least_longitude = 540.0, greatest_longitude = -540.0;
  for (int i = 0; i <= points; ++i)
    for (const auto& [x, y] : {std::pair{west + (east - west) * i / points, south},
                               {west + (east - west) * i / points, north},
                               {west, south + (north - south) * i / points},
                               {east, south + (north - south) * i / points}}) {
      const Geodetic place = frame.to_geodetic(Vector<2>(x, y));
      // The meridian of 180° is no border here.
      const double longitude = anchor.longitude_deg + std::remainder(place.longitude_deg - anchor.longitude_deg, 360.0);
      least_latitude = std::min(least_latitude, place.latitude_deg);
      greatest_latitude = std::max(greatest_latitude, place.latitude_deg);
      least_longitude = std::min(least_longitude, longitude);
      greatest_longitude = std::max(greatest_longitude, longitude);
    }
  std::vector<GraticuleLine> lines;
  const auto add = [&](std::string label, const auto& place_at) {
    GraticuleLine line{std::move(label), {}, {}};
    for (int i = 0; i <= points; ++i) {
      const Vector<2> at = frame.to_local(place_at(static_cast<double>(i) / points));
      line.x.push_back(at.x());
      line.y.push_back(at.y());
    }
    lines.push_back(std::move(line));
  };
  const double tall = greatest_latitude - least_latitude, wide = greatest_longitude - least_longitude;
  for (const double step = round_step(tall), first = std::ceil(least_latitude / step) * step;
       const int i : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const double latitude = first + i * step;
    if (latitude <= greatest_latitude)
      add(degrees_text(latitude, "N", "S"), [&](double part) {
        return Geodetic{latitude, least_longitude + part * wide, 0.0};
      });
  }
  for (const double step = round_step(wide), first = std::ceil(least_longitude / step) * step;
       const int i : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const double longitude = first + i * step;
    if (longitude <= greatest_longitude)
      add(degrees_text(std::remainder(longitude, 360.0), "E", "W"), [&](double part) {
        return Geodetic{least_latitude + part * tall, longitude, 0.0};
      });
  }
  return lines;
}

}  // namespace sigmax::apps
