#include "core/age_mood_speed.hpp"

namespace relation_test {

static_assert(!std::convertible_to<Relation<Random, Fuzzy>, Relation<Fuzzy, Fuzzy>>);
static_assert(!std::constructible_from<Relation<Random, Fuzzy>, FuzzyVariable, FuzzyVariable, Rows>);
static_assert(std::copyable<Relation<Random, Fuzzy>>);

TEST(Relation, HasARowForEveryOutcomeOfItsCondition) {
  static_assert(std::same_as<decltype(mood_given_age), const Relation<Fuzzy, Fuzzy>>);
  EXPECT_EQ(mood_given_age.to(), mood);
  EXPECT_EQ(mood_given_age.from(), age);
  EXPECT_EQ(mood_given_age(0, 1), 1.0);  // from first
  EXPECT_EQ(mood_given_age(2, 1), 0.2);
  EXPECT_EQ(mood_given_age.row(1)[1], 0.6);
  EXPECT_EQ(mood_given_age.given("young")["calm"], 0.3);
  EXPECT_EQ(mood_given_age.given(2)["wild"], 0.2);
}

TEST(Relation, IsMadeOfCounts) {
  const std::vector<std::vector<int>> counts{{17, 3}, {2, 8}};
  const Relation by_sum = normalized(speed, mood, counts);
  static_assert(std::same_as<decltype(by_sum), const Relation<Random, Fuzzy>>);
  EXPECT_CLOSE(by_sum.table().values(), (std::vector{0.85, 0.15, 0.2, 0.8}), 1e-15);
  const Relation by_maximum = normalized(mood, speed, counts);
  EXPECT_CLOSE(by_maximum.table().values(), (std::vector{1.0, 3.0 / 17, 0.25, 1.0}), 1e-15);
  const std::vector<std::vector<float>> floats{{0.5F, 1.5F}, {0.0F, 3.0F}};
  EXPECT_CLOSE(normalized(speed, mood, floats).table().values(), (std::vector{0.25, 0.75, 0.0, 1.0}), 0.0);
}

TEST(Relation, OfCountsRefusesRowsWithoutProportion) {
  using Counts = std::vector<std::vector<int>>;
  EXPECT_INVALID(("'speed'", "mood = 'wild'", "zero"), normalized(speed, mood, Counts{{1, 2}, {0, 0}}));
  EXPECT_INVALID(("'speed'", "mood = 'calm'", "'fast'", "-2"), normalized(speed, mood, Counts{{1, -2}, {3, 4}}));
  EXPECT_INVALID(("'speed'", "mood = 'wild'", "1 values"), normalized(speed, mood, Counts{{1, 2}, {3}}));
  EXPECT_INVALID(("'mood'", "but 1 were"), normalized(speed, mood, Counts{{1, 2}}));
}

TEST(Relation, GivesDistributionsOfItsOwnKind) {
  static_assert(std::same_as<decltype(speed_given_mood.given("calm")), Distribution<Random>>);
  static_assert(std::same_as<decltype(speed_given_mood.likelihood("fast")), Likelihood<Fuzzy>>);
  EXPECT_EQ(speed_given_mood.given("wild")["fast"], 0.7);
}

TEST(Relation, ReadByColumnIsALikelihoodOfItsCondition) {
  const auto likelihood = mood_given_age.likelihood("wild");
  EXPECT_EQ(likelihood.variable(), age);
  EXPECT_CLOSE(likelihood["young"], 1.0, 1e-15);
  EXPECT_CLOSE(likelihood["middle"], 0.6, 1e-15);
  EXPECT_CLOSE(likelihood["old"], 0.2, 1e-15);
  EXPECT_CLOSE(mood_given_age.likelihood(0)["young"], 0.3, 1e-15);
}

TEST(Relation, OfAnExcludedOutcomeHasALikelihoodOfZero) {
  const Relation relation{speed, mood, {{1.0, 0.0}, {0.5, 0.5}}};
  EXPECT_EQ(relation.likelihood("fast").log(0), log_zero);
  EXPECT_EQ(relation.likelihood("fast")["calm"], 0.0);
}

TEST(Relation, RefusesABadRowByVariableRowAndValue) {
  EXPECT_INVALID(("maximum", "'mood'", "age", "'middle'", "0.9"),
                 Relation(mood, age, {{0.3, 1.0}, {0.9, 0.6}, {1.0, 0.2}}));
  EXPECT_INVALID(("sum", "'speed'", "mood", "'wild'", "1.1"), Relation(speed, mood, {{0.9, 0.1}, {0.3, 0.8}}));
  EXPECT_INVALID(("'speed'", "mood", "'calm'", "'slow'", "1.5"), Relation(speed, mood, {{1.5, -0.5}, {0.3, 0.7}}));
  EXPECT_INVALID(("'speed'", "mood", "'calm'", "'fast'", "nan"),
                 Relation(speed, mood, {{1.0, not_a_number}, {0.3, 0.7}}));
  EXPECT_INVALID(("'speed'", "mood", "'wild'", "2 outcomes", "1 values"), Relation(speed, mood, {{0.9, 0.1}, {1.0}}));
}

TEST(Relation, RefusesAWrongNumberOfRows) {
  EXPECT_INVALID(("'mood'", "'age'", "3 rows", "2"), Relation(mood, age, {{0.3, 1.0}, {1.0, 0.6}}));
  EXPECT_INVALID(("3 rows", "0"), Relation<Fuzzy, Fuzzy>(mood, age, Rows{}));
}

TEST(Relation, StoresRowsWithinToleranceUnchanged) {
  const Relation relation{speed, mood, {{0.9, 0.1 + 0.9e-9}, {0.3, 0.7 - 0.9e-9}}};
  EXPECT_EQ(relation(0, 1), 0.1 + 0.9e-9);
  EXPECT_EQ(relation(1, 1), 0.7 - 0.9e-9);
  EXPECT_THROW(Relation(speed, mood, {{0.9, 0.1 + 1.1e-9}, {0.3, 0.7}}), std::invalid_argument);
  EXPECT_THROW(Relation(speed, mood, {{0.9, 0.1}, {0.3, 0.7 - 1.1e-9}}), std::invalid_argument);
}

TEST(Relation, RefusesOutcomesThatItDoesNotHave) {
  EXPECT_INVALID(("'age'", "'ancient'"), mood_given_age.given("ancient"));
  EXPECT_INVALID(("'age'", "3"), mood_given_age.given(3));
  EXPECT_INVALID(("'mood'", "'sad'"), mood_given_age.likelihood("sad"));
  EXPECT_INVALID(("'mood'", "2"), mood_given_age.likelihood(2));
}

TEST(Relation, LargerThanWhatIsStoredInlineIsCopiedAndMoved) {
  const RandomVariable cell{"cell", 5};
  const Rows rows(5, {0.5, 0.125, 0.125, 0.125, 0.125});
  Relation<Random, Random> original{cell, cell, rows};
  const Relation<Random, Random> copy = original;
  const Relation<Random, Random> moved = std::move(original);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_CLOSE(copy.row(i), rows[i], 0.0);
    EXPECT_CLOSE(moved.row(i), rows[i], 0.0);
  }
}

TEST(Relation, NormalizedIsItself) {
  EXPECT_EQ(&mood_given_age.normalized(), &mood_given_age);
  const auto& outlives = Relation{mood_given_age}.normalized();  // of a temporary it is a value
  EXPECT_EQ(outlives(2, 1), 0.2);
}

}  // namespace relation_test
