#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <sigmax/core/network.hpp>
#include <sigmax/core/transform.hpp>

namespace sigmax {

/// How a row of probabilities becomes numbers in proportion to which its possibilities are.
using RowTransform = std::function<std::vector<double>(std::span<const double>)>;

/// The network with its random variables made fuzzy, every row of their tables transformed; or only those named.
///
///     as_fuzzy(network, RatioScale{})
///
/// Throws std::invalid_argument, naming the variable, if a transformed row is not of numbers to which a possibility
/// distribution can be in proportion, or if a name is not that of a random variable of the network.
RelationNetwork as_fuzzy(const RelationNetwork& network, const RowTransform& transform);
RelationNetwork as_fuzzy(const RelationNetwork& network, const RowTransform& transform,
                         const std::vector<std::string>& names);

template <PossibilityTransform Method, class... Names>
RelationNetwork as_fuzzy(const RelationNetwork& network, const Method& method, const Names&... names) {
  const RowTransform transform = [&method](std::span<const double> row) { return method.possibilities(row); };
  return as_fuzzy(network, transform, names...);
}

}  // namespace sigmax
