#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/estimation/nonlinear_motion.hpp>
#include <sigmax/estimation/refs.hpp>

namespace sigmax {

/// What a non-linear member of the Kalman family shows of its motion, so that it can stand where a motion stands: in a
/// multiple-model filter. One that uses sigma points says where, `weights()`; another uses tangents.
template <Motion Moves>
class Member {
 public:
  using MotionType = Moves;
  static constexpr int state_size = Moves::state_size;
  static constexpr int max_state_size = Moves::max_state_size;
  static constexpr int axes = axes_of<Moves>;

  explicit Member(Moves motion) : motion_(std::move(motion)) {}

  Eigen::Index size() const { return motion_.size(); }
  std::string_view name() const { return motion_.name(); }
  std::vector<std::string> components() const { return motion_.components(); }
  const Moves& motion() const { return motion_; }

 private:
  Moves motion_;
};

}  // namespace sigmax
