#include "core/network_grid.hpp"

namespace network_large_test {

TEST(NetworkLimit, RefusesATableThatIsTooLargeBeforeItIsMade) {
  const RelationNetwork network = grid(40);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_REFUSED(std::length_error, ("GiB", "above the limit of 1 GiB", "'x"), query(network, {name(1599)}));
  EXPECT_REFUSED(std::length_error, ("above the limit of 1 GiB", "'x"), marginals(network));
  EXPECT_REFUSED(std::length_error, ("above the limit", "'x"), most_likely_explanation(network));
  EXPECT_REFUSED(std::length_error, ("above the limit", "'x"), most_likely_outcomes(network, std::vector{name(1599)}));
  EXPECT_REFUSED(std::length_error, ("above the limit", "'x"), compose(network, name(0), name(1599)));
  EXPECT_GT(cost(network, {name(1599)}).greatest_table, 0x1p30);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(NetworkLimit, IsSetByTheCaller) {
  const RelationNetwork network = grid(4);
  const double numbers = cost(network, {name(15)}).greatest_table;
  EXPECT_EQ(numbers, query(network, {name(15)}).elimination().greatest_table);
  const auto bytes = static_cast<std::size_t>(numbers) * sizeof(ScaledNumber);
  EXPECT_NO_THROW(query(network, {name(15)}, {}, bytes));
  EXPECT_REFUSED(std::length_error, ("'x"), query(network, {name(15)}, {}, bytes - 1));
  std::vector<std::string> all;
  for (std::size_t k = 0; k < 16; ++k) all.push_back(name(k));
  EXPECT_REFUSED(std::length_error, ("6.55e+04 numbers", "'x0'", "16 variables"), query(network, all, {}, 1 << 16));
}

TEST(NetworkOrder, OfALongChainOfOneKindIsFast) {
  const std::size_t length = 3000;
  RelationNetwork network;
  network.declare(Distribution{RandomVariable{name(0), 2}, {1.0, 0.0}});
  for (std::size_t k = 1; k < length; ++k)
    network.declare(Relation{RandomVariable{name(k), 2}, RandomVariable{name(k - 1), 2}, {{0.75, 0.25}, {0.25, 0.75}}});
  const auto start = std::chrono::steady_clock::now();
  const auto answer = query(network, {name(length - 1)});
  const auto all = marginals(network);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));  // a second, without optimisation
  EXPECT_CLOSE(answer.values()[0].value(), 0.5, 1e-12);
  EXPECT_EQ(answer.elimination().greatest_table, 4.0);
  for (const std::size_t k : {std::size_t{1}, std::size_t{3}, length - 1})
    EXPECT_CLOSE(all[k].values()[0].value(), 0.5 + std::pow(0.5, static_cast<double>(k) + 1.0), 1e-12);
}

TEST(NetworkOrder, OfALongChainOfAlternatingKindsIsFast) {
  const std::size_t length = 2000;
  RelationNetwork network;
  network.declare(Distribution{RandomVariable{name(0), 2}, {0.5, 0.5}});
  for (std::size_t k = 1; k < length; ++k) {
    if (k % 2 == 1)
      network.declare(Relation{FuzzyVariable{name(k), 2}, RandomVariable{name(k - 1), 2}, {{1.0, 0.5}, {0.5, 1.0}}});
    else
      network.declare(
          Relation{RandomVariable{name(k), 2}, FuzzyVariable{name(k - 1), 2}, {{0.75, 0.25}, {0.25, 0.75}}});
  }
  const auto start = std::chrono::steady_clock::now();
  const auto answer = query(network, {name(length - 1)});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_TRUE(answer.induced());
  EXPECT_EQ(answer.values()[0], answer.values()[1]);  // nothing tells the outcomes apart
  EXPECT_EQ(answer.elimination().order.front(), name(length - 2));
}

TEST(Network, OfAMillionOutcomesIsNeverATable) {
  const RandomVariable now{"now", 1000000}, next{"next", 1000000};
  SparseRows rows;
  for (std::size_t i = 0; i < now.size(); ++i) rows.append({{i / 2, 0.75}, {i / 2 + 500000, 0.25}});
  RelationNetwork network;
  network.declare(uninformative(now));
  network.declare(Relation<Random, Random>{next, now, std::move(rows)});
  const auto answer = query(network, {"now"}, {{"next", "7"}});
  EXPECT_CLOSE(answer.normalized()[14], 0.5, 1e-12);
  EXPECT_CLOSE(answer.normalized()[15], 0.5, 1e-12);
  EXPECT_CLOSE(query(network, {"next"}, {{"now", "14"}}).normalized()[500007], 0.25, 1e-12);
  EXPECT_REFUSED(std::length_error, ("1e+12 numbers", "'next', 'now'"), query(network, {"next"}));
  const RelationNetwork fuzzy = as_fuzzy(network, DuboisPrade{});
  EXPECT_EQ(query(fuzzy, {"next"}, {{"now", "14"}}).normalized()[500007], 0.25);
}

