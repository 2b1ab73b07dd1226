#include "support/core.hpp"

namespace ordinal_test {

// Kind chooses the algebra, and an ordinal variable meets only its like: the compiler states these facts.
static_assert(std::same_as<AlgebraOf<Ordinal>, MaxMin> && Uncertainty<Ordinal>);
static_assert(SelectiveAlgebra<MaxMin> && !ScalingAlgebra<MaxMin>);
static_assert(Mixable<Random, Fuzzy> && Mixable<Ordinal, Ordinal>);
static_assert(!Mixable<Ordinal, Fuzzy> && !Mixable<Random, Ordinal>);

template <class To, class From>
concept Related = requires {
  typename Relation<To, From>;
};
static_assert(Related<Ordinal, Ordinal> && Related<Random, Fuzzy>);
static_assert(!Related<Ordinal, Random> && !Related<Ordinal, Fuzzy>);
static_assert(!Related<Random, Ordinal> && !Related<Fuzzy, Ordinal>);

template <class To, class From>
concept RelatedByItsRows = requires(Variable<To> to, Variable<From> from) {
  Relation{to, from, {{1.0, 0.5}}};
};
static_assert(RelatedByItsRows<Ordinal, Ordinal> && !RelatedByItsRows<Fuzzy, Ordinal>);

template <class Left, class Right>
concept Composes = requires(const Left& left, const Right& right) {
  compose(left, right);
};
static_assert(Composes<Relation<Ordinal, Ordinal>, Relation<Ordinal, Ordinal>>);
static_assert(Composes<Relation<Ordinal, Ordinal>, Distribution<Ordinal>>);
static_assert(Composes<Likelihood<Ordinal>, Relation<Ordinal, Ordinal>>);
static_assert(!Composes<Relation<Ordinal, Ordinal>, Distribution<Fuzzy>>);
static_assert(!Composes<Relation<Fuzzy, Fuzzy>, Relation<Ordinal, Ordinal>>);
static_assert(!Composes<Likelihood<Fuzzy>, Relation<Ordinal, Ordinal>>);

template <class Prior, class Evidence>
concept Updates = requires(const Prior& prior, const Evidence& evidence) {
  update(prior, evidence);
};
static_assert(Updates<Distribution<Ordinal>, Likelihood<Ordinal>>);
static_assert(!Updates<Distribution<Ordinal>, Likelihood<Fuzzy>> &&
              !Updates<Distribution<Random>, Likelihood<Ordinal>>);

// Logarithms are for what scales.
template <class T>
concept HasLogs = requires(const T& likelihood) {
  likelihood.log(0);
};
template <class Kind>
concept HasBelief = requires {
  typename Belief<Kind>;
};
static_assert(HasLogs<Likelihood<Fuzzy>> && !HasLogs<Likelihood<Ordinal>>);
static_assert(HasBelief<Fuzzy> && !HasBelief<Ordinal>);

const OrdinalVariable age{"age", {"young", "middle", "old"}};

TEST(Ordinal, DistributionsHaveMaximumOne) {
  EXPECT_EQ((Distribution{age, {0.2, 1.0, 0.4}})["old"], 0.4);
  EXPECT_INVALID(("maximum", "'age'", "0.9"), Distribution(age, {0.2, 0.9, 0.4}));
  EXPECT_EQ(most_likely(Distribution{age, {0.2, 1.0, 1.0}}), "middle");
}

TEST(Ordinal, NormalizesByResiduum) {  // only what is the maximum becomes one, the rest is left alone
  EXPECT_CLOSE(normalized(age, std::vector{0.25, 0.5, 0.5}).values(), (std::vector{0.25, 1.0, 1.0}), 0.0);
  EXPECT_INVALID(("'age'", "zero"), normalized(age, std::vector{0.0, 0.0, 0.0}));
  EXPECT_INVALID(("'middle'", "2"), normalized(age, std::vector{0.0, 2.0, 0.0}));
}

TEST(Ordinal, UpdateByEvidenceThatExcludesEverythingIsADomainError) {
  EXPECT_REFUSED(std::domain_error, ("evidence", "'age'"),
                 update(Distribution{age, {1.0, 0.0, 0.0}}, Likelihood{age, {0.0, 1.0, 1.0}}));
}

TEST(Ordinal, LikelihoodsAreKeptUnrounded) {
  const Likelihood likelihood{age, {0.1, 0.3, 1.0}};
  EXPECT_EQ(likelihood[0], 0.1);
  EXPECT_EQ(likelihood["middle"], 0.3);
  EXPECT_EQ(likelihood.number(1), 0.3);
  EXPECT_EQ(Likelihood{age}[2], 1.0);
  EXPECT_INVALID(("'age'", "'middle'", "1.5"), Likelihood(age, {0.1, 1.5, 0.2}));
}

}  // namespace ordinal_test
