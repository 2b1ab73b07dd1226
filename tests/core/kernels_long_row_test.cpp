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
