#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <sigmax/estimation/nonlinear_motion.hpp>

namespace sigmax {

/// What a non-linear member of the Kalman family shows of its motion, so that it can stand where a motion stands: in a
/// multiple-model filter.
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

namespace detail {

/// Whether a motion is one of several, chosen at run time: AnyMotion.
template <class Moves>
concept ChosenMotion = requires(const Moves& motion) {
  motion.visit([](const auto&) {});
};

/// Calls act(own, estimate) with the member over the motion that its own is, or a linear motion itself, and the prior
/// in the type of that motion. Throws std::invalid_argument, naming the model, for a prior of another size.
template <class Filter, class Act>
decltype(auto) as_chosen(const Filter& member, const EstimateOf<Filter>& prior, const Act& act) {
  return member.motion().visit([&](const auto& motion) -> decltype(auto) {
    if (prior.size() != motion.size())
      throw std::invalid_argument("an estimate of model '" + std::string(motion.name()) + "' has " +
                                  std::to_string(prior.size()) + " components; expected " +
                                  std::to_string(motion.size()));
    using Chosen = std::decay_t<decltype(motion)>;
    if constexpr (LinearMotion<Chosen>)
      return act(motion, EstimateOf<Chosen>(prior.mean, prior.covariance));
    else
      return act(member.over(motion), EstimateOf<Chosen>(prior.mean, prior.covariance));
  });
}

/// Predicts as the motion that the member's is.
template <class Filter>
void predict_as_chosen(const Filter& member, const EstimateOf<Filter>& prior, double dt, EstimateOf<Filter>& result) {
  as_chosen(member, prior, [&](const auto& own, auto estimate) {
    predict(own, estimate, dt, estimate);
    result.mean = estimate.mean;
    result.covariance = estimate.covariance;
  });
}
template <class Filter>
StateMatrixOf<Filter> covariance_as_chosen(const Filter& member, const EstimateOf<Filter>& prior, double dt) {
  return as_chosen(member, prior, [&](const auto& own, const auto& estimate) -> StateMatrixOf<Filter> {
    return prediction_covariance(own, estimate, dt);
  });
}

}  // namespace detail

}  // namespace sigmax
