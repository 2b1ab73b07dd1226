#include <sigmax/hybrid/fit_target.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sigmax {

std::vector<double> log_scores(const TargetChoice& choice, std::span<const AnyPlot> plots,
                               const std::function<void(const TargetPoint&)>& visit,
                               const std::function<bool(const AnyPlot&)>& starts) {
  std::vector<double> scores(plots.size(), std::numeric_limits<double>::quiet_NaN());
  AnyTarget target(choice);
  const auto see = [&](const TargetPoint& now) {
    if (!now.is_start && now.log_score) scores[now.tag] = *now.log_score;
    if (visit) visit(now);
  };
  for (const AnyPlot& plot : plots) {
    if (plot.tag >= plots.size())
      throw std::invalid_argument("the tag " + std::to_string(plot.tag) + " among " + std::to_string(plots.size()) +
                                  " plots; expected their numbers from 0 on");
    if (!target.running() && starts && !starts(plot)) continue;
    if (target.starts() > 0 && plot.sensor != AnyPlot::Sensor::none)
      scores[plot.tag] = -std::numeric_limits<double>::infinity();  // unless it is a step
    target.follow({&plot, 1}, see);
  }
  return scores;
}

double robust_log_score(double log_score, double share, double log_stray) {
  const double own = std::log1p(-share) + log_score, stray = std::log(share) + log_stray;
  const double greater = std::max(own, stray);
  return greater + std::log1p(std::exp(std::min(own, stray) - greater));
}

}  // namespace sigmax
