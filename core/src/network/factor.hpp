#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <sigmax/core/algebra.hpp>
#include <sigmax/core/scaled_number.hpp>

namespace sigmax::elimination {

/// A vertex of the network by its index, hence also by its rank in the order of declaration.
using Vertex = std::size_t;

/// A function of some variables of a network, its numbers with the last variable fastest.
struct Factor {
  std::vector<Vertex> scope;
  std::vector<ScaledNumber> values;  ///< one number if the scope is empty
};

/// How many outcomes the variables have together; that a table may be that large was found out before.
inline std::size_t outcomes_of(std::span<const Vertex> scope, std::span<const std::size_t> sizes) {
  std::size_t count = 1;
  for (const Vertex v : scope) count *= sizes[v];
  return count;
}

/// Calls visit(index, product of all factors) for all outcomes of the scope in order, the last variable fastest. The
/// scope holds those of the factors.
template <class Visit>
void for_each_product(std::span<const Factor> factors, std::span<const Vertex> scope,
                      std::span<const std::size_t> sizes, const Visit& visit) {
  const std::size_t n = scope.size();
  // How far a step of each variable of the scope moves in each factor.
  std::vector<std::size_t> strides(factors.size() * n, 0);
  for (std::size_t f = 0; f < factors.size(); ++f) {
    std::size_t stride = 1;
    for (std::size_t s = factors[f].scope.size(); s-- > 0;) {
      const Vertex v = factors[f].scope[s];
      const auto place = std::find(scope.begin(), scope.end(), v);
      assert(place != scope.end());
      strides[f * n + static_cast<std::size_t>(place - scope.begin())] = stride;
      stride *= sizes[v];
    }
  }
  std::vector<std::size_t> at(factors.size(), 0);
  std::vector<std::size_t> digits(n, 0);
  const std::size_t count = outcomes_of(scope, sizes);
  for (std::size_t index = 0; index < count; ++index) {
    ScaledNumber product{1.0};
    for (std::size_t f = 0; f < factors.size(); ++f) product = product * factors[f].values[at[f]];
    visit(index, product);
    for (std::size_t d = n; d-- > 0;) {
      const bool carry = ++digits[d] == sizes[scope[d]];
      for (std::size_t f = 0; f < factors.size(); ++f)
        at[f] = carry ? at[f] - strides[f * n + d] * (digits[d] - 1) : at[f] + strides[f * n + d];
      if (!carry) break;
      digits[d] = 0;
    }
  }
}

/// The product of the factors as a function of `scope`, in that order.
inline Factor product(std::span<const Factor> factors, std::vector<Vertex> scope, std::span<const std::size_t> sizes) {
  Factor result{std::move(scope), {}};
  result.values.resize(outcomes_of(result.scope, sizes));
  for_each_product(factors, result.scope, sizes,
                   [&](std::size_t index, ScaledNumber value) { result.values[index] = value; });
  return result;
}

/// ⊕ over the outcomes of `vertex` of the product of the factors; every elimination goes through here.
template <ScalingAlgebra A>
Factor eliminate(std::span<const Factor> factors, Vertex vertex, std::span<const std::size_t> sizes) {
  std::set<Vertex> others;
  for (const Factor& factor : factors) others.insert(factor.scope.begin(), factor.scope.end());
  others.erase(vertex);
  Factor result{{others.begin(), others.end()}, {}};
  result.values.resize(outcomes_of(result.scope, sizes), ScaledNumber{A::zero()});
  std::vector<Vertex> scope = result.scope;
  scope.push_back(vertex);
  for_each_product(factors, scope, sizes, [&](std::size_t index, ScaledNumber value) {
    ScaledNumber& sum = result.values[index / sizes[vertex]];
    sum = ScaledNumber::plus<A>(sum, value);
  });
  return result;
}

/// The number of a factor where every vertex, by its index, has this outcome.
inline ScaledNumber number_at(const Factor& factor, std::span<const std::size_t> outcomes,
                              std::span<const std::size_t> sizes) {
  std::size_t index = 0;
  for (const Vertex v : factor.scope) index = index * sizes[v] + outcomes[v];
  return factor.values[index];
}

}  // namespace sigmax::elimination
