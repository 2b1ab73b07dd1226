#pragma once

#include "support/sigmax.hpp"

namespace sigmax::support {

/// A search as plain as can be: along each number by its step, which is halved where nothing is gained.
inline void compass(const std::function<double(const std::vector<double>&)>& function, const FitSearch& search,
                    double least_step = 0.02) {
  std::vector<double> at = search.start, step = search.step;
  double best = function(at);
  for (double greatest = 1.0; greatest > least_step;) {
    bool gained = false;
    for (std::size_t i = 0; i < at.size(); ++i)
      for (const double direction : {1.0, -1.0}) {
        std::vector<double> tried = at;
        tried[i] = std::clamp(tried[i] + direction * step[i], search.lower[i], search.upper[i]);
        const double found = function(tried);
        if (!(found < best)) continue;
        best = found;
        at = tried;
        gained = true;
        break;
      }
    if (gained) continue;
    for (double& each : step) each *= 0.5;
    greatest = *std::max_element(step.begin(), step.end());
  }
}
inline const auto by_compass = [](const auto& function, const FitSearch& search) { compass(function, search); };

/// A target that is calm or turns, in its own two modes.
inline TargetChoice two_speeds(bool fuzzy) {
  TargetChoice choice;
  choice.axes = 2;
  choice.fuzzy = fuzzy;
  choice.motions = {{"dwna"}, {"dwna"}};
  choice.models = {"calm", "turn"};
  choice.motions[0][MotionParameter::sigma_w] = 1.0;
  choice.motions[1][MotionParameter::sigma_w] = 12.0;
  choice.transition = fuzzy ? std::vector<std::vector<double>>{{1.0, 0.2}, {0.2, 1.0}}
                            : std::vector<std::vector<double>>{{0.95, 0.05}, {0.10, 0.90}};
  return choice;
}

/// A target that moves as `two_speeds` says, seen every second with these standard deviations, and its modes.
struct Simulated {
  std::vector<AnyDetection> detections;
  std::vector<std::size_t> modes;
};
inline Simulated simulate(const TargetChoice& choice, double sigma, std::size_t rows, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Simulated result;
  std::size_t mode = 0;
  std::array<double, 2> x{}, v{100.0, 50.0};
  for (std::size_t k = 0; k < rows; ++k) {
    if (uniform(generator) > choice.transition[mode][mode]) mode = 1 - mode;
    AnyDetection detection{
        .time = static_cast<double>(k), .tag = k, .sensor = AnyDetection::Sensor::position, .size = 2};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double w = choice.motions[mode][MotionParameter::sigma_w] * normal(generator);
      x[axis] += v[axis] + 0.5 * w;
      v[axis] += w;
      detection.z[axis] = x[axis] + sigma * normal(generator);
    }
    result.detections.push_back(detection);
    result.modes.push_back(mode);
  }
  return result;
}
inline void believe(std::vector<AnyDetection>& detections, double sigma) {
  for (AnyDetection& detection : detections) detection.covariance = {sigma * sigma, 0.0, 0.0, sigma * sigma};
}

}  // namespace sigmax::support
