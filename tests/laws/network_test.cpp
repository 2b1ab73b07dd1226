#include "laws/generate.hpp"
#include "support/plain_network.hpp"

/// Generated networks against full enumeration of the joint, the variables eliminated in the reverse order of
/// declaration.
namespace network_test {

enum class Kinds { random, fuzzy, mixed };

/// A network with evidence, and the variables that are asked for.
struct World {
  plain::Network network;
  plain::Weights weights;
  std::vector<std::size_t> asked;
  std::vector<std::size_t> seen;     ///< variables with one outcome seen
  std::vector<std::size_t> weighed;  ///< variables with a likelihood
};

std::ostream& operator<<(std::ostream& out, const World& world) {
  for (std::size_t v = 0; v < world.network.nodes.size(); ++v) {
    const auto& node = world.network.nodes[v];
    out << "\n" << v << (node.by == By::sum ? " random given" : " fuzzy given");
    for (const std::size_t parent : node.parents) out << " " << parent;
    for (const auto& row : node.rows) out << "\n  " << testing::PrintToString(row);
    out << "\n  weights " << testing::PrintToString(world.weights[v]);
  }
  return out << "\nasked " << testing::PrintToString(world.asked);
}

/// 1 to 8 variables with up to 3 parents and 1 to 4 outcomes.
World any_world(Kinds kinds) {
  return any([kinds](rc::Random& random) {
    const auto below = [&random](std::size_t n) { return std::size_t{random.next() >> 20} % n; };
    World world;
    const std::size_t n = 1 + below(8);
    for (std::size_t v = 0; v < n; ++v) {
      plain::Network::Node node{
          kinds == Kinds::fuzzy || (kinds == Kinds::mixed && below(2) == 0) ? By::max : By::sum, 1 + below(4), {}, {}};
      std::size_t rows = 1;
      for (std::size_t tries = below(4); tries > 0 && v > 0; --tries) {
        const std::size_t parent = below(v);
        if (std::find(node.parents.begin(), node.parents.end(), parent) != node.parents.end()) continue;
        node.parents.push_back(parent);
        rows *= world.network.nodes[parent].size;
      }
      for (; rows > 0; --rows) node.rows.push_back(normalized_numbers(random, node.by, node.size));
      world.network.nodes.push_back(node);
    }
    world.weights = plain::no_evidence(world.network);
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t size = world.network.nodes[v].size;
      const std::size_t choice = below(6);
      if (choice == 0) {
        world.seen.push_back(v);
        world.weights[v].assign(size, 0.0);
        world.weights[v][below(size)] = 1.0;
      } else if (choice == 1) {
        world.weighed.push_back(v);
        world.weights[v] = unit_numbers(random, size);
      }
      if (below(4) == 0)
        world.asked.insert(world.asked.begin() + static_cast<std::ptrdiff_t>(below(world.asked.size() + 1)), v);
    }
    return world;
  });
}

std::string name_of(std::size_t v) { return "v" + std::to_string(v); }

NetworkVariable variable_of(const World& world, std::size_t v) {
  const auto& node = world.network.nodes[v];
  if (node.by == By::sum) return RandomVariable{name_of(v), node.size};
  return FuzzyVariable{name_of(v), node.size};
}

RelationNetwork network_of(const World& world) {
  RelationNetwork network;
  for (std::size_t v = 0; v < world.network.nodes.size(); ++v) {
    std::vector<NetworkVariable> parents;
    for (const std::size_t parent : world.network.nodes[v].parents) parents.push_back(variable_of(world, parent));
    network.declare(variable_of(world, v), parents, world.network.nodes[v].rows);
  }
  return network;
}

Evidence evidence_of(const World& world) {
  Evidence evidence;
  for (const std::size_t v : world.seen) {
    const auto& weights = world.weights[v];
    evidence.observe(name_of(v), std::to_string(std::find(weights.begin(), weights.end(), 1.0) - weights.begin()));
  }
  for (const std::size_t v : world.weighed)
    variable_of(world, v).visit(
        [&](const auto& variable) { evidence.observe(Likelihood(variable, world.weights[v])); });
  return evidence;
}

std::vector<std::string> names_of(const std::vector<std::size_t>& vertices) {
  std::vector<std::string> names;
  for (const std::size_t v : vertices) names.push_back(name_of(v));
  return names;
}

