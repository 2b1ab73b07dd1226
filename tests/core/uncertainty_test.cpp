#include "support/core.hpp"

namespace uncertainty_test {

// Kind chooses the algebra: the compiler states these facts.
static_assert(std::same_as<AlgebraOf<Random>, Sigma>);
static_assert(std::same_as<AlgebraOf<Fuzzy>, Max>);
static_assert(Uncertainty<Random> && Uncertainty<Fuzzy>);
static_assert(!Uncertainty<Sigma> && !Uncertainty<double>);

static_assert(Sigma::plus(0.25, 0.5) == 0.75 && Max::plus(0.25, 0.5) == 0.5);
static_assert(Sigma::times(0.25, 0.5) == 0.125 && Max::times(0.25, 0.5) == 0.125);

TEST(Uncertainty, KindsAreCalledByTheirNames) {
  EXPECT_EQ(Random::name, "random");
  EXPECT_EQ(Random::measure, "probability");
  EXPECT_EQ(Random::total, "sum");
  EXPECT_EQ(Fuzzy::name, "fuzzy");
  EXPECT_EQ(Fuzzy::measure, "possibility");
  EXPECT_EQ(Fuzzy::total, "maximum");
  EXPECT_EQ(Ordinal::name, "ordinal");
  EXPECT_EQ(Ordinal::measure, "possibility");
  EXPECT_EQ(Ordinal::total, "maximum");
}

}  // namespace uncertainty_test
