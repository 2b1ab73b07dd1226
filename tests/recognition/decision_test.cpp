#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace decision_test {

const RandomVariable animal{"animal", {"cat", "hen", "cow"}};
const FuzzyVariable target{"target", {"T1", "T2", "T3"}};

TEST(Decide, IsForTheMostProbableByTheMarginToTheSecond) {
  const Decision decision = decide(Belief{Distribution{animal, {0.25, 0.125, 0.625}}});
  EXPECT_EQ(decision.pattern, 2U);
  EXPECT_CLOSE(decision.margin, 0.375, 1e-15);
  EXPECT_EQ(decision.tied, 1U);
}

TEST(Decide, IsForTheMostPossibleByItsNecessity) {
  const Decision decision = decide(Belief{Distribution{target, {0.25, 1.0, 0.75}}});
  EXPECT_EQ(decision.pattern, 1U);
  EXPECT_CLOSE(decision.margin, 0.25, 1e-15);
}

PROPERTY(Decide, TheMarginOfAPossibilityIsTheNecessityOfTheWinner) {
  const auto pattern = laws::any_variable<Fuzzy>("pattern");
  const auto belief = laws::any_distribution(pattern);
  const Decision decision = decide(Belief{belief});
  const double expected = necessity(belief, Event<Fuzzy>{pattern, {decision.pattern}});
  if (decision.tied == 1) require_near(decision.margin, expected);
  if (decision.tied > 1) RC_ASSERT(decision.margin == 0.0 && expected <= 2e-9);
}

TEST(Decide, GivesATieToTheFirst) {
  const Decision exact = decide(Belief{Distribution{target, {0.5, 1.0, 1.0}}});
  EXPECT_EQ(exact.pattern, 1U);
  EXPECT_EQ(exact.tied, 2U);
  EXPECT_EQ(exact.margin, 0.0);
  EXPECT_EQ(decide(Belief{Distribution{target, {1.0 - 5e-10, 1.0, 0.0}}}).pattern, 0U);  // within the tolerance
  EXPECT_EQ(decide(Belief{Distribution{target, {1.0 - 5e-10, 1.0, 0.0}}}).margin, 0.0);
  EXPECT_EQ(decide(Belief{Distribution{target, {1.0 - 2e-9, 1.0, 0.0}}}).pattern, 1U);  // and beyond it
  EXPECT_EQ(decide(Belief{uninformative(animal)}).tied, 3U);
}

TEST(Decide, ForTheOnlyPatternIsCertain) {
  EXPECT_EQ(decide(Belief{uninformative(FuzzyVariable{"only", 1})}).margin, 1.0);
  EXPECT_EQ(decide(Belief{uninformative(RandomVariable{"only", 1})}).margin, 1.0);
}

TEST(DecideOrReject, RejectsBelowTheLeastMargin) {
  const Belief belief{Distribution{target, {0.25, 1.0, 0.75}}};
  EXPECT_FALSE(decide_or_reject(belief, 0.26));
  ASSERT_TRUE(decide_or_reject(belief, 0.24));
  EXPECT_EQ(decide_or_reject(belief, 0.24)->pattern, 1U);
  EXPECT_TRUE(decide_or_reject(Belief{uninformative(animal)}, 0.0));  // zero rejects nothing
  EXPECT_FALSE(decide_or_reject(Belief{uninformative(animal)}, 1e-6));
}

using Order = std::vector<std::size_t>;

TEST(BestPatterns, AreInOrderOfTheirWeights) {
  const Belief belief{Distribution{RandomVariable{"x", 5}, {0.1, 0.4, 0.0, 0.3, 0.2}}};
  EXPECT_EQ(best_patterns(belief, 3), (Order{1, 3, 4}));
  EXPECT_EQ(best_patterns(belief, 9), (Order{1, 3, 4, 0, 2}));
  EXPECT_EQ(best_patterns(belief, 0), Order{});
}

TEST(BestPatterns, AreOrderedWhereProbabilitiesUnderflow) {
  Belief belief{uninformative(animal)};
  const std::vector logs{-2000.0, 0.0, -1000.0};
  belief.assign([&](std::size_t c) { return logs[c]; });
  EXPECT_EQ(belief[0], belief[2]);
  EXPECT_EQ(best_patterns(belief, 3), (Order{1, 2, 0}));
}

TEST(BestPatterns, GiveTiesToTheFirst) {
  const Belief belief{Distribution{FuzzyVariable{"x", 5}, {0.5, 1.0 - 5e-10, 1.0, 0.5, 0.5 + 1e-10}}};
  EXPECT_EQ(best_patterns(belief, 5), (Order{1, 2, 0, 3, 4}));
  EXPECT_EQ(best_patterns(belief, 1).front(), decide(belief).pattern);
}

}  // namespace decision_test