/// Relative, at any scale: zeros are zeros, and logarithms agree.
void require_same(ScaledNumber found, long double expected) {
  RC_ASSERT(found.is_zero() == (expected == 0));
  if (expected > 0) RC_ASSERT(std::abs(found.log() - static_cast<double>(std::log(expected))) <= 1e-9);
}

/// ⊕ of the numbers of `asked`, the one declared last innermost.
long double total_of(const World& world, const std::vector<std::size_t>& asked,
                     const std::vector<long double>& values) {
  plain::Function function{asked, values};
  auto innermost_first = asked;
  std::sort(innermost_first.rbegin(), innermost_first.rend());
  for (const std::size_t v : innermost_first) {
    auto scope = function.scope;
    scope.erase(std::find(scope.begin(), scope.end(), v));
    scope.push_back(v);
    const auto ordered = plain::product(world.network, {function}, scope);
    scope.pop_back();
    function = {scope, {}};
    const auto size = static_cast<std::ptrdiff_t>(world.network.nodes[v].size);
    for (auto at = ordered.begin(); at != ordered.end(); at += size)
      function.values.push_back(plain::eliminate(world.network.nodes[v].by, {at, at + size}));
  }
  return function.values.front();
}

void query_is_enumeration(Kinds kinds) {
  const World world = any_world(kinds);
  RC_LOG() << world;
  const RelationNetwork network = network_of(world);
  const Evidence evidence = evidence_of(world);
  const auto expected = plain::enumerate(world.network, world.weights, world.asked);
  const long double total = total_of(world, world.asked, expected);
  const long double likelihood = plain::enumerate(world.network, world.weights, {}).front();
  RC_CLASSIFY(total == 0, "excluded");
  if (total == 0) {
    RC_ASSERT_THROWS_AS(query(network, names_of(world.asked), evidence), std::domain_error);
    return;
  }
  const NetworkAnswer answer = query(network, names_of(world.asked), evidence);
  RC_ASSERT(answer.values().size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) require_same(answer.values()[i], expected[i]);
  require_same(answer.total(), total);
  const auto normalized = answer.normalized();
  for (std::size_t i = 0; i < expected.size(); ++i)
    require_near(normalized[i], static_cast<double>(expected[i] / total));
  RC_CLASSIFY(answer.induced(), "induced");
  RC_CLASSIFY(answer.elimination().forced, "forced");
  if (!answer.induced()) require_same(answer.total(), likelihood);
  if (kinds != Kinds::mixed) RC_ASSERT(!answer.induced() && !answer.elimination().forced);
}

PROPERTY(NetworkLaws, AQueryOfRandomVariablesIsTheEnumeration) { query_is_enumeration(Kinds::random); }
PROPERTY(NetworkLaws, AQueryOfFuzzyVariablesIsTheEnumeration) { query_is_enumeration(Kinds::fuzzy); }
PROPERTY(NetworkLaws, AQueryOfMixedVariablesIsTheEnumerationInnermostFirst) { query_is_enumeration(Kinds::mixed); }

/// Of all variables at once; induced where the single query is.
void marginals_are_enumerations(Kinds kinds) {
  const World world = any_world(kinds);
  RC_LOG() << world;
  const RelationNetwork network = network_of(world);
  const Evidence evidence = evidence_of(world);
  if (plain::enumerate(world.network, world.weights, {}).front() == 0) {
    RC_ASSERT_THROWS_AS(marginals(network, evidence), std::domain_error);
    return;
  }
  const auto answers = marginals(network, evidence);
  RC_ASSERT(answers.size() == network.size());
  for (std::size_t v = 0; v < network.size(); ++v) {
    const auto expected = plain::enumerate(world.network, world.weights, {v});
    RC_ASSERT(answers[v].variables()[0] == network[v].variable);
    RC_ASSERT(answers[v].values().size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) require_same(answers[v].values()[i], expected[i]);
    require_same(answers[v].total(), total_of(world, {v}, expected));
    RC_ASSERT(answers[v].induced() == query(network, {name_of(v)}, evidence).induced());
    RC_CLASSIFY(answers[v].induced(), "induced");
  }
}

