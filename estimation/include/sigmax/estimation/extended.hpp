#pragma once

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/estimation/member.hpp>

namespace sigmax {

/// The extended Kalman filter over a motion: f and h are replaced by their tangents at the estimate. As a mode of a
/// multiple-model filter, or by itself with `predict` and `update`.
///
///     const Extended filter{CoordinatedTurn<3>{1.0, 0.01}};
///     update(filter, x, z, PolarSensor<3>{}, x);
///
/// Jacobians are the motion's and the sensor's own, else by automatic differentiation (Bar-Shalom, Li, Kirubarajan
/// 2001, 10.3). A linear motion has the same update without this wrapper.
template <Motion Moves>
class Extended : public Member<Moves> {
 public:
  using Member<Moves>::Member;
};

template <Motion Moves>
Extended(Moves) -> Extended<Moves>;

}  // namespace sigmax
