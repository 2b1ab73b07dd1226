#include "core/network_grid.hpp"

namespace network_marginals_test {

TEST(NetworkMarginals, OfOneVariable) {
  RelationNetwork network;
  const FuzzyVariable a{"a", 3};
  network.declare(Distribution{a, {0.25, 1.0, 0.0}});
  expect_single_queries(network, {});
  expect_single_queries(network, Evidence{}.observe(Likelihood{a, {0.5, 0.25, 1.0}}));
  const auto seen = marginals(network, {{"a", "0"}});
  EXPECT_EQ(seen[0].total().value(), 0.25);
  EXPECT_EQ(seen[0].normalized(), (std::vector{1.0, 0.0, 0.0}));
  EXPECT_REFUSED(std::domain_error, ("a = '2'"), marginals(network, {{"a", "2"}}));
  EXPECT_TRUE(marginals(RelationNetwork{}).empty());
}

TEST(NetworkMarginals, NameTheEvidenceThatExcludesEverything) {
  const FuzzyVariable a{"a", 2}, b{"b", 2}, c{"c", 2};
  const RelationNetwork network =
      network_of(uninformative(a), Relation{b, a, {{1.0, 0.0}, {0.0, 1.0}}}, Relation{c, b, {{1.0, 0.0}, {0.0, 1.0}}});
  EXPECT_REFUSED(std::domain_error, ("a = '0'", "c = '1'"), marginals(network, {{"a", "0"}, {"c", "1"}}));
  // Here only the tree finds out.
  const Evidence soft = Evidence{}
                            .observe(Likelihood{a, {0.5, 0.0}})
                            .observe(Likelihood{b, {0.5, 0.5}})
                            .observe(Likelihood{c, {0.0, 0.5}});
  EXPECT_REFUSED(std::domain_error, ("likelihood of a", "likelihood of c"), marginals(network, soft));
}

TEST(NetworkMarginals, KeepNumbersThatNoDoubleHoldsTogether) {
  // Every report makes one outcome of the hub 2⁻¹⁰⁰ times as possible as the other.
  const std::size_t reports = 40;
  const FuzzyVariable hub{"hub", 2};
  RelationNetwork network;
  network.declare(uninformative(hub));
  Evidence evidence;
  for (std::size_t k = 0; k < reports; ++k) {
    const FuzzyVariable sign{"sign" + std::to_string(k), 2}, report{"report" + std::to_string(k), 2};
    network.declare(Relation{sign, hub, {{1.0, 0.5}, {0x1p-100, 1.0}}});
    network.declare(Relation{report, sign, {{1.0, 0.5}, {1.0, 0x1p-200}}});
    evidence.observe(report.name(), "1");
  }
  const auto all = marginals(network, evidence);
  // sign 0: ½ · 1, or 2⁻¹⁰⁰ · ½ under the other outcome of the hub; sign 1 has 2⁻²⁰⁰ less.
  EXPECT_EQ(all[0].values()[0], (ScaledNumber{1.0, -static_cast<std::int64_t>(reports)}));
  EXPECT_EQ(all[0].values()[1], (ScaledNumber{1.0, -101 * static_cast<std::int64_t>(reports)}));
  EXPECT_EQ(all[0].normalized()[1], 0.0);  // which as a double is zero
  expect_single_queries(network, evidence);
}

TEST(NetworkMarginals, OfDifferentKindsShareATreeWhereTheOrderAllows) {
  // The random variables are declared outside the fuzzy ones that report on them: those go first, once for all.
  RelationNetwork network;
  Evidence evidence;
  for (std::size_t k = 0; k < 6; ++k) {
    const RandomVariable state{name(k), 2};
    if (k == 0)
      network.declare(Distribution{state, {0.25, 0.75}});
    else
      network.declare(Relation{state, RandomVariable{name(k - 1), 2}, {{0.75, 0.25}, {0.125, 0.875}}});
  }
  for (std::size_t k = 0; k < 6; k += 2) {
    const FuzzyVariable mood{"mood" + std::to_string(k), 3};
    network.declare(mood, {network[k].variable, network[k + 1].variable},
                    {{1.0, 0.5, 0.25}, {0.5, 1.0, 0.5}, {0.0, 0.5, 1.0}, {0.125, 1.0, 1.0}});
    network.declare(
        Relation{FuzzyVariable{"report" + std::to_string(k), 2}, mood, {{1.0, 0.25}, {0.5, 1.0}, {1.0, 0.0}}});
    evidence.observe("report" + std::to_string(k), "1");
  }
  expect_single_queries(network, evidence);
  expect_single_queries(network, {});
  const auto all = marginals(network, evidence);
  for (std::size_t v = 0; v < network.size(); ++v) {
    const bool is_mood = network[v].variable.name().starts_with("mood");
    EXPECT_EQ(all[v].induced(), is_mood) << network[v].variable.name();
    // A tree of cliques tells no order, and the moods are as many queries.
    EXPECT_EQ(all[v].elimination().order.empty(), !is_mood);
  }
}

TEST(NetworkMarginals, AreAnsweredWhereOnlyTheTreeIsTooLarge) {
  // Each pair of 24 coins has a child: together they join all coins, but a single query has only the two.
  const std::size_t coins = 24;
  RelationNetwork network;
  for (std::size_t k = 0; k < coins; ++k) network.declare(uninformative(RandomVariable{name(k), 2}));
  for (std::size_t a = 0; a < coins; ++a)
    for (std::size_t b = a + 1; b < coins; ++b)
      network.declare(RandomVariable{name(a) + " " + name(b), 2}, {network[a].variable, network[b].variable},
                      {{1.0, 0.0}, {0.5, 0.5}, {0.5, 0.5}, {0.25, 0.75}});
  const auto all = marginals(network, {}, 1 << 20);
  EXPECT_EQ(all[0].values()[0].value(), 0.5);
  EXPECT_EQ(all.back().values()[0].value(), 0.5625);
}

}  // namespace network_marginals_test
