#include <sigmax/hybrid/motion_choice.hpp>

#include <stdexcept>

#include "known_motions.hpp"

namespace sigmax {
namespace {

constexpr std::array<KnownParameter, 4> parameters{{
    {"sigma_w", "Strength of the noise; its unit depends on the model.", 3.0, [](double value) { return value >= 0.0; },
     "numbers that are not negative"},
    {"tau_s", "How long singer, ou_velocity and ou_position remember.", 10.0, [](double value) { return value > 0.0; },
     "positive times, in s"},
    {"turn_deg_s", "The rate of known_turn.", 3.0, [](double) { return true; },
     "rates in °/s, counter-clockwise from above"},
    {"turn_drift_deg_s", "Standard deviation of what the rate of ct changes in one second.", 0.2,
     [](double value) { return value >= 0.0; }, "numbers that are not negative, in °/s"},
}};

constexpr auto motions = std::apply(
    [](const auto&... row) {
      return std::array{KnownMotion{row.name, detail::MotionOfRow<2, std::decay_t<decltype(row)>>::state_size / 2,
                                    detail::goes_along<1, std::decay_t<decltype(row)>> ? 1 : 2,
                                    LinearMotion<detail::MotionOfRow<2, std::decay_t<decltype(row)>>>, row.manoeuvres,
                                    row.has}...};
    },
    detail::motion_rows);

}  // namespace

std::span<const KnownParameter> motion_parameters() { return parameters; }

std::span<const KnownMotion> known_motions() { return motions; }

const KnownMotion* known_motion(std::string_view name) {
  for (const auto& motion : motions)
    if (motion.name == name) return &motion;
  return nullptr;
}

const KnownMotion& MotionChoice::known() const {
  if (const KnownMotion* motion = known_motion(name)) return *motion;
  throw std::invalid_argument("no motion is called '" + name + "'");
}

}  // namespace sigmax
