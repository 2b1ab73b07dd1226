#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/estimation/model.hpp>

namespace sigmax {

/// x_k = F x_{k−1} + u + G w, (47), with matrices given for one fixed step.
///
/// `N` states; `Q` is G Q Gᵀ, `u` the known input's effect on the state.
template <int N>
class FixedStepMotion {
 public:
  static constexpr int state_size = N;
  static constexpr int max_state_size = N;

  using Transition = SquareMatrix<N>;

  /// Throws std::invalid_argument unless there are N components and the step is positive.
  FixedStepMotion(std::string name, std::vector<std::string> components, double step, const Transition& F,
                  const Transition& Q, const Vector<N>& u = Vector<N>::Zero())
      : name_(std::move(name)), components_(std::move(components)), step_(step), F_(F), Q_(Q), u_(u) {
    if (components_.size() != static_cast<std::size_t>(N))
      throw std::invalid_argument("model '" + name_ + "' has " + std::to_string(N) + " states, but " +
                                  std::to_string(components_.size()) + " components were named");
    if (!(step > 0.0)) throw std::invalid_argument("model '" + name_ + "' needs a positive step");
  }

  Eigen::Index size() const { return N; }
  const std::string& name() const { return name_; }
  const std::vector<std::string>& components() const { return components_; }

  /// All three throw std::invalid_argument if `dt` is not the step for which the matrices were given.
  const Transition& transition(double dt) const { return at(dt, F_); }
  const Transition& process_covariance(double dt) const { return at(dt, Q_); }
  const Vector<N>& known_input(double dt) const { return at(dt, u_); }

 private:
  template <class T>
  const T& at(double dt, const T& matrix) const {
    if (!(std::abs(dt - step_) <= 1e-9 * step_))
      throw std::invalid_argument("model '" + name_ + "' was given for steps of " + std::to_string(step_) +
                                  " s, but one of " + std::to_string(dt) + " s was asked for");
    return matrix;
  }

  std::string name_;
  std::vector<std::string> components_;
  double step_;
  Transition F_;
  Transition Q_;
  Vector<N> u_;
};

}  // namespace sigmax
