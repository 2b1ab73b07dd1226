#include <cstdio>

#include <sigmax/earth/earth_target.hpp>

int main() {
  sigmax::EarthTarget target{{.motions = {{"cwna"}}, .models = {"cwna"}, .transition = {{1.0}}}};
  std::vector<sigmax::AnyDetection> detections;
  for (int k = 0; k < 6; ++k)  // latitude and longitude in degrees, altitude in m; variances in m²
    detections.push_back(sigmax::AnyDetection::position(
        10.0 * k, std::array{52.0 + 0.02 * k, 4.5 + 0.03 * k, 1e3 + 50.0 * k}, std::array{100.0, 100.0, 400.0}));
  detections.push_back(sigmax::AnyDetection::components(60.0, std::array{2}, std::array{1290.0}, std::array{25.0}));
  target.follow(detections, [](const sigmax::EarthPoint& point) {
    std::printf("%2.0f s: %.4f° north, %.4f° east, %4.0f m, %.1f m/s east\n", point.time, point.place.latitude_deg,
                point.place.longitude_deg, point.place.altitude_m, point.mean[3]);
  });
}
