#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>

#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/known_turn.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/white_noise.hpp>
#include <sigmax/hybrid/motion_choice.hpp>

/// The motions that can be chosen by name: a row here is all that a new one needs.
namespace sigmax::detail {

using enum MotionParameter;
inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr bool manoeuvre = true;
inline constexpr bool no_manoeuvre = false;

/// One row: the name, whether it stands for a manoeuvre, how it is made, and which parameters that takes.
template <class Make>
struct MotionRow {
  std::string_view name;
  bool manoeuvres;
  Make make;
  std::array<bool, 4> has{};

  template <class... Parameters>
  constexpr MotionRow(std::string_view row_name, bool manoeuvres_too, Make row_make, Parameters... parameters)
      : name(row_name), manoeuvres(manoeuvres_too), make(row_make) {
    ((has[static_cast<std::size_t>(parameters)] = true), ...);
  }
};

inline constexpr auto motion_rows = std::tuple{
    MotionRow(
        "dwna", no_manoeuvre, []<int A>(const MotionChoice& c) { return dwna<A>(c[sigma_w]); }, sigma_w),
    MotionRow(
        "dwpa", manoeuvre, []<int A>(const MotionChoice& c) { return dwpa<A>(c[sigma_w]); }, sigma_w),
    MotionRow(
        "cwna", no_manoeuvre, []<int A>(const MotionChoice& c) { return cwna<A>(c[sigma_w] * c[sigma_w]); }, sigma_w),
    MotionRow(
        "cwpa", manoeuvre, []<int A>(const MotionChoice& c) { return cwpa<A>(c[sigma_w] * c[sigma_w]); }, sigma_w),
    MotionRow(
        "singer", manoeuvre, []<int A>(const MotionChoice& c) { return singer<A>(1.0 / c[tau], c[sigma_w]); }, sigma_w,
        tau),
    MotionRow(
        "ou_position", no_manoeuvre,
        []<int A>(const MotionChoice& c) { return ou_position<A>(1.0 / c[tau], c[sigma_w]); }, sigma_w, tau),
    MotionRow(
        "ou_velocity", no_manoeuvre,
        []<int A>(const MotionChoice& c) { return ou_velocity<A>(1.0 / c[tau], c[sigma_w]); }, sigma_w, tau),
    MotionRow(
        "known_turn", manoeuvre,
        []<int A>(const MotionChoice& c) { return KnownTurn<A>(c[turn_rate] * degree, c[sigma_w] * c[sigma_w]); },
        sigma_w, turn_rate),
    MotionRow(
        "ct", manoeuvre,
        []<int A>(const MotionChoice& c) {
          const double drift = c[turn_drift] * degree;
          return CoordinatedTurn<A>(c[sigma_w] * c[sigma_w], drift * drift);
        },
        sigma_w, turn_drift)};

/// The motion that a row makes along so many axes.
template <int Axes, class Row>
using MotionOfRow = decltype(std::declval<const Row&>().make.template operator()<Axes>(MotionChoice{}));

template <class Rows>
struct MotionsOf;
template <class... Rows>
struct MotionsOf<const std::tuple<Rows...>> {
  static constexpr int components = std::max({MotionOfRow<3, Rows>::max_state_size...}) + 1;
  using type = AnyMotion<components, MotionOfRow<2, Rows>..., MotionOfRow<3, Rows>...>;
};

/// Any of the known motions, along two axes or three. A bank of them has at most three derivatives and a rate of turn.
using AnyKnownMotion = typename MotionsOf<decltype(motion_rows)>::type;

/// The motion of this choice along 2 or 3 axes. Throws std::invalid_argument for a name that is not known.
inline AnyKnownMotion made(const MotionChoice& choice, int axes) {
  std::optional<AnyKnownMotion> motion;
  const auto make = [&](const auto& row) {
    if (row.name != choice.name) return;
    if (axes == 2)
      motion.emplace(row.make.template operator()<2>(choice));
    else
      motion.emplace(row.make.template operator()<3>(choice));
  };
  std::apply([&](const auto&... row) { (make(row), ...); }, motion_rows);
  choice.known();  // throws if there is none
  return *motion;
}

}  // namespace sigmax::detail
