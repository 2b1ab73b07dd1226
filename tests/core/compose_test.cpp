#include "core/age_mood_speed.hpp"

namespace compose_test {

template <class To, class From>
using R = Relation<To, From>;
template <class To, class From>
using I = Induced<Relation<To, From>>;
template <class Kind>
using D = Distribution<Kind>;

template <class Left, class Right>
using Composed = decltype(compose(std::declval<const Left&>(), std::declval<const Right&>()));

// The kind of the result is the kind eliminated: a Relation. If not: only Induced.
static_assert(std::same_as<Composed<R<Random, Random>, R<Random, Random>>, R<Random, Random>>);
static_assert(std::same_as<Composed<R<Random, Random>, R<Random, Fuzzy>>, R<Random, Fuzzy>>);
static_assert(std::same_as<Composed<R<Fuzzy, Fuzzy>, R<Fuzzy, Fuzzy>>, R<Fuzzy, Fuzzy>>);
static_assert(std::same_as<Composed<R<Fuzzy, Fuzzy>, R<Fuzzy, Random>>, R<Fuzzy, Random>>);
static_assert(std::same_as<Composed<R<Random, Fuzzy>, R<Fuzzy, Fuzzy>>, I<Random, Fuzzy>>);  // (17)
static_assert(std::same_as<Composed<R<Random, Fuzzy>, R<Fuzzy, Random>>, I<Random, Random>>);
static_assert(std::same_as<Composed<R<Fuzzy, Random>, R<Random, Random>>, I<Fuzzy, Random>>);  // (18)
static_assert(std::same_as<Composed<R<Fuzzy, Random>, R<Random, Fuzzy>>, I<Fuzzy, Fuzzy>>);

// Induced is closed, on either side.
static_assert(std::same_as<Composed<R<Random, Random>, I<Random, Fuzzy>>, I<Random, Fuzzy>>);
static_assert(std::same_as<Composed<I<Random, Fuzzy>, R<Fuzzy, Fuzzy>>, I<Random, Fuzzy>>);
static_assert(std::same_as<Composed<I<Random, Fuzzy>, I<Fuzzy, Random>>, I<Random, Random>>);

// With a distribution: a distribution, or induced.
static_assert(std::same_as<Composed<R<Random, Random>, D<Random>>, D<Random>>);
static_assert(std::same_as<Composed<R<Fuzzy, Fuzzy>, D<Fuzzy>>, D<Fuzzy>>);
static_assert(std::same_as<Composed<R<Random, Fuzzy>, D<Fuzzy>>, Induced<D<Random>>>);
static_assert(std::same_as<Composed<R<Fuzzy, Random>, D<Random>>, Induced<D<Fuzzy>>>);
static_assert(std::same_as<Composed<R<Fuzzy, Fuzzy>, Induced<D<Fuzzy>>>, Induced<D<Fuzzy>>>);
static_assert(std::same_as<Composed<I<Random, Fuzzy>, D<Fuzzy>>, Induced<D<Random>>>);
static_assert(std::same_as<Composed<R<Fuzzy, Fuzzy>, Belief<Fuzzy>>, Belief<Fuzzy>>);
static_assert(std::same_as<Composed<Likelihood<Fuzzy>, R<Fuzzy, Random>>, Likelihood<Random>>);

// A wrong kind does not compile.
template <class Left, class Right>
concept Composes = requires(const Left& left, const Right& right) {
  compose(left, right);
};
static_assert(Composes<R<Random, Fuzzy>, R<Fuzzy, Random>>);
static_assert(!Composes<R<Random, Fuzzy>, R<Random, Fuzzy>>);
static_assert(!Composes<R<Random, Random>, R<Fuzzy, Random>>);
static_assert(!Composes<R<Random, Fuzzy>, D<Random>>);
static_assert(!Composes<R<Random, Random>, D<Fuzzy>>);
static_assert(!Composes<R<Random, Fuzzy>, Induced<D<Random>>>);
static_assert(!Composes<R<Random, Fuzzy>, Belief<Fuzzy>>);  // would be induced, and a belief is not
static_assert(!Composes<R<Random, Random>, Belief<Fuzzy>>);
static_assert(!Composes<Likelihood<Random>, R<Fuzzy, Random>>);
static_assert(!Composes<D<Random>, R<Random, Random>>);

// Nor does a relation take what is only induced.
template <class Left, class Right, class Result>
concept ComposesInto = requires(const Left& left, const Right& right, Result& result) {
  compose(left, right, result);
};
static_assert(ComposesInto<R<Fuzzy, Fuzzy>, R<Fuzzy, Random>, R<Fuzzy, Random>>);
static_assert(ComposesInto<R<Random, Fuzzy>, R<Fuzzy, Fuzzy>, I<Random, Fuzzy>>);
static_assert(!ComposesInto<R<Random, Fuzzy>, R<Fuzzy, Fuzzy>, R<Random, Fuzzy>>);
static_assert(!ComposesInto<R<Fuzzy, Fuzzy>, R<Fuzzy, Random>, I<Fuzzy, Random>>);

TEST(Compose, RefusesAnotherVariableInTheMiddleByBothNames) {
  const FuzzyVariable temper{"temper", {"calm", "wild"}};
  const Relation temper_given_age{temper, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};
  EXPECT_INVALID(("compose", "'mood'", "'temper'"), compose(speed_given_mood, temper_given_age));
  EXPECT_INVALID(("compose", "'mood'", "'temper'"), compose(speed_given_mood, uninformative(temper)));
  EXPECT_INVALID(("compose", "'age'", "'mood'"), compose(mood_given_age, Belief{uninformative(mood)}));
  EXPECT_INVALID(("compose", "'age'", "'mood'"), compose(Likelihood{age}, mood_given_age));
  const FuzzyVariable finer_mood{"mood", {"calm", "wild", "odd"}};
  EXPECT_INVALID(("'mood' with 2 outcomes", "'mood' with 3 outcomes"),
                 compose(speed_given_mood, uninformative(finer_mood)));
}

TEST(Compose, RefusesAResultOfOtherVariablesAndLeavesItAlone) {
  R<Fuzzy, Fuzzy> result{age, age, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  const R<Fuzzy, Fuzzy> mood_to_mood{mood, mood, {{1.0, 0.5}, {0.5, 1.0}}};
  EXPECT_INVALID(("compose", "'mood'", "'age'"), compose(mood_to_mood, mood_given_age, result));
  EXPECT_INVALID(("'mood'", "'age'"), compose(mood_to_mood, mood_to_mood, result));
  EXPECT_EQ(result(2, 2), 1.0);
}

TEST(Compose, PredictsABeliefInTheLogDomain) {  // (51), (53)
  const RandomVariable mode{"mode", 2};
  const Relation transition{mode, mode, {{0.95, 0.05}, {0.1, 0.9}}};
  const Belief prior{Distribution{mode, {0.25, 0.75}}};
  EXPECT_CLOSE(compose(transition, prior).distribution().values(), (std::vector{0.3125, 0.6875}), 1e-15);
  Belief<Random> result{uninformative(mode)};
  compose(transition, prior, result);
  EXPECT_CLOSE(result.distribution().values(), (std::vector{0.3125, 0.6875}), 1e-15);

  Belief far = prior;  // e^−2000 is no number, but moving in from the other mode makes it one again
  far.assign([](std::size_t i) { return i == 0 ? 0.0 : -2000.0; });
  EXPECT_CLOSE(compose(transition, far).distribution().values(), (std::vector{0.95, 0.05}), 1e-15);
  const Relation stay{mode, mode, {{1.0, 0.0}, {0.0, 1.0}}};
  EXPECT_EQ(compose(stay, far).log(1), -2000.0);
}

TEST(Compose, CarriesAnExcludingLikelihoodBackAsExcluding) {
  const Relation crisp{mood, age, {{1.0, 0.0}, {1.0, 0.5}, {0.0, 1.0}}};
  const auto carried = compose(Likelihood{mood, {0.0, 0.5}}, crisp);
  EXPECT_EQ(carried.log(0), log_zero);
  EXPECT_CLOSE(carried["middle"], 0.25, 1e-15);
}

}  // namespace compose_test
