#include "core/age_mood_speed.hpp"

/// What a user may hold without thinking of its lifetime, and what may be compared or written to.
namespace safe_to_hold_test {

template <class T>
concept IsOwned = !std::is_reference_v<T> && !requires(T t) {
  []<class E, std::size_t N>(std::span<E, N>) {}(t);
};

template <class T>
T temporary();  // never defined

template <class T>
concept ValuesAreOwned = IsOwned<decltype(temporary<T>().values())>;

static_assert(ValuesAreOwned<Distribution<Fuzzy>> && ValuesAreOwned<const Distribution<Fuzzy>>);
static_assert(ValuesAreOwned<Induced<Distribution<Fuzzy>>>);
static_assert(ValuesAreOwned<Table> && ValuesAreOwned<NetworkAnswer>);
static_assert(IsOwned<decltype(temporary<Belief<Fuzzy>>().logs())>);
static_assert(IsOwned<decltype(temporary<Likelihood<Fuzzy>>().logs())>);
static_assert(IsOwned<decltype(temporary<Relation<Fuzzy, Fuzzy>>().row(0))>);
static_assert(IsOwned<decltype(temporary<Induced<Relation<Random, Fuzzy>>>().row(0))>);
static_assert(IsOwned<decltype(temporary<Relation<Fuzzy, Fuzzy>>().table())>);
static_assert(IsOwned<decltype(temporary<Relation<Fuzzy, Fuzzy>>().rows())>);
static_assert(IsOwned<decltype(temporary<Relation<Fuzzy, Fuzzy>>().to())>);
static_assert(IsOwned<decltype(temporary<Distribution<Fuzzy>>().variable())>);
static_assert(IsOwned<decltype(temporary<Distribution<Fuzzy>>().variable().name())>);
static_assert(IsOwned<decltype(temporary<Table>().row(0))>);
static_assert(IsOwned<decltype(temporary<HybridDistribution<Fuzzy, Random>>().table())>);
static_assert(IsOwned<decltype(temporary<NetworkAnswer>().variables())>);
static_assert(IsOwned<decltype(temporary<NetworkAnswer>().elimination())>);
static_assert(IsOwned<decltype(temporary<RelationNetwork>().vertices())>);
static_assert(IsOwned<decltype(temporary<ComposedRelation>().table())>);
static_assert(IsOwned<decltype(temporary<Chain<Fuzzy>>().variable())>);

template <class T>
concept HasIteratorsOfATemporary = requires {
  temporary<T>().begin();
};
static_assert(!HasIteratorsOfATemporary<Distribution<Fuzzy>>);

template <class A, class B>
concept Comparable = requires(const A& a, const B& b) {
  a == b;
};
static_assert(Comparable<FuzzyVariable, FuzzyVariable>);
static_assert(!Comparable<RandomVariable, FuzzyVariable> && !Comparable<FuzzyVariable, RandomVariable>);
static_assert(!Comparable<OrdinalVariable, FuzzyVariable>);
static_assert(!std::convertible_to<RandomVariable, FuzzyVariable> &&
              !std::convertible_to<FuzzyVariable, RandomVariable>);
static_assert(!Comparable<Distribution<Random>, Distribution<Fuzzy>>);

TEST(SafeToHold, ARangeForOverATemporarysNumbersSeesThem) {
  const RandomVariable x{"x", 20};  // too large for what a table holds in itself
  std::vector<std::vector<double>> rows(20, std::vector<double>(20, 0.05));
  const Relation step{x, x, rows};
  double sum = 0.0;
  for (const double value : compose(step, step).row(3)) sum += value;
  for (const double value : compose(step, uninformative(x)).values()) sum += value;
  for (const double value : compose(step, uninformative(x))) sum += value;
  for (const double value : compose(step, step).table().row(3)) sum += value;
  for (const double value : invert(step, uninformative(x)).relation.row(3)) sum += value;
  for (const double log : update(Belief{uninformative(x)}, Likelihood{x}).logs()) sum += std::exp(log);
  for (const double log : step.likelihood(3).logs()) sum += std::exp(log);
  EXPECT_NEAR(sum, 7.0, 1e-12);
  const auto kept = compose(step, uninformative(x)).values();
  EXPECT_NEAR(kept[19], 0.05, 1e-15);
}

TEST(SafeToHold, VariablesThatDifferSayInWhat) {
  const Likelihood of_labels{FuzzyVariable{"x", {"0", "1"}}};
  EXPECT_INVALID(("'x' with 2 outcomes that are only numbered", "'x' with the outcomes 0, 1"),
                 update(uninformative(FuzzyVariable{"x", 2}), of_labels));
  EXPECT_INVALID(("'x' whose outcome 1 is '2'", "'x' whose outcome 1 is '1'"),
                 update(uninformative(FuzzyVariable{"x", {"0", "2"}}), of_labels));
  EXPECT_INVALID(("'x' with 3 outcomes", "'x' with 2 outcomes"),
                 update(uninformative(FuzzyVariable{"x", 3}), of_labels));
}

TEST(SafeToHold, WhatHasNoOutcomeLeftThrowsOneType) {
  const Relation never{speed, mood, {{1.0, 0.0}, {1.0, 0.0}}};
  const auto nothing = Distribution{age, {1.0, 0.0, 0.0}};
  const Induced of_relation = compose(Relation{age, speed, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}}, never);
  EXPECT_NO_THROW(of_relation.normalized());
  const Table zeros(1, 3);
  const Induced<Distribution<Fuzzy>> zero{age, zeros, detail::ByLaw{}};
  EXPECT_REFUSED(std::domain_error, ("every outcome", "'age'"), zero.normalized());
  const Induced<Relation<Fuzzy, Random>> zero_rows{age, speed, Table(2, 3), detail::ByLaw{}};
  EXPECT_REFUSED(std::domain_error, ("every outcome", "'age'", "'slow'"), zero_rows.normalized());
  const Chain<Fuzzy> none = compose(Relation{age, age, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}}, Chain{nothing});
  EXPECT_REFUSED(std::domain_error, ("'age'"), update(none, Likelihood{age, {0.0, 1.0, 1.0}}));
}

