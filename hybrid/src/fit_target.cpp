#include <sigmax/hybrid/fit_target.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sigmax {

std::vector<double> log_scores(const TargetChoice& choice, std::span<const AnyDetection> detections,
                               const std::function<void(const TargetPoint&)>& visit,
                               const std::function<bool(const AnyDetection&)>& starts) {
  std::vector<double> scores(detections.size(), std::numeric_limits<double>::quiet_NaN());
  AnyTarget target(choice);
  const auto see = [&](const TargetPoint& now) {
    if (!now.is_start && now.log_score) scores[now.tag] = *now.log_score;
    if (visit) visit(now);
  };
  for (const AnyDetection& detection : detections) {
    if (detection.tag >= detections.size())
      throw std::invalid_argument("the tag " + std::to_string(detection.tag) + " among " +
                                  std::to_string(detections.size()) + " detections; expected their numbers from 0 on");
    if (!target.running() && starts && !starts(detection)) continue;
    if (target.starts() > 0 && detection.sensor != AnyDetection::Sensor::none)
      scores[detection.tag] = -std::numeric_limits<double>::infinity();  // unless it is a step
    target.follow({&detection, 1}, see);
  }
  return scores;
}

double robust_log_score(double log_score, double share, double log_stray) {
  const double own = std::log1p(-share) + log_score, stray = std::log(share) + log_stray;
  const double greater = std::max(own, stray);
  return greater + std::log1p(std::exp(std::min(own, stray) - greater));
}

}  // namespace sigmax
