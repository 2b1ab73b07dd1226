#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/estimation/nonlinear_model.hpp>

namespace sigmax {

/// One of several motions, linear or not, chosen at run time, for whatever sensor and member; `AnyModel` chooses among
/// whole models, and so keeps the Kalman filter of a linear one.
///
///     using Motion = AnyMotion<7, KinematicModel<3, 2>, CoordinatedTurn<3>>;
///     const std::vector<Unscented<Observed<Motion, PolarSensor<3>>>> models = {…};
///
/// `MaxStateSize` bounds the state, and, in a multiple-model filter, the different components of all models together.
template <int MaxStateSize, class First, class... Others>
class AnyMotion {
  static_assert(First::max_state_size <= MaxStateSize && ((Others::max_state_size <= MaxStateSize) && ...),
                "a motion has more states than the bound");
  template <class Motion>
  static constexpr bool is_one = std::is_same_v<Motion, First> || (std::is_same_v<Motion, Others> || ...);

 public:
  static constexpr int state_size = Eigen::Dynamic;
  static constexpr int max_state_size = MaxStateSize;
  using State = Vector<state_size, max_state_size>;
  using Matrix = SquareMatrix<state_size, max_state_size>;

  template <class Motion>
    requires(is_one<Motion>)
  AnyMotion(Motion motion) : motion_(std::move(motion)) {}

  Eigen::Index size() const {
    return visit([](const auto& motion) -> Eigen::Index { return motion.size(); });
  }
  std::string_view name() const {
    return visit([](const auto& motion) -> std::string_view { return motion.name(); });
  }
  std::vector<std::string> components() const {
    return visit([](const auto& motion) -> std::vector<std::string> { return motion.components(); });
  }

  /// As the motion that it is; of a linear one f(x) = F x + u. Throws std::invalid_argument for a state of another
  /// size.
  State propagate(const State& x, double dt) const {
    return visit([&](const auto& motion) -> State { return detail::moved(motion, own(motion, x), dt); });
  }
  Matrix transition_jacobian(const State& x, double dt) const {
    return visit([&](const auto& motion) -> Matrix { return detail::tangent(motion, own(motion, x), dt); });
  }
  Matrix process_covariance(double dt) const {
    return visit([&](const auto& motion) -> Matrix { return motion.process_covariance(dt); });
  }

  /// Calls `visitor(motion)` with the motion that it is.
  template <class Visitor>
  decltype(auto) visit(const Visitor& visitor) const {
    return std::visit(visitor, motion_);
  }

 private:
  template <class Motion>
  static StateOf<Motion> own(const Motion& motion, const State& x) {
    if (x.size() == motion.size()) return x;
    throw std::invalid_argument("a state of model '" + std::string(motion.name()) + "' has " +
                                std::to_string(x.size()) + " components; expected " + std::to_string(motion.size()));
  }

  std::variant<First, Others...> motion_;
};

}  // namespace sigmax
