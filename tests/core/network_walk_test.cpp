#include "support/core.hpp"

/// The worked example of docs/networks.md.
namespace network_walk_test {

TEST(NetworkWalk, IsWhatTheDocumentSays) {
  const FuzzyVariable age{"age", {"young", "middle", "old"}};
  const FuzzyVariable mood{"mood", {"calm", "wild"}};
  const RandomVariable speed{"speed", {"slow", "fast"}};

  RelationNetwork network;
  network.declare(Distribution{age, {1.0, 1.0, 0.5}});
  network.declare(Relation{mood, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}});
  network.declare(Relation{speed, mood, {{0.9, 0.1}, {0.3, 0.7}}});

  const NetworkAnswer who = query(network, {"age"}, Evidence{{"speed", "fast"}});
  EXPECT_FALSE(who.induced());
  EXPECT_CLOSE(who.total().value(), 0.7, 1e-15);
  EXPECT_CLOSE(who.normalized<Fuzzy>().values(), (std::vector{1.0, 0.6, 0.1}), 1e-15);
  EXPECT_EQ(who.elimination().order, std::vector<std::string>{"mood"});
  EXPECT_EQ(who.elimination().greatest_table, 6.0);

  const NetworkAnswer how_fast = query(network, {"speed"});
  EXPECT_TRUE(how_fast.induced());
  EXPECT_CLOSE(how_fast.values()[0].value(), 0.9, 1e-15);
  EXPECT_CLOSE(how_fast.values()[1].value(), 0.7, 1e-15);
  EXPECT_CLOSE(how_fast.total().value(), 1.6, 1e-15);
  EXPECT_CLOSE(how_fast.normalized<Random>().values(), (std::vector{0.5625, 0.4375}), 1e-15);

  const ComposedRelation speed_given_age = compose(network, "age", "speed");
  EXPECT_TRUE(speed_given_age.induced());
  EXPECT_CLOSE(speed_given_age.table().values(), (std::vector{0.3, 0.7, 0.9, 0.42, 0.9, 0.14}), 1e-15);

  const double certain = necessity(network, Event{age, {"young"}}, Evidence{{"speed", "fast"}});
  EXPECT_CLOSE(certain, 0.4, 1e-15);

  const Explanation best = most_likely_explanation(network, Evidence{{"speed", "fast"}});
  EXPECT_EQ(best["age"] + ", " + best["mood"], "young, wild");
  EXPECT_CLOSE(best.log_value, std::log(0.7), 1e-15);

  RelationNetwork by_both;
  by_both.declare(uninformative(age));
  by_both.declare(uninformative(mood));
  by_both.declare(speed, {age, mood}, {{0.9, 0.1}, {0.5, 0.5}, {0.8, 0.2}, {0.3, 0.7}, {1.0, 0.0}, {0.6, 0.4}});
  const NetworkAnswer whose = query(by_both, {"age"}, Evidence{{"speed", "fast"}});
  std::ostringstream printed;
  printed << whose.normalized<Fuzzy>() << '\n' << whose.total() << '\n' << best;
  EXPECT_EQ(printed.str(), "age: young 0.714286, middle 1, old 0.571429\n0.7\nage young, mood wild, speed fast: 0.7");
}

}  // namespace network_walk_test