TEST(SafeToHold, AVerbMayWriteIntoItsOwnPart) {
  const RandomVariable s{"s", 2};
  const Relation step{s, s, {{0.75, 0.25}, {0.5, 0.5}}};
  Relation power = step;
  compose(step, power, power);
  EXPECT_EQ(power, compose(step, step));
  power = step;
  compose(power, step, power);
  EXPECT_EQ(power, compose(step, step));
  compose(power, power, power);
  EXPECT_EQ(power, compose(compose(step, step), compose(step, step)));

  Belief belief{Distribution{s, {0.2, 0.8}}};
  compose(step, belief, belief);
  EXPECT_NEAR(belief[0], 0.55, 1e-15);
  EXPECT_NEAR(belief[1], 0.45, 1e-15);
}

TEST(SafeToHold, ChecksAnIndexWhereAskedTo) {
  const Distribution d{speed, {0.25, 0.75}};
  EXPECT_EQ(d.at(1), 0.75);
  EXPECT_INVALID(("'speed'", "2 outcomes", "9"), d.at(9));
  EXPECT_EQ(mood_given_age.at(1, 1), 0.6);
  EXPECT_INVALID(("'age'", "9"), mood_given_age.at(9, 0));
  EXPECT_INVALID(("'mood'", "9"), mood_given_age.at(0, 9));
  EXPECT_INVALID(("'age'", "9"), mood_given_age.row(9));
  EXPECT_INVALID(("'mood'", "9"), (void)Event{mood, {"wild"}}.contains(9));
}

TEST(SafeToHold, ADistributionIsComparedWrittenAndIterated) {
  const Distribution d{speed, {0.25, 0.75}};
  EXPECT_EQ(d, (Distribution{speed, {0.25, 0.75}}));
  EXPECT_NE(d, (Distribution{speed, {0.75, 0.25}}));
  EXPECT_NE(d, (Distribution{RandomVariable{"pace", {"slow", "fast"}}, {0.25, 0.75}}));
  std::ostringstream text;
  text << d;
  EXPECT_EQ(text.str(), "speed: slow 0.25, fast 0.75");
  EXPECT_EQ(std::vector<double>(d.begin(), d.end()), (std::vector{0.25, 0.75}));
}

}  // namespace safe_to_hold_test
