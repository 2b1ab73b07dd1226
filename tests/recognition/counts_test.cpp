#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace counts_test {

using Row = std::vector<std::size_t>;

const RandomVariable animal{"animal", {"cat", "hen"}};
const RandomVariable legs{"legs", {"0", "2", "4"}}, milk{"milk", {"no", "yes"}};

/// Three cats and one hen; of one cat nobody knows the legs.
Counts farm() {
  Counts counts{animal, {legs, milk}};
  counts.observe(0, Row{2, 1});
  counts.observe(0, Row{2, 1});
  counts.observe(0, Row{missing, 0});
  counts.observe(1, Row{1, 0});
  return counts;
}

TEST(Counts, CountWhatIsNotMissing) {
  const Counts counts = farm();
  EXPECT_EQ(counts.rows(0), 3.0);
  EXPECT_EQ(counts.rows(1), 1.0);
  EXPECT_CLOSE(counts.of(0, 0), (Numbers{0, 0, 2}), 0.0);
  EXPECT_CLOSE(counts.of(0, 1), (Numbers{0, 1, 0}), 0.0);
  EXPECT_CLOSE(counts.of(1, 0), (Numbers{1, 2}), 0.0);
}

TEST(Counts, MayBeGivenAsNumbers) {
  Counts counts{animal, {legs, milk}};
  counts.observe(0, Row{2, 1}, 2.0);
  counts.observe_value(1, 0, 1, 462e6);
  EXPECT_EQ(counts.rows(0), 2.0);
  EXPECT_EQ(counts.rows(1), 0.0);  // a value alone is no row
  EXPECT_EQ(counts.of(0, 1)[1], 462e6);
}

TEST(PatternPrior, IsTheShareOfTheRows) {
  EXPECT_CLOSE(pattern_prior(farm()).values(), (Numbers{0.75, 0.25}), 0.0);
  EXPECT_CLOSE(pattern_prior(farm(), 1.0).values(), (Numbers{4.0 / 6.0, 2.0 / 6.0}), 1e-15);
  const Counts empty{animal, {legs}};
  EXPECT_THROW(pattern_prior(empty), std::invalid_argument);
  EXPECT_CLOSE(pattern_prior(empty, 1.0).values(), (Numbers{0.5, 0.5}), 0.0);
}

PROPERTY(LearnedRelation, IsTheStatedFormulaForAnyRows) {
  const RandomVariable pattern{"pattern", laws::any_size()}, feature{"feature", laws::any_size()};
  Counts counts{pattern, {feature}};
  std::vector<Numbers> expected(pattern.size(), Numbers(feature.size(), 0.0));
  const auto rows = *rc::gen::inRange<std::size_t>(0, 30);
  for (std::size_t k = 0; k < rows; ++k) {
    const auto c = *rc::gen::inRange<std::size_t>(0, pattern.size());
    const auto f = *rc::gen::inRange<std::size_t>(0, feature.size() + 1);
    counts.observe(c, Row{f == feature.size() ? missing : f});
    if (f != feature.size()) expected[c][f] += 1.0;
  }
  const double alpha = laws::any([](rc::Random& random) { return static_cast<double>(1 + random.next() % 8) / 4.0; });
  for (std::size_t c = 0; c < pattern.size(); ++c) {
    double n = 0.0;
    for (const double count : expected[c]) n += count;
    for (double& count : expected[c]) count = (count + alpha) / (n + alpha * static_cast<double>(feature.size()));
    require_near(learned_relation(counts, 0, alpha).row(c), expected[c]);
  }
}

TEST(LearnedRelations, AsPossibilitiesAreTransformsOfTheProbabilities) {
  Counts counts{animal, {legs, milk}};
  for (std::size_t k = 0; k < 10; ++k) counts.observe(0, Row{k < 5 ? 2U : (k < 8 ? 1U : 0U), 0});  // 2, 3, 5
  counts.observe(1, Row{1, 0});
  const auto ratio = learned_relations(counts, 0.0, RatioScale{});
  ASSERT_EQ(ratio.size(), 2U);
  EXPECT_EQ(ratio[0].to(), as_fuzzy(legs));
  EXPECT_EQ(ratio[0].from(), as_fuzzy(animal));
  EXPECT_CLOSE(ratio[0].row(0), (Numbers{0.4, 0.6, 1.0}), 1e-15);  // relative frequency to the maximum
  EXPECT_CLOSE(learned_relations(counts, 0.0, DuboisPrade{})[0].row(0), (Numbers{0.2, 0.5, 1.0}), 1e-15);
  EXPECT_CLOSE(learned_relations(counts, 0.0, DuboisPradeSandri{})[0].row(0), (Numbers{0.6, 0.8, 1.0}), 1e-15);
  EXPECT_CLOSE(ratio[1].row(1), (Numbers{1.0, 0.0}), 0.0);
}

TEST(Counts, RefuseWhatDoesNotFitAndCountNothingOfIt) {
  Counts counts = farm();
  EXPECT_INVALID(("'animal'", "2"), counts.observe(2, Row{0, 0}));
  EXPECT_INVALID(("'legs'", "3"), counts.observe(0, Row{3, 0}));
  EXPECT_INVALID(("'milk'", "2"), counts.observe(0, Row{0, 2}));
  EXPECT_INVALID(("'animal'", "2 features", "1 values"), counts.observe(0, Row{0}));
  for (const double times : {-1.0, not_a_number, infinity}) {
    EXPECT_INVALID((std::to_string(times)), counts.observe(0, Row{0, 0}, times));
    EXPECT_THROW(counts.observe_value(0, 0, 0, times), std::invalid_argument);
    EXPECT_THROW(learned_relation(counts, 0, times), std::invalid_argument);
    EXPECT_THROW(pattern_prior(counts, times), std::invalid_argument);
  }
  EXPECT_INVALID(("'animal'", "2 features", "2"), counts.observe_value(0, 2, 0));
  EXPECT_INVALID(("'legs'", "3"), counts.observe_value(0, 0, 3));
  EXPECT_INVALID(("'animal'", "2"), counts.observe_value(2, 0, 0));
  EXPECT_INVALID(("'animal'", "2"), learned_relation(counts, 2, 1.0));
  EXPECT_INVALID(("'animal'", "one feature"), Counts(animal, {}));
  EXPECT_EQ(counts.rows(0), 3.0);
  EXPECT_CLOSE(counts.of(0, 0), (Numbers{0, 0, 2}), 0.0);
}

TEST(LearnedRelation, RefusesAPatternThatWasNeverSeen) {
  Counts counts{animal, {legs, milk}};
  counts.observe(0, Row{0, 0});
  counts.observe(1, Row{missing, 0});
  EXPECT_INVALID(("animal = 'hen'", "'legs'", "0"), learned_relations(counts, 0.0));
  EXPECT_CLOSE(learned_relation(counts, 0, 1.0).row(1), (Numbers{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}), 1e-15);
}

}  // namespace counts_test
