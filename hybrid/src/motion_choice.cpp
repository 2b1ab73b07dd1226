#include <sigmax/hybrid/motion_choice.hpp>

#include <numbers>
#include <stdexcept>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/known_turn.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/white_noise.hpp>

#include "known_motions.hpp"

namespace sigmax {
namespace {

using namespace detail;

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

constexpr double degree = std::numbers::pi / 180.0;

/// The motions that can be chosen by name, in the order of the documentation: a row here is all that a new one needs.
constexpr std::array motions{
    motion_row("dwna", no_manoeuvre, []<int A>(const MotionChoice& c) { return dwna<A>(c[sigma_w]); }, {sigma_w}),
    motion_row("dwpa", manoeuvre, []<int A>(const MotionChoice& c) { return dwpa<A>(c[sigma_w]); }, {sigma_w}),
    motion_row("cwna", no_manoeuvre, []<int A>(const MotionChoice& c) { return cwna<A>(c[sigma_w]); }, {sigma_w}),
    motion_row("cwpa", manoeuvre, []<int A>(const MotionChoice& c) { return cwpa<A>(c[sigma_w]); }, {sigma_w}),
    motion_row("singer", manoeuvre, []<int A>(const MotionChoice& c) { return singer<A>(1.0 / c[tau], c[sigma_w]); },
               {sigma_w, tau}),
    motion_row("ou_position", no_manoeuvre,
               []<int A>(const MotionChoice& c) { return ou_position<A>(1.0 / c[tau], c[sigma_w]); }, {sigma_w, tau}),
    motion_row("ou_velocity", no_manoeuvre,
               []<int A>(const MotionChoice& c) { return ou_velocity<A>(1.0 / c[tau], c[sigma_w]); }, {sigma_w, tau}),
    motion_row<2>("known_turn", manoeuvre,
                  []<int A>(const MotionChoice& c) {
                    return KnownTurn<A>{c[turn_rate] * degree, c[sigma_w]};
                  },
                  {sigma_w, turn_rate}),
    motion_row<2>("ct", manoeuvre,
                  []<int A>(const MotionChoice& c) {
                    return CoordinatedTurn<A>{c[sigma_w], c[turn_drift] * degree};
                  },
                  {sigma_w, turn_drift})};

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

AnyModel known_model(const MotionChoice& choice, int axes, MemberType member) {
  if (axes < choice.known().least_axes)
    throw std::invalid_argument("motion '" + choice.name + "' turns in a plane; it does not go along one axis");
  return choice.known().make(choice, axes, member);
}

}  // namespace sigmax
