#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/core/network.hpp>

namespace sigmax {

namespace detail {

/// The outcome at which the sum of the values passes `level`, a number in [0, 1).
std::size_t outcome_at(std::span<const double> values, double level);

}  // namespace detail

/// Index of an outcome drawn with its probability, by a generator like the standard library's. One number of 53 bits is
/// drawn.
template <class Generator>
std::size_t sample(const Distribution<Random>& distribution, Generator& generator) {
  return detail::outcome_at(distribution.values(), std::generate_canonical<double, 53>(generator));
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
