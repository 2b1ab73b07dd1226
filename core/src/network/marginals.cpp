#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <sigmax/core/network/query.hpp>

#include "solve.hpp"

namespace sigmax {

using elimination::Factor;
using elimination::Vertex;

namespace {

/// ⊕ over all variables of `scope` but those of `kept` of the product of the factors.
template <ScalingAlgebra A>
Factor reduced(const std::vector<Factor>& factors, const std::vector<Vertex>& scope, std::vector<Vertex> kept,
               const std::vector<std::size_t>& sizes) {
  std::vector<Vertex> all = kept;
  for (const Vertex v : scope)
    if (std::find(kept.begin(), kept.end(), v) == kept.end()) all.push_back(v);
  Factor result{std::move(kept), {}};
  result.values.resize(elimination::outcomes_of(result.scope, sizes));
  const std::size_t inner = elimination::outcomes_of(all, sizes) / result.values.size();
  elimination::for_each_product(factors, all, sizes, [&](std::size_t index, ScaledNumber value) {
    ScaledNumber& sum = result.values[index / inner];
    sum = ScaledNumber::plus<A>(sum, value);
  });
  return result;
}

/// One elimination: its variable, its factors, and what it sends on to the elimination that takes that up.
struct Bucket {
  Vertex vertex;
  std::vector<Vertex> scope;      // of all of its factors
  std::vector<Factor> own;        // factors that no other elimination made
  std::vector<std::size_t> made;  // the buckets whose messages are factors of it
  Factor up;
  std::size_t parent;  // that of the message, or the number of buckets
  Factor down;         // all the rest, as a function of the message's scope
};

/// Eliminates in the order, then goes back: every bucket learns what the others say of its variables.
template <ScalingAlgebra A>
std::vector<Factor> two_passes(std::vector<Factor> factors, const std::vector<Vertex>& order,
                               const std::vector<std::size_t>& sizes, ScaledNumber& total) {
  const std::size_t n = order.size();
  std::vector<std::size_t> place(sizes.size(), n);
  for (std::size_t k = 0; k < n; ++k) place[order[k]] = k;
  const auto first_of = [&](const Factor& factor) {
    std::size_t first = n;
    for (const Vertex v : factor.scope) first = std::min(first, place[v]);
    return first;
  };
  std::vector<Bucket> buckets(n);
  std::vector<ScaledNumber> constants(n + 1, ScaledNumber{1.0});  // of every root, and of what is known
  for (Factor& factor : factors) {
    const std::size_t k = first_of(factor);
    if (k == n)
      constants[n] = constants[n] * factor.values.front();
    else
      buckets[k].own.push_back(std::move(factor));
  }
  const auto with_messages = [&](const Bucket& bucket, std::size_t without) {
    std::vector<Factor> all = bucket.own;
    for (const std::size_t child : bucket.made)
      if (child != without) all.push_back(buckets[child].up);
    return all;
  };
  for (std::size_t k = 0; k < n; ++k) {
    Bucket& bucket = buckets[k];
    bucket.vertex = order[k];
    const auto all = with_messages(bucket, n);
    bucket.up = elimination::eliminate<A>(all, bucket.vertex, sizes);
    bucket.scope = bucket.up.scope;
    bucket.scope.push_back(bucket.vertex);
    bucket.parent = first_of(bucket.up);
    if (bucket.parent == n)
      constants[k] = bucket.up.values.front();
    else
      buckets[bucket.parent].made.push_back(k);
  }
  // What all other roots are: products from either side, for there is no dividing by zero.
  std::vector<ScaledNumber> before(n + 2, ScaledNumber{1.0}), after(n + 2, ScaledNumber{1.0});
  for (std::size_t k = 0; k <= n; ++k) before[k + 1] = before[k] * constants[k];
  for (std::size_t k = n + 1; k-- > 0;) after[k] = after[k + 1] * constants[k];
  total = after[0];

  std::vector<Factor> marginals(sizes.size());
  for (std::size_t k = n; k-- > 0;) {
    Bucket& bucket = buckets[k];
    if (bucket.parent == n) {
      bucket.down = {{}, {before[k] * after[k + 1]}};
    } else {
      const Bucket& parent = buckets[bucket.parent];
      auto rest = with_messages(parent, k);
      rest.push_back(parent.down);
      bucket.down = reduced<A>(rest, parent.scope, bucket.up.scope, sizes);
    }
    auto all = with_messages(bucket, n);
    all.push_back(bucket.down);
    marginals[bucket.vertex] = reduced<A>(all, bucket.scope, {bucket.vertex}, sizes);
  }
  return marginals;
}

}  // namespace

std::vector<NetworkAnswer> marginals(const RelationNetwork& network, const Evidence& evidence,
                                     std::size_t table_limit) {
  std::vector<NetworkAnswer> answers;
  const auto findings = elimination::findings_of(network, evidence);
  std::vector<Vertex> all(network.size());
  std::iota(all.begin(), all.end(), Vertex{0});
  const auto parts = elimination::parts_of(network, all, findings, {});
  const auto problem = elimination::order_problem(network, parts, {});
  if (elimination::of_two_kinds(problem)) {
    for (const Vertex v : all) answers.push_back(query(network, {network[v].variable.name()}, evidence, table_limit));
    return answers;
  }
  const auto order = elimination::order_of_elimination(problem);
  elimination::refuse_above(table_limit, order.greatest_table, order.greatest_scope, network);
  const auto sizes = elimination::sizes_of(network);
  std::vector<Factor> found(network.size());
  ScaledNumber total{1.0};
  auto factors = elimination::factors_of(network, parts, findings);
  if (order.vertices.empty())
    total = elimination::product(factors, {}, sizes).values.front();
  else
    found = elimination::with_algebra_of(network[order.vertices.front()].variable, [&]<class A>(A) {
      return two_passes<A>(std::move(factors), order.vertices, sizes, total);
    });
  if (total.is_zero()) elimination::refuse(findings);
  Elimination cost{{}, order.greatest_table, false, order.greatest_table};
  for (const Vertex v : order.vertices) cost.order.push_back(network[v].variable.name());
  for (const Vertex v : all) {
    std::vector<ScaledNumber> values = std::move(found[v].values);
    if (parts.known[v]) {
      values.assign(sizes[v], ScaledNumber{});
      values[*parts.known[v]] = total;
    }
    answers.emplace_back(std::vector<NetworkVariable>{network[v].variable}, std::move(values), total, false, cost);
  }
  return answers;
}

}  // namespace sigmax
