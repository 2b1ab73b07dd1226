#pragma once

#include "hybrid/banks.hpp"

/// What targets of these tests are made of, and meet.
namespace sigmax::support {

using Imm = InteractingMultipleModel<Models, Random>;
inline Imm imm(StateAugmentation augmentation = StateAugmentation::borrowed_variance) {
  return {models_of(chosen(false)), transition_of<Random>(chosen(false)), starts(), Interaction<Random>{augmentation}};
}

/// Position as measured, at rest within 200 m/s and 20 m/s².
inline Gaussian<6> one_point_start(const Gaussian<Eigen::Dynamic, 3>& z) {
  Gaussian<6> start{Vector<6>::Zero(), SquareMatrix<6>::Zero()};
  start.mean.head<2>() = z.mean;
  start.covariance.topLeftCorner<2, 2>() = z.covariance;
  start.covariance.diagonal().tail<4>() << 4e4, 4e4, 400.0, 400.0;
  return start;
}

inline Gaussian<2> at(double x, double y, double variance = 100.0) {
  return {Vector<2>(x, y), variance * SquareMatrix<2>::Identity()};
}
inline const Gaussian<2> far_off = at(50e3, 50e3), near_by = at(12000, 7990, 1e4);

/// The manoeuvring target at absolute times, no two alike, each with a tag; one measurement in ten is of something
/// else, and from one on all are, so that the target is lost and starts again.
inline std::vector<Detection> detections(std::size_t count, std::size_t lost_from = 1000) {
  std::vector<Detection> result;
  double time = 0.0;
  for (const Scan& scan : manoeuvring_target(count)) {
    time += std::max(scan.dt, 0.05);
    const std::size_t k = result.size(), tag = 1000 + 3 * k;
    if (!scan.z) {
      result.emplace_back(time, tag);
      continue;
    }
    auto z = *scan.z;
    if (k % 10 == 7) z.mean.array() += 3000.0;
    if (k >= lost_from) z.mean(0) += 20e3;
    result.emplace_back(time, z, tag);
  }
  return result;
}

/// The same shuffled: within groups of so many, but for the first ones.
template <class Turn>
std::vector<Detection> late(const std::vector<Detection>& detections, std::size_t first, std::size_t by,
                            const Turn& turn) {
  std::vector<Detection> order = detections;
  for (std::size_t k = first; k + by < order.size(); k += by) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>(k);
    std::rotate(from, from + static_cast<std::ptrdiff_t>(turn()), from + static_cast<std::ptrdiff_t>(by));
  }
  return order;
}

template <class Filter>
testing::AssertionResult same_filter(const char*, const char*, const Filter& a, const Filter& b) {
  return same_state("", "", "", shown(a), shown(b), 0.0);
}

}  // namespace sigmax::support
