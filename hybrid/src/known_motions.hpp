#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

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
        "known_turn", manoeuvre, []<int A>(const MotionChoice& c) requires(A > 1) {
          return KnownTurn<A>(c[turn_rate] * degree, c[sigma_w] * c[sigma_w]);
        },
        sigma_w, turn_rate),
    MotionRow(
        "ct", manoeuvre, []<int A>(const MotionChoice& c) requires(A > 1) {
          const double drift = c[turn_drift] * degree;
          return CoordinatedTurn<A>(c[sigma_w] * c[sigma_w], drift * drift);
        },
        sigma_w, turn_drift)};

/// The motion that a row makes along so many axes.
template <int Axes, class Row>
using MotionOfRow = decltype(std::declval<const Row&>().make.template operator()<Axes>(MotionChoice{}));

/// Whether a row makes a motion along so many axes: none turns along one.
template <int Axes, class Row>
inline constexpr bool goes_along = requires(const Row& row) {
  row.make.template operator()<Axes>(MotionChoice{});
};

template <int Axes, class Row>
struct Listed {
  using type = std::tuple<>;
};
template <int Axes, class Row>
  requires(goes_along<Axes, Row>)
struct Listed<Axes, Row> {
  using type = std::tuple<MotionOfRow<Axes, Row>>;
};

template <class Rows>
struct MotionsOf;
template <class... Rows>
struct MotionsOf<const std::tuple<Rows...>> {
  static constexpr int components = std::max({MotionOfRow<3, Rows>::max_state_size...}) + 1;
  template <class... Motions>
  static auto any_of(const std::tuple<Motions...>&) -> AnyMotion<components, Motions...>;
  using type = decltype(any_of(std::tuple_cat(std::declval<typename Listed<1, Rows>::type>()...,
                                              std::declval<typename Listed<2, Rows>::type>()...,
                                              std::declval<typename Listed<3, Rows>::type>()...)));
};

/// Any of the known motions, along one axis, two or three. A bank of them has at most three derivatives and a rate of
/// turn.
using AnyKnownMotion = typename MotionsOf<decltype(motion_rows)>::type;

/// The motion of this choice along 1, 2 or 3 axes. Throws std::invalid_argument for a name that is not known, and for a
/// motion that does not go along so few axes.
inline AnyKnownMotion made(const MotionChoice& choice, int axes) {
  if (axes < choice.known().least_axes)
    throw std::invalid_argument("motion '" + choice.name + "' turns in a plane; it does not go along one axis");
  std::optional<AnyKnownMotion> motion;
  const auto make_along = [&]<int Axes>(const auto& row) {
    if constexpr (goes_along<Axes, std::decay_t<decltype(row)>>)
      if (row.name == choice.name && axes == Axes) motion.emplace(row.make.template operator()<Axes>(choice));
  };
  const auto make = [&](const auto& row) {
    make_along.template operator()<1>(row);
    make_along.template operator()<2>(row);
    make_along.template operator()<3>(row);
  };
  std::apply([&](const auto&... row) { (make(row), ...); }, motion_rows);
  return *motion;
}

}  // namespace sigmax::detail
