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

/// log ⊕ exp(log_weight(i)) of so many numbers, by the ⊕ of a kind.
template <class Kind, class LogWeight>
double log_total(std::size_t count, const LogWeight& log_weight) {
  return log_combine<AlgebraOf<Kind>>(count, log_weight, [](std::size_t) { return 1.0; });
}

}  // namespace detail
}  // namespace sigmax
