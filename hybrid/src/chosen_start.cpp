#include "chosen_start.hpp"

#include <numbers>

#include <sigmax/estimation/start.hpp>

namespace sigmax::detail {
namespace {

using Estimates = ChosenStart::Estimates;
using Plots = ChosenStart::Plots;
using Leading = Gaussian<Eigen::Dynamic, 9>;  // the position and its derivatives

/// `leading(n)` is the estimate of the n leading components; a rate of turn, which no start tells, has no correlation
/// with the rest.
template <class LeadingStart>
Estimates estimates(const TargetChoice& choice, const LeadingStart& leading) {
  const double sigma_turn = choice.start_sigma_turn_deg_s * std::numbers::pi / 180.0;
  Estimates result;
  for (const auto& motion : choice.motions) {
    const Eigen::Index n = motion.known().derivatives * choice.axes;
    const Eigen::Index all = motion.known().linear ? n : n + 1;
    const Leading start = leading(n);
    auto& estimate = result.emplace_back();
    estimate.mean.setZero(all);
    estimate.mean.head(n) = start.mean;
    estimate.covariance.setZero(all, all);
    estimate.covariance.topLeftCorner(n, n) = start.covariance;
    if (all > n) estimate.covariance(n, n) = sigma_turn * sigma_turn;
  }
  return result;
}

/// From the last three positions at different times.
template <int Axes>
std::optional<StartAt<Estimates>> from_points(const TargetChoice& choice, Plots plots) {
  std::vector<TimedMeasurement<Axes>> points;
  for (const auto& plot : plots) {
    const auto position = detail::position_told<Axes>(plot);
    if (!position) continue;
    if (!points.empty() && points.back().time == plot.time)
      points.back().measurement = *position;
    else
      points.push_back({plot.time, *position});
  }
  if (points.size() < 3) return std::nullopt;
  const auto &first = points[points.size() - 3], &second = points[points.size() - 2], &third = points.back();
  const bool released = choice.start == StartRule::released;
  const auto wide =
      released ? released_start<Axes>(first, second, third) : three_point_start<Axes>(first, second, third);
  const auto narrow = two_point_start<Axes>(second, third);
  const auto leading = [&](Eigen::Index n) -> Leading {
    if (n == 3 * Axes || released) return {wide.mean.head(n), wide.covariance.topLeftCorner(n, n)};
    return {narrow.mean.head(n), narrow.covariance.topLeftCorner(n, n)};
  };
  return StartAt<Estimates>{third.time, estimates(choice, leading)};
}

/// A given start without a time waits for the second plot: it is one step before the first.
std::optional<StartAt<Estimates>> given(const TargetChoice& choice, Plots plots) {
  if (!choice.start_time_s && plots.size() < 2) return std::nullopt;
  const double time = choice.start_time_s ? *choice.start_time_s : 2.0 * plots[0].time - plots[1].time;
  const auto leading = [&](Eigen::Index n) {
    Leading start{Vector<Eigen::Dynamic, 9>(n), SquareMatrix<Eigen::Dynamic, 9>::Zero(n, n)};
    for (Eigen::Index k = 0; k < n; ++k) {  // what is given always speaks of three axes
      const auto place = static_cast<std::size_t>(k / choice.axes * 3 + k % choice.axes);
      start.mean(k) = choice.start_mean[place];
      start.covariance(k, k) = choice.start_covariance_diagonal[place];
    }
    return start;
  };
  return StartAt<Estimates>{time, estimates(choice, leading), false};
}

}  // namespace

std::optional<StartAt<Estimates>> ChosenStart::operator()(Plots plots, std::size_t starts) const {
  if (choice_.start == StartRule::given && starts == 0) return given(choice_, plots);
  if (choice_.axes == 1) return from_points<1>(choice_, plots);
  return choice_.axes == 2 ? from_points<2>(choice_, plots) : from_points<3>(choice_, plots);
}

Estimates ChosenStart::nowhere() const {
  return estimates(choice_, [](Eigen::Index n) {
    return Leading{Vector<Eigen::Dynamic, 9>::Zero(n), SquareMatrix<Eigen::Dynamic, 9>::Identity(n, n)};
  });
}

}  // namespace sigmax::detail
