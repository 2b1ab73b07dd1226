#include "support/core.hpp"

/// The worked examples of docs/chains.md.
namespace chain_walk_test {

TEST(ChainWalk, OfSparseAndBandedRelationsIsWhatTheDocumentSays) {
  const RandomVariable cell{"cell", 100000};
  SparseRows jumps;
  BandedRows walk;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    jumps.append({{i / 2, 0.75}, {i / 2 + 50000, 0.25}});
    walk.append(i == 0 ? 0 : i - 1, i == 0 || i == 99999 ? std::vector{0.5, 0.5} : std::vector{0.25, 0.5, 0.25});
  }
  const Relation jump{cell, cell, std::move(jumps)};
  const Relation step{cell, cell, std::move(walk)};
  const Relation both = compose(jump, step);                      // sparse again
  const Distribution there = compose(both, uninformative(cell));  // 10⁵ numbers
  const auto back = invert(jump, uninformative(cell));            // a sparse transpose
  double sum = 0.0;
  both.for_each(17, [&](std::size_t, double p) { sum += p; });

  EXPECT_CLOSE(there[3], 1.5e-5, 1e-15);
  EXPECT_CLOSE(back.relation(3, 6), 0.5, 1e-12);
  EXPECT_CLOSE(sum, 1.0, 1e-15);
  EXPECT_CLOSE(both(17, 8), 0.75 * 0.75, 1e-15);  // 16 and 17 jump to 8
}

TEST(ChainWalk, OfChainsIsWhatTheDocumentSays) {
  const RandomVariable weather{"weather", {"dry", "wet"}};
  const Distribution prior{weather, {0.5, 0.5}};
  const Relation next{weather, weather, {{0.75, 0.25}, {0.25, 0.75}}};
  const std::vector<Likelihood<Random>> reports(100000, Likelihood{weather, {0.5, 0.25}});

  Chain chain{prior};
  for (const auto& report : reports) chain = update(compose(next, std::move(chain)), report);
  most_likely(chain);  // the winner
  chain.log_total();   // the log evidence

  EXPECT_EQ(most_likely(chain), "dry");
  const double root = std::sqrt(17.0) / 16.0, greater = 9.0 / 32.0 + root / 2.0, lesser = 9.0 / 32.0 - root / 2.0;
  const double expected = std::log((0.375 - lesser) / (greater - lesser)) + 100000.0 * std::log(greater);
  EXPECT_CLOSE(chain.log_total(), expected, 1e-13);

  const auto all = forward_backward(prior, next, reports);
  all.at(0);        // the start, given everything
  all.at(17);       // after the 17th report, and those that follow
  all.log_total();  // the log evidence, again
  EXPECT_CLOSE(all.log_total(), chain.log_total(), 1e-13);
  EXPECT_CLOSE(all.at(100000).values(), chain.normalized().values(), 1e-12);
  EXPECT_GT(all.at(17)[0], all.at(0)[0]);  // no report is about the start itself

  const FuzzyVariable mood{"mood", {"calm", "wild"}};
  const Relation mood_given_weather{mood, weather, {{1.0, 0.5}, {0.25, 1.0}}};
  const Relation weather_given_mood{weather, mood, {{0.75, 0.25}, {0.25, 0.75}}};
  Chain days{prior};
  for (int day = 0; day < 100000; ++day)
    days = compose(weather_given_mood, compose(mood_given_weather, std::move(days)));
  const double log_beta = days.log_total();

  // Both weathers get ½ a: calm gets ½ a + ⅛ a, wild ¼ a + ½ a, and dry or wet the greater of ¾ and ¼ of these.
  long double dry = 0.5L, wet = 0.5L, log = 0.0L;
  for (int day = 0; day < 100000; ++day) {
    const long double calm = dry + 0.25L * wet, wild = 0.5L * dry + wet;
    dry = std::max(0.75L * calm, 0.25L * wild);
    wet = std::max(0.25L * calm, 0.75L * wild);
    const long double scale = dry + wet;
    log += std::log(scale), dry /= scale, wet /= scale;
  }
  EXPECT_CLOSE(log_beta, static_cast<double>(log), 1e-12);
}

TEST(ChainWalk, OfRoutesIsWhatTheDocumentSays) {
  const FuzzyVariable name{"name", {"ann", "bob"}};
  const FuzzyVariable age{"age", {"young", "middle", "old"}};
  const FuzzyVariable mood{"mood", {"calm", "wild"}};
  const Relation age_given_name{age, name, {{1.0, 0.5, 0.5}, {0.5, 1.0, 1.0}}};
  const Relation mood_given_age{mood, age, {{0.5, 1.0}, {1.0, 0.5}, {1.0, 0.25}}};

  const Likelihood seen{mood, {0.1, 1.0}};
  const Route route =
      best_route(Distribution{name, {0.5, 1.0}}, age_given_name, mood_given_age, seen);  // ann, young, wild: ½

  EXPECT_EQ(route.outcomes, (std::vector<std::size_t>{0, 0, 1}));
  EXPECT_CLOSE(route.log_value, std::log(0.5), 1e-15);
}

TEST(ChainWalk, OfOrdinalVariablesIsWhatTheDocumentSays) {
  const OrdinalVariable age{"age", {"young", "middle", "old"}};
  const OrdinalVariable risk{"risk", {"low", "high"}};
  const Relation risk_given_age{risk, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};
  const Distribution prior{age, {0.5, 1.0, 0.8}};

  compose(risk_given_age, prior);                    // low 1, high 0.6: max-min
  update(prior, risk_given_age.likelihood("high"));  // 0.5, 1, 0.2: minimum, then residuum

  EXPECT_CLOSE(compose(risk_given_age, prior).values(), (std::vector{1.0, 0.6}), 0.0);
  EXPECT_CLOSE(update(prior, risk_given_age.likelihood("high")).values(), (std::vector{0.5, 1.0, 0.2}), 0.0);
}

}  // namespace chain_walk_test
