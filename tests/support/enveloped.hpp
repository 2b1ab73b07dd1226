#pragma once

#include <sigmax/hybrid/envelope.hpp>

#include "support/restatement.hpp"

namespace sigmax::support {

/// The envelope of some states for a restatement; envelope_test.cpp holds it against plain sums.
inline restatement::State enveloped(const std::vector<restatement::State>& states, const std::vector<double>& weights) {
  const std::size_t n = states.front().mean.size();
  const auto size = static_cast<int>(n);
  Envelope envelope;
  envelope.clear(size);
  for (std::size_t l = 0; l < states.size(); ++l)
    envelope.add(weights[l], {states[l].mean.data(), states[l].covariance.values.data(), size});
  restatement::State result{restatement::Vector(n), restatement::Matrix(n, n)};
  envelope.match({result.mean.data(), result.covariance.values.data(), size});
  return result;
}

}  // namespace sigmax::support