TEST(Network, TakesSparseRowsOfSeveralParents) {
  const RandomVariable a{"a", 2}, b{"b", 2}, c{"c", 3};
  RelationNetwork network = network_of(uninformative(a), uninformative(b));
  network.declare(c, {a, b}, SparseRows{{{0, 1.0}}, {{1, 1.0}}, {{1, 1.0}}, {{2, 1.0}}});
  EXPECT_EQ(query(network, {"c"}).values()[1].value(), 0.5);
  EXPECT_INVALID(("'c'", "2 rows", "1"), network.declare(c, {a}, SparseRows{{{0, 1.0}}}));
  EXPECT_INVALID(("sum", "'d'", "a = '1'", "0.5"),
                 network.declare(RandomVariable{"d", 3}, {a}, SparseRows{{{0, 1.0}}, {{1, 0.5}}}));
}

TEST(Network, GivesItsVariablesByNameAndKind) {
  RelationNetwork network;
  const FuzzyVariable age{"age", {"young", "old"}};
  network.declare(uninformative(age));
  EXPECT_EQ(network.variable<Fuzzy>("age"), age);
  EXPECT_INVALID(("'age'", "fuzzy", "random"), network.variable<Random>("age"));
  EXPECT_INVALID(("'aeg'"), network.variable<Fuzzy>("aeg"));
}

TEST(NetworkEvidence, MayBeAnEvent) {
  const RandomVariable a{"a", {"low", "middle", "high"}}, b{"b", 2};
  const RelationNetwork network =
      network_of(Distribution{a, {0.25, 0.25, 0.5}}, Relation{b, a, {{1.0, 0.0}, {0.5, 0.5}, {0.0, 1.0}}});
  const auto answer = query(network, {"b"}, Evidence{}.observe(Event{a, {"middle", "high"}}));
  EXPECT_EQ(answer.total().value(), 0.75);
  EXPECT_EQ(answer.values()[0].value(), 0.125);
}

TEST(NetworkQuery, LeavesOutWhatBearsOnNothing) {  // a barren child of many outcomes would be in the way
  RelationNetwork network = grid(3);
  const RandomVariable wide{"wide", 1000};
  std::vector<std::vector<double>> rows(512, std::vector<double>(1000, 0.001));
  std::vector<NetworkVariable> parents;
  for (std::size_t k = 0; k < 9; ++k) parents.push_back(network[k].variable);
  network.declare(wide, parents, rows);
  const auto answer = query(network, {name(8)});
  EXPECT_LE(answer.elimination().greatest_table, 32.0);
  EXPECT_EQ(answer.elimination().order.size(), 8U);
  EXPECT_EQ(query(network, {name(0)}).elimination().order.size(), 0U);
  EXPECT_EQ(query(network, {name(0)}, {{name(4), "1"}}).elimination().order.size(), 2U);  // its parents, x4 is known
}

TEST(MarginalExplanation, EliminatesTheOthersByTheirKinds) {
  // The most likely outcome of a alone is 1, though the most likely pair has a = 0.
  const RandomVariable a{"a", 2}, b{"b", 3};
  const RelationNetwork network =
      network_of(Distribution{a, {0.4, 0.6}}, Relation{b, a, {{1.0, 0.0, 0.0}, {0.25, 0.375, 0.375}}});
  EXPECT_EQ(most_likely_explanation(network)["a"], "0");
  const Explanation marginal = most_likely_outcomes(network, std::vector<std::string>{"a"});
  EXPECT_EQ(marginal["a"], "1");
  EXPECT_EQ(marginal.variables.size(), 1U);
  EXPECT_CLOSE(marginal.log_value, std::log(0.6), 1e-14);
}

