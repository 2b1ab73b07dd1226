#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <sigmax/core/relation.hpp>

#include "recognition_demo/contest.hpp"
#include "support/random.hpp"

namespace sigmax::apps {

/// The authors' example of kinematic recognition on one axis. The target flies at −150 m/s from 10 km and accelerates
/// during the steps that lead to samples 15 … 20, by its class's acceleration. SI units.
struct ManoeuvreScenario {
  static constexpr double step_s = 2.0;
  static constexpr std::size_t samples = 30;
  static constexpr std::size_t first_accelerated = 15, last_accelerated = 20;
  static constexpr double start_m = 10000.0, speed = -150.0;
  static constexpr double sigma_position = 50.0;
  static constexpr std::size_t first_classified = 10;  ///< the sample from which mode weights are reports

  /// The filter: constant velocity, and known inputs of ±3 g and ±5 g, all with this process noise.
  static constexpr double sigma_w = 5.0;
  static constexpr double gravity = 9.80665;
  static constexpr double stay = 0.9;  ///< p(mode|same mode); the possibilities are in proportion

  RandomVariable mode{"mode", {"cv", "+3g", "-3g", "+5g", "-5g"}};
  std::array<double, 5> inputs{0.0, 3.0 * gravity, -3.0 * gravity, 5.0 * gravity, -5.0 * gravity};
  RandomVariable manoeuvre{"manoeuvre", {"weak", "medium", "strong"}};
  std::array<std::size_t, 5> manoeuvre_of_mode{0, 1, 1, 2, 2};
  RandomVariable target{"target", {"airliner", "bomber", "fighter"}};
  std::array<double, 3> acceleration{-5.0, -25.0, -45.0};  ///< by target

  /// p(target|manoeuvre) and π(target|manoeuvre), as the authors give them.
  Relation<Random, Random> target_given_manoeuvre_p() const {
    return {target, manoeuvre, {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.0, 0.5, 0.5}, {0.0, 0.0, 1.0}}};
  }
  Relation<Fuzzy, Fuzzy> target_given_manoeuvre_pi() const;
};

/// A run: measured positions, and after each sample the logarithms of the weights of both filters' modes; none before
/// the filters start, from samples 1 and 2.
struct ManoeuvreRun {
  std::vector<double> positions;
  std::vector<std::vector<double>> imm;
  std::vector<std::vector<double>> himm;
};

ManoeuvreRun fly(const ManoeuvreScenario& scenario, double acceleration, RandomStream& random);

/// Logarithms of the weights of the manoeuvres, by the ⊕ of the mode's kind, from sample `first_classified` on.
std::vector<GradedReport> reports_by_sum(const ManoeuvreScenario& scenario, const ManoeuvreRun& run);
std::vector<GradedReport> reports_by_max(const ManoeuvreScenario& scenario, const ManoeuvreRun& run);

}  // namespace sigmax::apps
