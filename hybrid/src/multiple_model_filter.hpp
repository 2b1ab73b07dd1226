#pragma once

#include <sigmax/hybrid/multiple_model_filter.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/estimation/dense.hpp>

/// What the compiled filters share of the code of their base.
namespace sigmax {
namespace detail {

/// Room for numbers of the modes, and for the parts of a mixture over them.
using OfModes = Scratch<32>;
using Parts = Scratch<32, Mixture::Part>;

inline double unit(std::size_t) { return 1.0; }

}  // namespace detail

template <ScalableUncertainty Kind>
template <class LogFit>
bool MultipleModelFilter<Kind>::passes(double gate, std::size_t hypotheses, const LogFit& log_fit) {
  gate_distance_ = -2.0 * detail::log_combine<AlgebraOf<Kind>>(hypotheses, log_fit, detail::unit);
  return gate == no_gate || *gate_distance_ <= gate;
}

template <ScalableUncertainty Kind>
template <class Action>
void MultipleModelFilter<Kind>::located(double dt, const Action& action) const {
  try {
    action();
  } catch (const std::domain_error& error) {
    throw std::domain_error(this_step(dt) + ": " + error.what());
  }
}

}  // namespace sigmax