TEST(MarginalExplanation, IsTheGreatestNumberOfTheQuery) {
  const RelationNetwork network = grid(4);
  const std::vector<std::string> asked{name(12), name(3), name(9)};
  const Evidence evidence{{name(15), "1"}, {name(3), "0"}};
  const auto answer = query(network, asked, evidence);
  const Explanation best = most_likely_outcomes(network, asked, evidence);
  std::size_t greatest = 0;
  for (std::size_t i = 0; i < answer.values().size(); ++i)
    if (answer.values()[greatest] < answer.values()[i]) greatest = i;
  EXPECT_EQ(best.outcomes, (std::vector<std::size_t>{greatest / 4, greatest / 2 % 2, greatest % 2}));
  EXPECT_CLOSE(best.log_value, answer.values()[greatest].log(), 1e-12);
  EXPECT_INVALID(("'x1'", "twice"), most_likely_outcomes(network, std::vector{name(1), name(1)}));
}

TEST(Sample, HasTheFrequenciesOfTheNetwork) {
  const RelationNetwork network = grid(2);
  std::mt19937_64 generator(11);
  std::vector<std::size_t> ones(4, 0);
  const std::size_t runs = 20000;
  for (std::size_t run = 0; run < runs; ++run) {
    const auto outcomes = sample(network, generator);
    for (std::size_t v = 0; v < 4; ++v) ones[v] += outcomes[v];
  }
  const auto exact = marginals(network);
  for (std::size_t v = 0; v < 4; ++v)
    EXPECT_NEAR(static_cast<double>(ones[v]) / static_cast<double>(runs), exact[v].values()[1].value(), 0.02);
}

TEST(Sample, NeverDrawsWhatIsImpossible) {
  std::mt19937_64 generator(3);
  const Distribution sure{RandomVariable{"x", 3}, {0.0, 1.0, 0.0}};
  for (int k = 0; k < 100; ++k) EXPECT_EQ(sample(sure, generator), 1U);
  RelationNetwork fuzzy;
  fuzzy.declare(uninformative(FuzzyVariable{"y", 2}));
  EXPECT_INVALID(("'y'", "fuzzy"), sample(fuzzy, generator));
}

TEST(Sample, DrawsOneNumberOfTheStandardLibrary) {
  const Distribution weather{RandomVariable{"x", 2}, {0.3, 0.7}};
  std::mt19937 ours(1), theirs(1);
  for (int k = 0; k < 1000; ++k)
    ASSERT_EQ(sample(weather, ours), (std::generate_canonical<double, 53>(theirs) < 0.3) ? 0U : 1U);
}

TEST(Bif, WritesWhatItReads) {
  RelationNetwork network = grid(2);
  const RandomVariable odd{"an odd name", {"a b", "c|d", "50%"}};
  network.declare(odd, {network[0].variable}, {{0.1, 0.2, 0.7}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}});
  std::stringstream text;
  write_bif(text, network, "small grid");
  const RelationNetwork again = read_bif(text, "again.bif");
  ASSERT_EQ(again.size(), network.size());
  for (std::size_t v = 0; v < network.size(); ++v) {
    EXPECT_EQ(again[v].variable.name(), network[v].variable.name());
    EXPECT_EQ(again[v].parents, network[v].parents);
    const auto& found = std::get<Table>(again[v].rows);
    const auto& expected = std::get<Table>(network[v].rows);
    EXPECT_EQ(std::vector(found.values().begin(), found.values().end()),
              std::vector(expected.values().begin(), expected.values().end()));
  }
  EXPECT_EQ(again[4].variable.label(1), "c|d");
  RelationNetwork fuzzy;
  fuzzy.declare(uninformative(FuzzyVariable{"y", 2}));
  std::ostringstream nothing;
  EXPECT_INVALID(("'y'", "fuzzy"), write_bif(nothing, fuzzy, "n"));
  EXPECT_EQ(nothing.str(), "");
}

TEST(Graphviz, EscapesABackslash) {
  RelationNetwork network;
  network.declare(uninformative(FuzzyVariable{"a \"quoted\" name\\", 2}));
  std::ostringstream text;
  write_graphviz(text, network);
  EXPECT_NE(text.str().find("[label=\"a \\\"quoted\\\" name\\\\\", shape=box]"), std::string::npos) << text.str();
}

TEST(Bif, SkipsAByteOrderMarkAndRefusesANetworkOfNothing) {
  std::istringstream marked(
      "\xEF\xBB\xBFnetwork n { }\nvariable a { type discrete [ 1 ] { yes }; }\nprobability ( a ) { table 1; }\n");
  EXPECT_EQ(read_bif(marked, "marked.bif").size(), 1U);
  std::istringstream cut_off("network n { }\n");
  EXPECT_INVALID(("cut.bif:2", "'variable'", "end of the file"), read_bif(cut_off, "cut.bif"));
}

}  // namespace network_large_test
