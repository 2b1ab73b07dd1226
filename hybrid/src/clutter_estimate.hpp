#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/hybrid/any_detection.hpp>

namespace sigmax::detail {

/// How many false detections of one type a scan and unit of what is measured has: those that stay unexplained, over the
/// box of all that was measured, without a few far outliers. It forgets over some fifty scans.
struct ClutterEstimate {
  Eigen::AlignedBoxXd box;
  double scans = 0.0, unexplained = 0.0, outliers = 0.0;
  double log_weight = 0.0;  ///< of a false detection in the scan in hand
  bool seen = false;        ///< in the scan in hand

  /// With half a detection more, so that no clutter has a density, too.
  double density() const { return (unexplained + 0.5) / (std::max(scans, 1.0) * box.volume()); }

  /// The measurement, with three standard deviations, is in the box from now on.
  void add(const AnyDetection& detection) {
    const int n = detection.size;
    const Eigen::Map<const Vector<Eigen::Dynamic, 6>> z(detection.z.data(), n);
    const Eigen::Map<const SquareMatrix<Eigen::Dynamic, 6>> covariance(detection.covariance.data(), n, n);
    if (box.dim() != n) box = Eigen::AlignedBoxXd(n);
    seen = true;
    const bool far = scans > 5.0 && ((z - box.center()).cwiseAbs().array() > 5.0 * box.sizes().array()).any();
    if (far && ++outliers < 5.0) return;
    const auto reach = 3.0 * covariance.diagonal().cwiseSqrt();
    box.extend(z - reach).extend(z + reach);
  }

  void end_scan() {
    constexpr double memory = 0.98;
    scans = memory * (scans + 1.0);
    unexplained *= memory;
    outliers *= memory;
    seen = false;
  }
};

}  // namespace sigmax::detail
