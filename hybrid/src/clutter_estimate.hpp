#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <sigmax/hybrid/any_detection.hpp>

namespace sigmax::detail {

/// How many false detections a scan and unit of what is measured has, of each type of detection: those that stay
/// unexplained, over the box of all that was measured. It forgets over some fifty scans.
class ClutterEstimate {
 public:
  struct Type {
    AnyDetection::Sensor sensor;
    int size;
    std::array<double, 6> least{}, greatest{};
    double scans = 0.0, unexplained = 0.0;
    bool seen = false;  ///< in the scan that goes on

    double volume() const {
      double product = 1.0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) product *= greatest[i] - least[i];
      return product;
    }
    /// With half a detection more, so that no clutter has a density, too.
    double density() const { return (unexplained + 0.5) / (std::max(scans, 1.0) * volume()); }
  };

  /// The number of a detection's type; its measurement, with three standard deviations, is in the box from now on.
  std::size_t add(const AnyDetection& detection) {
    const auto same = [&](const Type& type) { return type.sensor == detection.sensor && type.size == detection.size; };
    const auto found = std::ranges::find_if(types_, same);
    const auto number = static_cast<std::size_t>(found - types_.begin());
    if (found == types_.end()) {
      types_.push_back({detection.sensor, detection.size});
      types_.back().least.fill(std::numeric_limits<double>::infinity());
      types_.back().greatest.fill(-std::numeric_limits<double>::infinity());
    }
    Type& type = types_[number];
    type.seen = true;
    for (int i = 0; i < detection.size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double reach = 3.0 * std::sqrt(detection.variance(i));
      type.least[at] = std::min(type.least[at], detection.z[at] - reach);
      type.greatest[at] = std::max(type.greatest[at], detection.z[at] + reach);
    }
    return number;
  }

  void add_unexplained(std::size_t type, double part) { types_[type].unexplained += part; }

  /// Ends a scan; one without detections is a scan of all types.
  void end_scan() {
    const bool empty = std::ranges::none_of(types_, &Type::seen);
    for (Type& type : types_) {
      if (!type.seen && !empty) continue;
      type.scans = memory * (type.scans + 1.0);
      type.seen = false;
      type.unexplained *= memory;
    }
  }

  const std::vector<Type>& types() const { return types_; }

 private:
  static constexpr double memory = 0.98;
  std::vector<Type> types_;
};

}  // namespace sigmax::detail
