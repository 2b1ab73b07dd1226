#include "support/core.hpp"

namespace mean_interval_test {

// 97.5 % quantiles of Student's t from a printed table, by degrees of freedom.
TEST(MeanInterval, IsStudentsInterval) {
  const Interval two = mean_interval(Numbers{1.0, 3.0});  // s = √2
  EXPECT_DOUBLE_EQ(two.mean, 2.0);
  EXPECT_NEAR(two.half_width, 12.706, 5e-4);
  const Interval five = mean_interval(Numbers{2.0, 4.0, 4.0, 4.0, 6.0});  // s = √2
  EXPECT_DOUBLE_EQ(five.mean, 4.0);
  EXPECT_NEAR(five.half_width, 2.776 * std::sqrt(2.0 / 5.0), 5e-4);
  EXPECT_DOUBLE_EQ(five.lower(), five.mean - five.half_width);
  EXPECT_DOUBLE_EQ(five.upper(), five.mean + five.half_width);
  EXPECT_TRUE(five.above_zero());
  EXPECT_FALSE(two.above_zero());
  EXPECT_FALSE(five.below_zero());
  EXPECT_TRUE(mean_interval(Numbers{-2.0, -2.1}).below_zero());
}

TEST(MeanInterval, OfMuchIsTheNormalOne) {
  Numbers numbers;
  for (int k = 0; k < 100000; ++k) numbers.push_back(k % 2 == 0 ? -1.0 : 1.0);
  EXPECT_NEAR(mean_interval(numbers).half_width * std::sqrt(1e5), 1.96, 1e-4);
}

TEST(MeanInterval, OfOneNumberIsAnyNumber) {
  const Interval one = mean_interval(Numbers{7.0});
  EXPECT_EQ(one.mean, 7.0);
  EXPECT_TRUE(std::isinf(one.half_width));
  EXPECT_FALSE(one.above_zero());
}

TEST(MeanInterval, IsOfSomething) {
  EXPECT_THROW(mean_interval({}), std::domain_error);
  EXPECT_THROW(RunningMean{}.mean(), std::domain_error);
}

TEST(RunningMean, IsTheSameOfPartsAddedTogether) {
  const Numbers numbers{2.0, 4.0, 4.5, -1.0, 6.0, 0.25};
  const Interval whole = mean_interval(numbers);
  for (std::size_t cut = 0; cut <= numbers.size(); ++cut) {
    RunningMean first, second;
    for (std::size_t i = 0; i < numbers.size(); ++i) (i < cut ? first : second).add(numbers[i]);
    first.add(second);
    EXPECT_EQ(first.count(), numbers.size());
    EXPECT_NEAR(first.interval().mean, whole.mean, 1e-14);
    EXPECT_NEAR(first.interval().half_width, whole.half_width, 1e-14);
  }
}

TEST(RunningMean, KeepsItsDigitsFarFromZero) {
  RunningMean mean;
  Numbers numbers;
  std::mt19937_64 generator(5);
  for (int k = 0; k < 10000; ++k) numbers.push_back(static_cast<double>(generator() % 1000));
  double sum = 0.0, squares = 0.0;
  for (const double number : numbers) {
    mean.add(1e9 + number);
    sum += number;
    squares += number * number;
  }
  const double n = 1e4, variance = (squares - sum * sum / n) / (n - 1.0);
  EXPECT_EQ(mean.count(), 10000U);
  EXPECT_NEAR(mean.mean() - 1e9, sum / n, 1e-5);
  EXPECT_NEAR(mean.interval().half_width, 1.9602 * std::sqrt(variance / n), 1e-3);
}

}  // namespace mean_interval_test
