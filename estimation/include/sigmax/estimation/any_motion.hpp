#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/estimation/nonlinear_motion.hpp>

namespace sigmax {

/// One of several motions, linear or not, chosen at run time: what a program puts, inside a member of the Kalman
/// family, into the vector of a multiple-model filter whose models its user names.
///
///     using Moves = AnyMotion<7, CoordinatedTurn<3>, IndependentAxes<3, DiscreteWhiteNoise<2>>>;
///     const std::vector<AnyMember<Moves>> models = {Extended<Moves>{dwna<3>(3.0)}, …};
///
/// `MaxStateSize` bounds the state, and, in such a filter, the different components of all models together; so it may
/// be more than the size of each. Linear motions predict as the Kalman filter's do. Nothing is allocated.
template <int MaxStateSize, Motion First, Motion... Others>
class AnyMotion {
  static_assert(First::max_state_size <= MaxStateSize && ((Others::max_state_size <= MaxStateSize) && ...),
                "a motion has more states than the bound");
  template <class Moves>
  static constexpr bool is_one = std::is_same_v<Moves, First> || (std::is_same_v<Moves, Others> || ...);

 public:
  static constexpr int state_size = Eigen::Dynamic;
  static constexpr int max_state_size = MaxStateSize;
  static constexpr int axes = ((axes_of<First> == axes_of<Others>)&&...) ? axes_of<First> : 0;
  using State = Vector<state_size, max_state_size>;
  using Matrix = SquareMatrix<state_size, max_state_size>;

  template <class Moves>
    requires(is_one<Moves>)
  AnyMotion(Moves motion) : motion_(std::move(motion)) {}

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
    return visit([&](const auto& motion) -> State { return propagated(motion, own(motion, x), dt); });
  }
  Matrix transition_jacobian(const State& x, double dt) const {
    return visit([&](const auto& motion) -> Matrix { return sigmax::transition_jacobian(motion, own(motion, x), dt); });
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
  template <class Moves>
  static StateOf<Moves> own(const Moves& motion, const State& x) {
    if (x.size() == motion.size()) return x;
    throw std::invalid_argument("a state of model '" + std::string(motion.name()) + "' has " +
                                std::to_string(x.size()) + " components; expected " + std::to_string(motion.size()));
  }

  std::variant<First, Others...> motion_;
};

}  // namespace sigmax
