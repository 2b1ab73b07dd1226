#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <sigmax/core/kernels/long_row.hpp>
#include <sigmax/core/rows.hpp>

#include "support/near.hpp"

namespace sigmax::kernels {
namespace {

using support::near;

constexpr double subnormal = std::numeric_limits<double>::denorm_min();
constexpr double least = std::numeric_limits<double>::min();

TEST(LongNumber, IsEveryDouble) {
  for (const double value :
       {0.0, subnormal, 3 * subnormal, least, least - subnormal, 1e-200, 0.1, 0.5, 1.0, 7.0, 1e300}) {
    EXPECT_EQ(LongNumber::of(value).value(), value);
    EXPECT_EQ(LongNumber::of(value, -7).value(), std::ldexp(value, -7));
  }
  EXPECT_EQ(LongNumber::of(-0.0), LongNumber{});
  EXPECT_EQ(LongNumber::of(subnormal).exponent, -1073);
  EXPECT_EQ(LongNumber::of(1.0).significand, 0.5);
}

TEST(LongNumber, IsMultipliedWithoutUnderflow) {
  LongNumber product = LongNumber::of(1.0);
  for (int i = 0; i < 1000; ++i) product = product * LongNumber::of(3 * subnormal);
  EXPECT_PRED_FORMAT3(near, product.log(), 1000.0 * (std::log(3.0) - 1074.0 * std::log(2.0)), 1e-14);
  EXPECT_EQ(product.value(), 0.0);
  EXPECT_EQ((LongNumber{} * product), LongNumber{});
}

TEST(LongNumber, AddsByTheAlgebraAtAnyScale) {
  for (const double a : {0.0, subnormal, 1e-170, 0.5, 3.0, 1e80})
    for (const double b : {0.0, 5 * subnormal, 1e-169, 0.25, 2.0, 1e77}) {
      const LongNumber x = LongNumber::of(a, -100000), y = LongNumber::of(b, -100000);
      EXPECT_EQ(LongNumber::plus<Sigma>(x, y), LongNumber::of(a + b, -100000));
      EXPECT_EQ(LongNumber::plus<Max>(x, y), LongNumber::of(std::max(a, b), -100000));
      EXPECT_EQ(x < y, a < b);
    }
}

TEST(LongNumber, TurnsIntoALogarithmAndBack) {
  for (const double log : {-1e6, -800.0, -3.0, 0.0, 2.0, 900.0})
    EXPECT_PRED_FORMAT3(near, LongNumber::exp(log).log(), log, 1e-14);
  EXPECT_EQ(LongNumber::exp(log_zero), LongNumber{});
  EXPECT_EQ(LongNumber{}.log(), log_zero);
  EXPECT_EQ(LongNumber::exp(-3.0).value(), std::exp(-3.0));
}

TEST(Raised, IsTheNumberTimesAPowerOfTwo) {
  for (const double value : {0.0, 1.0, 0.1, 1e-300, least}) EXPECT_EQ(raised(value), value * 0x1p512);
  EXPECT_EQ(raised(subnormal), 0x1p-562);
  EXPECT_EQ(raised(least - subnormal), std::ldexp(0x1p52 - 1.0, -562));
  EXPECT_EQ(raised(-0.0), 0.0);
  EXPECT_FALSE(std::signbit(raised(-0.0)));
}

/// Numbers so far apart that no double holds them together, through a table of ones, subnormals and zeros.
TEST(LongRow, ComposesInBandsWhatDoublesCannotHoldTogether) {
  Table table(3, 4);
  const std::vector<double> rows{1.0, 0.0, 0.0, subnormal, 1.0, 1.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0};
  std::copy(rows.begin(), rows.end(), table.data());
  LongRow row(std::vector{1.0, 0.5, 0.25});
  row.multiply(1, -1000.0 * std::log(2.0));
  row.multiply(2, -5000.0 * std::log(2.0));
  LongRow sum = row, max = row;
  std::vector<Winner> winners;
  sum.compose<Sigma>(table);
  max.compose<Max>(table, winners);
  const double unit = std::log(2.0);
  EXPECT_PRED_FORMAT3(near, sum.log(0), 0.0, 0.0);
  EXPECT_PRED_FORMAT3(near, sum.log(1), -1001.0 * unit, 1e-14);
  EXPECT_PRED_FORMAT3(near, sum.log(2), -5002.0 * unit, 1e-14);
  EXPECT_PRED_FORMAT3(near, sum.log(3), -1002.0 * unit, 1e-14);  // ½ · 2^−1001, above 2^−1074
  EXPECT_EQ(winners, (std::vector<Winner>{0, 1, 2, 1}));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_PRED_FORMAT3(near, max.log(k), sum.log(k), 1e-14);
}

TEST(LongRow, OfZerosStaysZero) {
  LongRow row(std::vector{0.0, -0.0});
  EXPECT_TRUE(row.is_zero());
  row.compose<Sigma>(Table(2, 3, 1.0));
  EXPECT_EQ(row.size(), 3U);
  EXPECT_TRUE(row.is_zero());
  EXPECT_EQ(row.log_total<Sigma>(), log_zero);
}

TEST(PlainRow, IsMaxMin) {
  PlainRow<MaxMin> row(std::vector{0.5, 1.0});
  Table table(2, 2);
  table(0, 0) = 1.0, table(0, 1) = 0.25, table(1, 0) = 0.75, table(1, 1) = 0.5;
  std::vector<Winner> winners;
  row.compose<MaxMin>(table, winners);
  row.multiply(0, 0.6);
  EXPECT_EQ(row.log(0), std::log(0.6));
  EXPECT_EQ(row.log(1), std::log(0.5));
  EXPECT_EQ(row.greatest(), 0U);
  EXPECT_EQ(winners, (std::vector<Winner>{1, 1}));
}

}  // namespace
}  // namespace sigmax::kernels
