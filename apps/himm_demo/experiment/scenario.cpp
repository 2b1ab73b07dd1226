#include "himm_demo/experiment/tally.hpp"

namespace sigmax::apps {

Scenario scenario(int number, Preset preset) {
  const bool released = preset == Preset::released;
  Scenario result;
  result.velocity = Vector<3>(-100.0, -100.0, 0.0);
  result.acceleration = Vector<3>(-30.0, -50.0, 0.0);
  result.noise_on_velocity = !released;
  if (number == 1) {
    result.step_s = 0.2;
    result.position = Vector<3>(12e3, 8e3, 1e3);
    result.last_accelerated = released ? 131 : 130;
    result.phases = {{{10, 80}, {81, 130}, {131, 200}}};
  } else {
    result.step_s = 2.0;
    result.position = Vector<3>(120e3, 80e3, 20e3);
    result.last_accelerated = 40;
    result.phases = {{{10, 30}, {31, 40}, {41, 80}}};
  }
  return result;
}

Group group(int number, int scenario_number) {
  const double scale = scenario_number == 1 ? 1.0 : 9.0;
  const Polar accurate{scenario_number == 1 ? 10.0 : 100.0, degrees(0.1 * scale), degrees(0.1 * scale)};
  const auto times = [&](double factor) {
    return Polar{factor * accurate.range, factor * accurate.azimuth, factor * accurate.elevation};
  };
  const Group groups[] = {
      {accurate, accurate, 3.0}, {accurate, times(1.5), 3.0}, {accurate, times(2.0), 3.0}, {times(2.0), accurate, 1.0}};
  return groups[number - 1];
}

Recording simulate(const Scenario& scenario, const Polar& sigma, RandomStream& random) {
  constexpr double data_sigma_w = 3.0;
  const double T = scenario.step_s;
  Recording recording;
  Vector<6> state;
  state << scenario.position, scenario.velocity;
  for (int k = 1; k <= scenario.samples(); ++k) {
    recording.truth.push_back(state);
    recording.measured.push_back(measured(to_polar(state.head<3>()), sigma, random));
    Vector<3> acceleration = Vector<3>::Zero();
    if (k >= scenario.onset() && k <= scenario.last_accelerated) acceleration = scenario.acceleration;
    Vector<3> noise;
    for (double& w : noise) w = data_sigma_w * random.normal();
    const Vector<3> velocity = state.tail<3>();
    state.head<3>() += T * velocity + 0.5 * T * T * (acceleration + noise);
    state.tail<3>() += T * acceleration;
    if (scenario.noise_on_velocity) state.tail<3>() += T * noise;
  }
  return recording;
}

}  // namespace sigmax::apps
