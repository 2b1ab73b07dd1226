#pragma once

#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/core/network.hpp>

namespace sigmax {

/// Index of an outcome drawn with its probability, from a generator as those of the standard library. One number of 53
/// bits is drawn.
template <class Generator>
std::size_t sample(const Distribution<Random>& distribution, Generator& generator) {
  double left = std::generate_canonical<double, std::numeric_limits<double>::digits>(generator);
  std::size_t last = 0;
  for (std::size_t i = 0; i < distribution.size(); ++i) {
    if (distribution[i] == 0.0) continue;
    last = i;
    left -= distribution[i];
    if (left < 0.0) break;
  }
  return last;
}

/// One outcome for every variable of a network, in the order of declaration, drawn parents first. Throws
/// std::invalid_argument if a variable is not random: possibilities are nothing to draw from.
template <class Generator>
std::vector<std::size_t> sample(const RelationNetwork& network, Generator& generator) {
  std::vector<std::size_t> outcomes;
  for (std::size_t v = 0; v < network.size(); ++v) outcomes.push_back(sample(network.given(v, outcomes), generator));
  return outcomes;
}

}  // namespace sigmax
