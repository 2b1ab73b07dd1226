#include <sigmax/hybrid/motion_choice.hpp>

#include <numbers>
#include <stdexcept>

#include <sigmax/estimation/named_motion.hpp>

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

/// A row of a motion that the library computes: its name, whether it stands for a manoeuvre, how many derivatives it
/// has, and what its two parameters are made of.
template <NamedMotion::Type Type, int Order, class Numbers>
constexpr MotionRow named(std::string_view name, bool manoeuvres, Numbers,
                          std::initializer_list<MotionParameter> needs) {
  constexpr bool turns = Type == NamedMotion::Type::known_turn || Type == NamedMotion::Type::coordinated_turn;
  constexpr bool linear = Type != NamedMotion::Type::coordinated_turn;
  return {{name, Order, turns ? 2 : 1, linear, manoeuvres, MotionRow::parameters(needs)},
          [](const MotionChoice& choice, int axes, MemberType member) {
            const auto [first, second] = Numbers{}(choice);
            const NamedMotion motion{Type, Order, axes, first, second};
            motion.require();
            return in_member(motion, member);
          }};
}

struct Two {
  double first, second = 0.0;
};
constexpr double square(double value) { return value * value; }
constexpr double degree = std::numbers::pi / 180.0;
constexpr auto sigma = [](const MotionChoice& c) { return Two{c[sigma_w]}; };
constexpr auto density = [](const MotionChoice& c) { return Two{square(c[sigma_w])}; };
constexpr auto memory = [](const MotionChoice& c) { return Two{1.0 / c[tau], c[sigma_w]}; };
constexpr auto rate = [](const MotionChoice& c) { return Two{c[turn_rate] * degree, square(c[sigma_w])}; };
constexpr auto drift = [](const MotionChoice& c) { return Two{square(c[sigma_w]), square(c[turn_drift] * degree)}; };

/// The motions that can be chosen by name, in the order of the documentation: a row here is all that a new one needs.
using enum NamedMotion::Type;
constexpr std::array rows{named<discrete_white_noise, 2>("dwna", no_manoeuvre, sigma, {sigma_w}),
                          named<discrete_white_noise, 3>("dwpa", manoeuvre, sigma, {sigma_w}),
                          named<white_noise, 2>("cwna", no_manoeuvre, density, {sigma_w}),
                          named<white_noise, 3>("cwpa", manoeuvre, density, {sigma_w}),
                          named<ornstein_uhlenbeck, 3>("singer", manoeuvre, memory, {sigma_w, tau}),
                          named<ornstein_uhlenbeck, 1>("ou_position", no_manoeuvre, memory, {sigma_w, tau}),
                          named<ornstein_uhlenbeck, 2>("ou_velocity", no_manoeuvre, memory, {sigma_w, tau}),
                          named<known_turn, 2>("known_turn", manoeuvre, rate, {sigma_w, turn_rate}),
                          named<coordinated_turn, 2>("ct", manoeuvre, drift, {sigma_w, turn_drift})};

constexpr auto motions = [] {
  std::array<KnownMotion, rows.size()> all{};
  for (std::size_t i = 0; i < rows.size(); ++i) all[i] = rows[i].known;
  return all;
}();

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
  std::size_t row = 0;
  while (rows[row].known.name != choice.name) ++row;
  return rows[row].make(choice, axes, member);
}

}  // namespace sigmax
