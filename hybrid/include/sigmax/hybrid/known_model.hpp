#pragma once

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/hybrid/motion_choice.hpp>

namespace sigmax {

/// The model of a motion that is chosen by name, along 1, 2 or 3 axes, in a member of the Kalman family. Throws
/// std::invalid_argument for a name that is not known, and for a motion that does not go along so few axes.
AnyModel known_model(const MotionChoice& choice, int axes, MemberType member = MemberType::ekf);

}  // namespace sigmax
