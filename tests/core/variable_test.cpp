#include "support/core.hpp"

namespace variable_test {

static_assert(std::same_as<RandomVariable::kind, Random> && std::same_as<FuzzyVariable::kind, Fuzzy>);
static_assert(!std::convertible_to<RandomVariable, FuzzyVariable> &&
              !std::convertible_to<FuzzyVariable, RandomVariable>);
static_assert(std::copyable<RandomVariable> && sizeof(RandomVariable) <= 2 * sizeof(void*));  // a cheap handle

TEST(Variable, IsWrittenWithItsLabelsOrTheirNumber) {
  const FuzzyVariable age{"age", {"young", "middle", "old"}};
  const FuzzyVariable single{"single", {"only"}};
  const RandomVariable cell{"cell", 100000};
  EXPECT_EQ(age.size(), 3U);
  EXPECT_EQ(age.index_of("middle"), 1U);
  EXPECT_EQ(single.size(), 1U);
  EXPECT_EQ(single.label(0), "only");
  EXPECT_EQ(cell.label(99999), "99999");
}

}  // namespace variable_test