PROPERTY(NetworkLaws, TheMarginalsOfRandomVariablesAreEnumerations) { marginals_are_enumerations(Kinds::random); }
PROPERTY(NetworkLaws, TheMarginalsOfFuzzyVariablesAreEnumerations) { marginals_are_enumerations(Kinds::fuzzy); }
PROPERTY(NetworkLaws, TheMarginalsOfMixedVariablesAreEnumerationsInnermostFirst) {
  marginals_are_enumerations(Kinds::mixed);
}

PROPERTY(NetworkLaws, TheTotalWithoutEvidenceIsOne) {
  const World world = any_world(Kinds::mixed);
  RC_LOG() << world;
  const RelationNetwork network = network_of(world);
  require_near(query(network, {}).total().value(), 1.0);
  const NetworkAnswer answer = query(network, names_of(world.asked));
  if (!answer.induced()) require_near(answer.total().value(), 1.0);
}

void explanation_is_the_maximum(Kinds kinds) {
  const World world = any_world(kinds);
  RC_LOG() << world;
  std::vector<std::size_t> all;
  for (std::size_t v = 0; v < world.network.nodes.size(); ++v) all.push_back(v);
  long double greatest = 0;
  plain::for_each_outcome(world.network, all, [&](const std::vector<std::size_t>& outcomes) {
    greatest = std::max(greatest, plain::joint(world.network, world.weights, outcomes));
  });
  const RelationNetwork network = network_of(world);
  const Evidence evidence = evidence_of(world);
  if (greatest == 0) {
    RC_ASSERT_THROWS_AS(most_likely_explanation(network, evidence), std::domain_error);
    return;
  }
  const Explanation found = most_likely_explanation(network, evidence);
  require_near(found.log_value, static_cast<double>(std::log(greatest)));
  require_near(static_cast<double>(std::log(plain::joint(world.network, world.weights, found.outcomes))),
               static_cast<double>(std::log(greatest)));
}

PROPERTY(NetworkLaws, TheExplanationOfRandomVariablesIsTheGreatestOfAll) { explanation_is_the_maximum(Kinds::random); }
PROPERTY(NetworkLaws, TheExplanationOfFuzzyVariablesIsTheGreatestOfAll) { explanation_is_the_maximum(Kinds::fuzzy); }
PROPERTY(NetworkLaws, TheExplanationOfMixedVariablesIsTheGreatestOfAll) { explanation_is_the_maximum(Kinds::mixed); }

/// The joint over the marginal of the condition, and ⊕ one in each row unless it is induced.
void composition_is_the_conditional(Kinds kinds) {
  const World world = any_world(kinds);
  RC_LOG() << world;
  const std::size_t n = world.network.nodes.size();
  RC_PRE(n > 1);
  const auto from = *rc::gen::inRange<std::size_t>(0, n);
  const auto to = (from + *rc::gen::inRange<std::size_t>(1, n)) % n;
  const auto none = plain::no_evidence(world.network);
  const auto joint = plain::enumerate(world.network, none, {from, to});
  const auto marginal = plain::enumerate(world.network, none, {from});
  const ComposedRelation found = compose(network_of(world), name_of(from), name_of(to));
  const std::size_t columns = world.network.nodes[to].size;
  for (std::size_t r = 0; r < marginal.size(); ++r) {
    std::vector<long double> row;
    for (std::size_t c = 0; c < columns; ++c) row.push_back(static_cast<long double>(found.table()(r, c)));
    if (!found.induced()) require_near(static_cast<double>(plain::eliminate(world.network.nodes[to].by, row)), 1.0);
    if (marginal[r] == 0) continue;
    for (std::size_t c = 0; c < columns; ++c)
      require_near(found.table()(r, c), static_cast<double>(joint[r * columns + c] / marginal[r]));
  }
  if (kinds != Kinds::mixed) RC_ASSERT(!found.induced());
}

PROPERTY(NetworkLaws, ACompositionOfRandomVariablesIsTheConditional) { composition_is_the_conditional(Kinds::random); }
PROPERTY(NetworkLaws, ACompositionOfFuzzyVariablesIsTheConditional) { composition_is_the_conditional(Kinds::fuzzy); }
PROPERTY(NetworkLaws, ACompositionOfMixedVariablesIsTheConditional) { composition_is_the_conditional(Kinds::mixed); }

}  // namespace network_test
