#pragma once

#include <sigmax/estimation/radar.hpp>

#include "himm_demo/filters/settings.hpp"
#include "shell/random.hpp"

namespace sigmax::apps {

inline constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};
inline constexpr std::array<const char*, 3> phase_names = {"before", "during", "after"};  ///< the manoeuvre

/// Samples first … last, counted from one.
struct Phase {
  int first, last;
};

/// A manoeuvring target and how often it is seen, section VI.A.
struct Scenario {
  double step_s;
  Vector<3> position, velocity;
  Vector<3> acceleration;       ///< while it manoeuvres
  int last_accelerated;         ///< the transition k → k + 1 uses it for k from the onset to here
  std::array<Phase, 3> phases;  ///< in the order of their names
  bool noise_on_velocity;       ///< process noise acts on position and velocity, or on position only

  int samples() const { return phases[2].last; }
  int onset() const { return phases[1].first; }
};

/// Accuracies of the radar: as the data are made, and as the filters believe them (Table I, section VI.C).
struct Group {
  Polar data;
  Polar model;
  double sigma_w;  ///< of the filters; the data always have 3 m/s²
};

/// Scenario 1 or 2 of the paper.
Scenario scenario(int number, Preset preset);

/// Group 1 to 4 of the paper, for the radar of the scenario.
Group group(int number, int scenario_number);

/// One target and what the radar saw of it.
struct Recording {
  std::vector<Vector<6>> truth;  ///< position and velocity at every sample
  std::vector<Polar> measured;
};

/// Draws a target with process noise of 3 m/s² and its measurements.
Recording simulate(const Scenario& scenario, const Polar& sigma, RandomStream& random);

}  // namespace sigmax::apps
