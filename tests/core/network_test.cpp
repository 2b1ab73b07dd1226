#include "core/network_grid.hpp"

namespace network_test {

const FuzzyVariable age{"age", {"young", "old"}};
const FuzzyVariable mood{"mood", {"calm", "wild"}};
const RandomVariable speed{"speed", {"slow", "fast", "mad"}};
const Relation<Fuzzy, Fuzzy> mood_given_age{mood, age, {{0.3, 1.0}, {1.0, 0.6}}};
const std::vector<std::vector<double>> speed_rows{{0.9, 0.1, 0.0}, {0.2, 0.5, 0.3}, {0.8, 0.2, 0.0}, {0.3, 0.6, 0.1}};

static_assert(std::copyable<RelationNetwork>);
static_assert(!std::constructible_from<NetworkVariable, Outcomes>);

RelationNetwork three() {
  RelationNetwork network = network_of(uninformative(age), mood_given_age);
  network.declare(speed, {age, mood}, speed_rows);
  return network;
}

TEST(RelationNetwork, HoldsDistributionsRelationsAndTablesAsTheyWereDeclared) {
  const RelationNetwork network = three();
  ASSERT_EQ(network.size(), 3U);
  EXPECT_EQ(network[1].variable, NetworkVariable{mood});
  EXPECT_EQ(network[1].parents, std::vector<std::size_t>{0});
  EXPECT_EQ(network[1].table()(1, 1), 0.6);
  EXPECT_EQ(network[2].parents, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(network[2].table().rows(), 4U);
  EXPECT_EQ(network[2].table()(1, 2), 0.3);  // young and wild
  EXPECT_EQ(network.index_of("speed"), 2U);
  EXPECT_EQ(network.index_of(mood), 1U);
}

TEST(RelationNetwork, KnowsTheKindsOfItsVariables) {
  const RelationNetwork network = three();
  EXPECT_TRUE(network[0].variable.is<Fuzzy>());
  EXPECT_FALSE(network[0].variable.is<Random>());
  EXPECT_EQ(network[2].variable.kind_name(), "random");
  EXPECT_EQ(network[2].variable.as<Random>(), speed);
  EXPECT_INVALID(("'speed'", "random", "fuzzy"), network[2].variable.as<Fuzzy>());
}

TEST(RelationNetwork, RefusesWhatItDoesNotHold) {
  const RelationNetwork network = three();
  EXPECT_INVALID(("no variable 'sped'"), network.index_of("sped"));
  EXPECT_INVALID(("'mood'", "fuzzy", "random"), network.index_of(RandomVariable{"mood", {"calm", "wild"}}));
  EXPECT_INVALID(("'mood' whose outcome 1 is 'wild'", "'mood' whose outcome 1 is 'odd'"),
                 network.index_of(FuzzyVariable{"mood", {"calm", "odd"}}));
}

TEST(RelationNetwork, CannotBeGivenACycle) {
  RelationNetwork network;
  const Relation itself{age, age, {{1.0, 0.5}, {0.5, 1.0}}};
  EXPECT_INVALID(("'age'", "'age'", "before"), network.declare(itself));
  network.declare(uninformative(age));
  EXPECT_INVALID(("'age'", "twice"), network.declare(itself));
  network.declare(mood_given_age);
  const Relation back{age, mood, {{1.0, 0.5}, {0.5, 1.0}}};
  EXPECT_INVALID(("'age'", "twice"), network.declare(back));
  EXPECT_EQ(network.size(), 2U);
}

TEST(RelationNetwork, RefusesAParentTwiceOrOfAnotherKindOrWithOtherOutcomes) {
  RelationNetwork network;
  network.declare(uninformative(age));
  EXPECT_INVALID(("'speed'", "'age'", "twice"), network.declare(speed, {age, age}, speed_rows));
  EXPECT_INVALID(("'age'", "fuzzy", "random"),
                 network.declare(mood, {RandomVariable{"age", {"young", "old"}}}, {{1.0, 0.5}, {0.5, 1.0}}));
  EXPECT_INVALID(("'age' whose outcome 1 is 'old'", "'grey'"),
                 network.declare(mood, {FuzzyVariable{"age", {"young", "grey"}}}, {{1.0, 0.5}, {0.5, 1.0}}));
}

TEST(RelationNetwork, NamesVariableRowAndValueOfABadTable) {
  RelationNetwork network = three();
  const RandomVariable lamp{"lamp", {"off", "on"}};
  EXPECT_INVALID(("'lamp'", "4 rows", "1 "), network.declare(lamp, {mood, age}, {{1.0, 0.0}}));
  EXPECT_INVALID(("sum", "'lamp'", "(mood, age)", "(wild, young)", "0.9"),
                 network.declare(lamp, {mood, age}, {{1.0, 0.0}, {1.0, 0.0}, {0.5, 0.4}, {1.0, 0.0}}));
  EXPECT_INVALID(("'lamp'", "(mood, age)", "(calm, old)", "'off'", "1.5"),
                 network.declare(lamp, {mood, age}, {{1.0, 0.0}, {1.5, -0.5}, {0.5, 0.5}, {1.0, 0.0}}));
  EXPECT_INVALID(("'lamp'", "(wild, old)", "2 outcomes", "3 values"),
                 network.declare(lamp, {mood, age}, {{1.0, 0.0}, {1.0, 0.0}, {0.5, 0.5}, {1.0, 0.0, 0.0}}));
  EXPECT_INVALID(("sum", "'lamp'", "mood = 'wild'", "1.1"), network.declare(lamp, {mood}, {{1.0, 0.0}, {0.5, 0.6}}));
  EXPECT_INVALID(("'lamp'", "0.9"), network.declare(lamp, {}, {{0.5, 0.4}}));
  const FuzzyVariable glow{"glow", {"off", "on"}};
  EXPECT_INVALID(("maximum", "'glow'", "0.5"), network.declare(glow, {}, {{0.5, 0.4}}));
  EXPECT_EQ(network.size(), 3U);
}

TEST(RelationNetwork, IsMadeFuzzyRowByRow) {
  const RandomVariable a{"a", 2}, b{"b", {"x", "y"}};
  const RelationNetwork network = network_of(Distribution{a, {0.2, 0.8}}, Relation{b, a, {{0.5, 0.5}, {0.9, 0.1}}});
  const RelationNetwork fuzzy = as_fuzzy(network, RatioScale{});
  EXPECT_EQ(fuzzy[0].variable, NetworkVariable(FuzzyVariable{"a", 2}));
  EXPECT_EQ(fuzzy[1].variable, NetworkVariable(FuzzyVariable{"b", {"x", "y"}}));
  EXPECT_EQ(fuzzy[1].parents, std::vector<std::size_t>{0});
  EXPECT_CLOSE(fuzzy[0].table().values(), (std::vector{0.25, 1.0}), 1e-15);
  EXPECT_CLOSE(fuzzy[1].table().values(), (std::vector{1.0, 1.0, 1.0, 1.0 / 9.0}), 1e-15);
}

TEST(RelationNetwork, IsMadeFuzzyWhereNamedAndByAnyTransform) {
  const RandomVariable a{"a", 2}, b{"b", 2};
  const RelationNetwork network = network_of(Distribution{a, {0.2, 0.8}}, Relation{b, a, {{0.5, 0.5}, {0.9, 0.1}}});
  const RowTransform halves = [](std::span<const double> row) { return std::vector<double>(row.size(), 0.5); };
  const RelationNetwork mixed = as_fuzzy(network, halves, {"b"});
  EXPECT_EQ(mixed[0].variable, NetworkVariable{a});
  EXPECT_CLOSE(mixed[0].table().values(), (std::vector{0.2, 0.8}), 0.0);
  EXPECT_TRUE(mixed[1].variable.is<Fuzzy>());
  EXPECT_CLOSE(mixed[1].table().values(), (std::vector{1.0, 1.0, 1.0, 1.0}), 0.0);
  EXPECT_EQ(as_fuzzy(mixed, halves)[1].variable, mixed[1].variable);  // fuzzy ones stay as they are

  const RowTransform nothing = [](std::span<const double> row) { return std::vector<double>(row.size(), 0.0); };
  EXPECT_INVALID(("'a'", "zero"), as_fuzzy(network, nothing));
  EXPECT_INVALID(("'c'"), as_fuzzy(network, halves, {"c"}));
  EXPECT_INVALID(("'b'", "fuzzy", "random"), as_fuzzy(mixed, halves, {"b"}));
}

TEST(RelationNetwork, IsDrawnByGraphviz) {
  RelationNetwork network = three();
  network.declare(Distribution{RandomVariable{"odd \"name\"", 1}, {1.0}});
  std::ostringstream out;
  write_graphviz(out, network);
  EXPECT_EQ(out.str(),
            "digraph G {\n"
            "0[label=age, shape=box];\n"
            "1[label=mood, shape=box];\n"
            "2[label=speed, shape=ellipse];\n"
            "3[label=\"odd \\\"name\\\"\", shape=ellipse];\n"
            "0->1 ;\n"
            "0->2 ;\n"
            "1->2 ;\n"
            "}\n");
}

}  // namespace network_test
