#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "support/random.hpp"

namespace sigmax::apps {

/// One of `size` outcomes, all equally probable.
inline std::size_t draw_index(RandomStream& random, std::size_t size) {
  return std::min(size - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(size)));
}

/// An outcome with these probabilities; they may miss a sum of one by rounding.
inline std::size_t draw(RandomStream& random, std::span<const double> probabilities) {
  const double u = random.uniform();
  double sum = 0.0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    if (probabilities[i] <= 0.0) continue;
    last = i;
    sum += probabilities[i];
    if (u < sum) break;
  }
  return last;
}

/// The logarithm of a draw from the gamma density of unit scale: Marsaglia and Tsang (2000). A shape below one is
/// raised by one and the draw shrunk by u^(1/shape), which underflows where its logarithm does not.
inline double draw_log_gamma(RandomStream& random, double shape) {
  if (shape < 1.0) {
    const double log_u = std::log(random.uniform());
    return draw_log_gamma(random, shape + 1.0) + log_u / shape;
  }
  const double d = shape - 1.0 / 3.0;
  const double c = 1.0 / std::sqrt(9.0 * d);
  for (;;) {
    const double x = random.normal();
    const double u = random.uniform();
    const double root = 1.0 + c * x;
    if (root <= 0.0) continue;
    const double v = root * root * root;
    if (std::log(u) < 0.5 * x * x + d - d * v + d * std::log(v)) return std::log(d * v);
  }
}

/// Shares of one, from the symmetric Dirichlet density with parameter `alpha` > 0.
inline std::vector<double> draw_dirichlet(RandomStream& random, std::size_t size, double alpha) {
  std::vector<double> shares(size);
  for (double& share : shares) share = draw_log_gamma(random, alpha);
  const double greatest = *std::max_element(shares.begin(), shares.end());
  double sum = 0.0;
  for (double& share : shares) sum += share = std::exp(share - greatest);
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace sigmax::apps
