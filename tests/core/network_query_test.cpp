#include "core/age_mood_speed.hpp"
#include "core/network_grid.hpp"

namespace network_query_test {

RelationNetwork chain() { return network_of(Distribution{age, {1.0, 1.0, 0.5}}, mood_given_age, speed_given_mood); }

std::vector<double> numbers(const NetworkAnswer& answer) {
  std::vector<double> result;
  for (const ScaledNumber value : answer.values()) result.push_back(value.value());
  return result;
}

TEST(NetworkQuery, AnswersInTheOrderAskedFor) {
  const auto forwards = query(chain(), {"mood", "speed"}), backwards = query(chain(), {"speed", "mood"});
  EXPECT_EQ((forwards[{"wild", "slow"}]), (backwards[{"slow", "wild"}]));
  EXPECT_EQ((forwards[{"calm", "fast"}]), (backwards[{"fast", "calm"}]));
  EXPECT_EQ(forwards.total(), backwards.total());
}

TEST(NetworkQuery, OfWhatIsKnownIsNotInduced) {  // speed is random within fuzzy variables, but nothing is left to sum
  const auto answer = query(chain(), {"speed"}, {{"speed", "fast"}});
  EXPECT_FALSE(answer.induced());
  EXPECT_CLOSE(numbers(answer), (std::vector{0.0, 0.7}), 1e-15);
  EXPECT_EQ(answer.total(), query(chain(), {}, {{"speed", "fast"}}).total());
  EXPECT_TRUE(query(chain(), {"speed"}, {{"age", "old"}}).induced());
  EXPECT_CLOSE(query(chain(), {"speed"}).likelihood<Random>()["fast"], 0.7, 1e-15);
}

TEST(NetworkQuery, NamesTheEvidenceThatExcludesEverything) {
  const FuzzyVariable a{"a", 2}, b{"b", 2};
  const RelationNetwork network = network_of(uninformative(a), Relation{b, a, {{1.0, 0.0}, {0.0, 1.0}}});
  EXPECT_REFUSED(std::domain_error, ("a = '0'", "b = '1'"), query(network, {"a"}, {{"a", "0"}, {"b", "1"}}));
  EXPECT_REFUSED(std::domain_error, ("a = '0'", "a = '1'"), query(network, {}, {{"a", "0"}, {"a", "1"}}));
  EXPECT_REFUSED(std::domain_error, ("likelihood of b"),
                 query(network, {}, Evidence{}.observe(Likelihood{b, {0.0, 0.0}})));
  EXPECT_REFUSED(std::domain_error, ("a = '0'", "b = '1'"), most_likely_explanation(network, {{"a", "0"}, {"b", "1"}}));
}

TEST(NetworkQuery, DoesNotTakeWhatIsTooSmallForADoubleForExcluded) {
  const FuzzyVariable a{"a", 2};
  RelationNetwork network;
  network.declare(uninformative(a));
  Evidence evidence;
  for (int i = 0; i < 5; ++i) {
    const FuzzyVariable b{"b" + std::to_string(i), 2};
    network.declare(Relation{b, a, {{1.0, 2 * least_subnormal}, {1.0, least_subnormal}}});
    evidence.observe(b.name(), "1");
  }
  const auto answer = query(network, {"a"}, evidence);
  EXPECT_CLOSE(answer.normalized(), (std::vector{1.0, 1.0 / 32.0}), 0.0);
  EXPECT_CLOSE(answer.total().log(), 5 * -1073 * std::log(2.0), 1e-14);
}

TEST(NetworkQuery, RefusesWhatTheNetworkDoesNotHave) {
  const auto network = chain();
  EXPECT_INVALID(("'sped'"), query(network, {"sped"}));
  EXPECT_INVALID(("'age'", "twice"), query(network, {"age", "mood", "age"}));
  EXPECT_INVALID(("'sped'"), query(network, {}, {{"sped", "fast"}}));
  EXPECT_INVALID(("'speed'", "'fats'"), query(network, {}, {{"speed", "fats"}}));
  EXPECT_INVALID(("'mood'", "fuzzy", "random"),
                 query(network, {}, Evidence{}.observe(Likelihood{RandomVariable{"mood", {"calm", "wild"}}})));
  const auto answer = query(network, {"age", "speed"});
  EXPECT_INVALID(("2 variables", "1 outcomes"), answer[{"old"}]);
  EXPECT_INVALID(("'speed'", "'fats'"), (answer[{"old", "fats"}]));
  EXPECT_INVALID(("2 variables"), answer.normalized<Fuzzy>());
  EXPECT_INVALID(("'age'", "fuzzy", "random"), query(network, {"age"}).normalized<Random>());
}

/// Leaves p, q and r, a separate fuzzy variable, and a hub that a sensor each joins to the leaves. All sensors were
/// read.
NetworkAnswer read_sensors_of_hub(const NetworkVariable& hub) {
  RelationNetwork network;
  std::vector<NetworkVariable> leaves;
  for (const char* const name : {"p", "q", "r"}) {
    leaves.emplace_back(RandomVariable{name, 4});
    network.declare(leaves.back(), {}, {{0.25, 0.25, 0.25, 0.25}});
  }
  const FuzzyVariable apart{"apart", 2};
  network.declare(Distribution{apart, {1.0, 0.5}});
  network.declare(hub, {}, {hub.is<Fuzzy>() ? std::vector{1.0, 1.0} : std::vector{0.5, 0.5}});
  Evidence evidence;
  evidence.observe(Likelihood{apart, {0.25, 0.375}});
  for (const auto& leaf : leaves) {
    const RandomVariable sensor{"sensor of " + leaf.name(), 2};
    network.declare(sensor, {leaf, hub}, std::vector<std::vector<double>>(8, {0.5, 0.5}));
    evidence.observe(sensor.name(), "0");
  }
  return query(network, {}, evidence);
}

TEST(NetworkQuery, SaysWhatItsKindsCost) {
  const auto answer = read_sensors_of_hub(FuzzyVariable{"hub", 2});
  const Elimination& elimination = answer.elimination();
  EXPECT_CLOSE(answer.total().value(), 0.25 * 0.125, 1e-15);
  // The leaves were declared outside the hub and are of another kind: it has to go first, and joins them all.
  EXPECT_TRUE(elimination.forced);
  EXPECT_LT(std::find(elimination.order.begin(), elimination.order.end(), "hub"),
            std::find(elimination.order.begin(), elimination.order.end(), "r"));
  EXPECT_EQ(elimination.greatest_table, 4.0 * 4.0 * 4.0 * 2.0);
  EXPECT_EQ(elimination.greatest_table_if_one_kind, 4.0 * 2.0);
}

TEST(NetworkQuery, ExchangesEliminationsOfOneKindAndPassesWhatNothingJoins) {
  const auto answer = read_sensors_of_hub(RandomVariable{"hub", 2});
  const Elimination& elimination = answer.elimination();
  EXPECT_CLOSE(answer.total().value(), 0.25 * 0.125, 1e-15);
  EXPECT_FALSE(elimination.forced);
  EXPECT_EQ(elimination.greatest_table, 4.0 * 2.0);  // each leaf alone with the hub, past `apart`
  EXPECT_EQ(elimination.greatest_table_if_one_kind, 4.0 * 2.0);
}

TEST(NetworkQuery, DoesNotPassAVariableThatIsJoinedOnlyFromWithin) {
  // b and d are fuzzy, c is random; nothing has both b and c, but d, declared within both, meets either.
  const FuzzyVariable b{"b", 2}, d{"d", 2};
  const RandomVariable c{"c", 2};
  const double bd[2][2] = {{1.0, 0.25}, {0.25, 1.0}}, cd[2][2] = {{0.75, 0.125}, {0.125, 0.75}};
  RelationNetwork network = network_of(uninformative(b), uninformative(c), uninformative(d));
  const FuzzyVariable seen_b{"seen b", 2}, seen_c{"seen c", 2};
  network.declare(seen_b, {b, d}, {{1.0, bd[0][0]}, {1.0, bd[0][1]}, {1.0, bd[1][0]}, {1.0, bd[1][1]}});
  network.declare(seen_c, {c, d}, {{1.0, cd[0][0]}, {1.0, cd[0][1]}, {1.0, cd[1][0]}, {1.0, cd[1][1]}});
  double expected = 0.0;
  for (int i = 0; i < 2; ++i) {
    double sum = 0.0;
    for (int j = 0; j < 2; ++j) sum += 0.5 * std::max(bd[i][0] * cd[j][0], bd[i][1] * cd[j][1]);
    expected = std::max(expected, sum);
  }
  const auto answer = query(network, {}, {{"seen b", "1"}, {"seen c", "1"}});
  EXPECT_CLOSE(answer.total().value(), expected, 1e-15);  // with b before c it would be 0.75
  EXPECT_EQ(answer.elimination().order, (std::vector<std::string>{"d", "c", "b"}));
}

TEST(NetworkMeasure, OfAnEventOfVariablesTogether) {
  const auto wild_or_old = [](std::span<const std::size_t> at) { return at[0] == 2 || at[1] == 1; };
  const NetworkAnswer answer = query(chain(), {"age", "mood"}, {{"speed", "slow"}});
  // joint in proportion to young (0.27, 0.3), middle (0.9, 0.18), old (0.45, 0.03)
  EXPECT_CLOSE(possibility(answer, wild_or_old), 0.5, 1e-15);
  EXPECT_EQ(necessity(answer, wild_or_old), 0.0);
  EXPECT_CLOSE(necessity(answer, [](auto at) { return at[0] == 1; }), 0.5, 1e-15);
  EXPECT_INVALID(("'age'", "fuzzy", "random"), probability(answer, wild_or_old));
  const NetworkAnswer both = query(chain(), {"age", "speed"});
  EXPECT_INVALID(("'speed'", "random", "fuzzy"), possibility(both, wild_or_old));

  const RandomVariable a{"a", 2}, b{"b", 2};
  const RelationNetwork network =
      network_of(Distribution{a, {0.25, 0.75}}, Relation{b, a, {{0.5, 0.5}, {0.125, 0.875}}});
  const auto same = [](std::span<const std::size_t> at) { return at[0] == at[1]; };
  EXPECT_CLOSE(probability(query(network, {"a", "b"}), same), 0.125 + 0.75 * 0.875, 1e-15);
}

TEST(NetworkCompose, OfOneKindIsARelation) {
  const ComposedRelation itself = compose(chain(), "age", "mood");
  EXPECT_FALSE(itself.induced());
  EXPECT_CLOSE(itself.table().values(), mood_given_age.table().values(), 0.0);
  EXPECT_TRUE((std::holds_alternative<Relation<Fuzzy, Fuzzy>>(itself.relation<Fuzzy, Fuzzy>())));
  EXPECT_INVALID(("'mood'", "fuzzy", "random"), itself.relation<Random, Fuzzy>());
  const ComposedRelation induced = compose(chain(), "age", "speed");
  EXPECT_TRUE((std::holds_alternative<Induced<Relation<Random, Fuzzy>>>(induced.relation<Random, Fuzzy>())));
}

TEST(NetworkCompose, OfWhatHasNothingToDoWithEachOtherRepeatsTheMarginal) {
  RelationNetwork network = chain();
  network.declare(Distribution{FuzzyVariable{"moon", 2}, {1.0, 0.25}});
  EXPECT_CLOSE(compose(network, "age", "moon").table().values(), (std::vector{1.0, 0.25, 1.0, 0.25, 1.0, 0.25}), 0.0);
  EXPECT_INVALID(("'age'", "twice"), compose(network, "age", "age"));
  EXPECT_INVALID(("'sun'"), compose(network, "age", "sun"));
}

}  // namespace network_query_test
