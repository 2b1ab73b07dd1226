#include "support/core.hpp"

namespace induced_test {

using InducedRelation = Induced<Relation<Random, Fuzzy>>;
using InducedDistribution = Induced<Distribution<Random>>;

// Never silently a distribution.
static_assert(!std::convertible_to<InducedRelation, Relation<Random, Fuzzy>>);
static_assert(!std::constructible_from<Relation<Random, Fuzzy>, InducedRelation>);
static_assert(!std::convertible_to<InducedDistribution, Distribution<Random>>);
static_assert(!std::constructible_from<Distribution<Random>, InducedDistribution>);
static_assert(!std::constructible_from<Belief<Random>, InducedDistribution>);
static_assert(!std::convertible_to<Relation<Random, Fuzzy>, InducedRelation>);
static_assert(is_induced<InducedRelation> && is_induced<InducedDistribution>);
static_assert(!is_induced<Relation<Random, Fuzzy>> && !is_induced<Distribution<Random>>);

template <class T>
concept HasGiven = requires(const T& t) {
  t.given(0U);
};
static_assert(HasGiven<Relation<Random, Fuzzy>> && !HasGiven<InducedRelation>);

const RandomVariable speed{"speed", {"slow", "fast"}};
const FuzzyVariable age{"age", {"young", "old"}};

Table table(std::size_t rows, std::size_t columns, const std::vector<double>& values) {
  Table result(rows, columns);
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

TEST(InducedRelation, WithAnEmptyRowHasNoDistributionReading) {
  const InducedRelation induced{speed, age, table(2, 2, {0.3, 0.7, 0.0, 0.0}), detail::ByLaw{}};
  EXPECT_REFUSED(std::domain_error, ("'speed'", "age", "'old'"), induced.normalized());
}

TEST(InducedRelation, OfSubnormalNumbersIsNormalizedAsWell) {
  const InducedRelation induced{speed, age, table(2, 2, {least_subnormal, least_subnormal, 1.0, 0.0}), detail::ByLaw{}};
  EXPECT_CLOSE(induced.normalized().row(0), (std::vector{0.5, 0.5}), 1e-15);
}

TEST(InducedDistribution, HasABetaThatNormalizingDividesBy) {
  const InducedDistribution induced{speed, table(1, 2, {0.9, 0.6}), detail::ByLaw{}};
  EXPECT_EQ(induced["fast"], 0.6);
  EXPECT_EQ(induced[0], 0.9);
  EXPECT_CLOSE(induced.beta(), 1.5, 1e-15);
  EXPECT_CLOSE(induced.normalized().values(), (std::vector{0.6, 0.4}), 1e-15);
  EXPECT_INVALID(("'speed'", "'medium'"), induced["medium"]);
}

}  // namespace induced_test
