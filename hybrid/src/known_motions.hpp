#pragma once

#include <initializer_list>
#include <string_view>

#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/unscented.hpp>
#include <sigmax/hybrid/motion_choice.hpp>

/// How a row of the table of motions is made, in motion_choice.cpp.
namespace sigmax::detail {

using enum MotionParameter;
inline constexpr bool manoeuvre = true;
inline constexpr bool no_manoeuvre = false;

/// A motion in a member of the Kalman family.
template <Motion Moves>
AnyModel in_member(const Moves& motion, MemberType member) {
  if (member == MemberType::ukf) return Unscented{motion};
  if (member == MemberType::ckf) return Cubature{motion};
  return Extended{motion};  // the Kalman filter, where motion and sensor are linear
}

/// A motion of a class template of the number of axes: `make`, a lambda template, goes along `Least`, one or two, to
/// three.
template <int Least = 1, class Make>
constexpr KnownMotion motion_row(std::string_view name, bool manoeuvres, Make,
                                 std::initializer_list<MotionParameter> needs) {
  using InThePlane = decltype(Make{}.template operator()<2>(MotionChoice{}));
  KnownMotion known{name, InThePlane::state_size / 2, Least, LinearMotion<InThePlane>, manoeuvres};
  for (const MotionParameter parameter : needs) known.has[static_cast<std::size_t>(parameter)] = true;
  known.make = [](const MotionChoice& choice, int axes, MemberType member) {
    if constexpr (Least == 1)
      if (axes == 1) return in_member(Make{}.template operator()<1>(choice), member);
    return axes == 2 ? in_member(Make{}.template operator()<2>(choice), member)
                     : in_member(Make{}.template operator()<3>(choice), member);
  };
  return known;
}

}  // namespace sigmax::detail
