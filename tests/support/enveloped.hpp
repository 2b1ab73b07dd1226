#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <sigmax/hybrid/envelope.hpp>

#include "support/restatement.hpp"

namespace sigmax::support {

/// The envelope of some states for a restatement; envelope_test.cpp holds it against plain sums.
inline restatement::State enveloped(const std::vector<restatement::State>& states, const std::vector<double>& weights) {
  const auto n = states.front().mean.size();
  const auto rows = static_cast<Eigen::Index>(n);
  Envelope envelope;
  envelope.clear(rows);
  for (std::size_t l = 0; l < states.size(); ++l)
    envelope.add(weights[l], Eigen::Map<const Eigen::VectorXd>(states[l].mean.data(), rows),
                 Eigen::Map<const Eigen::MatrixXd>(states[l].covariance.values.data(), rows, rows));
  restatement::State result{restatement::Vector(n), restatement::Matrix(n, n)};
  envelope.match(Eigen::Map<Eigen::VectorXd>(result.mean.data(), rows),
                 Eigen::Map<Eigen::MatrixXd>(result.covariance.values.data(), rows, rows));
  return result;
}

}  // namespace sigmax::support
