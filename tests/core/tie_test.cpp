#include "support/core.hpp"

namespace tie_test {

TEST(Tie, IsWithinTheToleranceOfTheGreatest) {
  EXPECT_TRUE(ties(-2.0, -2.0));
  EXPECT_TRUE(ties(-2.0 - 0.5e-9, -2.0));
  EXPECT_FALSE(ties(-2.0 - 2e-9, -2.0));
  EXPECT_FALSE(ties(log_zero, -2.0));
  EXPECT_TRUE(ties(log_zero, log_zero));
}

TEST(Tie, TheFirstThatTiesIsFound) {
  EXPECT_EQ(first_of_tied(std::vector{-3.0, -1.0 - 0.5e-9, -1.0}), 1u);
  EXPECT_EQ(first_of_tied(std::vector{-3.0, -1.0 - 2e-9, -1.0}), 2u);
  EXPECT_EQ(first_of_tied(std::vector{log_zero, log_zero}), 0u);
}

TEST(Tie, OfNumbersIsEqualityButForRounding) {
  EXPECT_TRUE(detail::numbers_tie(0.3, 0.1 + 0.2));
  EXPECT_TRUE(detail::numbers_tie(0.0, 0.0));
  EXPECT_FALSE(detail::numbers_tie(0.0, 1e-300));
  EXPECT_FALSE(detail::numbers_tie(0.3, 0.3 + 1e-8));
}

}  // namespace tie_test
