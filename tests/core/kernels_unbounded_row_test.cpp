#include "kernels/unbounded_row.hpp"
#include "support/core.hpp"

namespace sigmax::kernels {
namespace kernels_unbounded_row_test {

using sigmax::detail::any_algebra;

constexpr double least = std::numeric_limits<double>::min();

TEST(Raised, IsTheNumberTimesAPowerOfTwo) {
  for (const double value : {0.0, 1.0, 0.1, 1e-300, least}) EXPECT_EQ(raised(value), value * 0x1p512);
  EXPECT_EQ(raised(least_subnormal), 0x1p-562);
  EXPECT_EQ(raised(least - least_subnormal), std::ldexp(0x1p52 - 1.0, -562));
  EXPECT_EQ(raised(-0.0), 0.0);
  EXPECT_FALSE(std::signbit(raised(-0.0)));
}

/// Numbers so far apart that no double holds them together, through a table of ones, subnormals and zeros.
TEST(UnboundedRow, ComposesInBandsWhatDoublesCannotHoldTogether) {
  Table table(3, 4);
  const std::vector<double> rows{1.0, 0.0, 0.0, least_subnormal, 1.0, 1.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0};
  std::copy(rows.begin(), rows.end(), table.data());
  UnboundedRow row(std::vector{1.0, 0.5, 0.25});
  row[1] = row[1] * ScaledNumber(1.0, -1000);
  row[2] = row[2] * ScaledNumber(1.0, -5000);
  UnboundedRow sum, max;
  Winners winners;
  sum.assign_composition(table, row, any_algebra<Sigma>(), nullptr);
  max.assign_composition(table, row, any_algebra<Max>(), &winners);
  for (const UnboundedRow* const result : {&sum, &max}) {
    EXPECT_EQ((*result)[0], ScaledNumber(1.0));
    EXPECT_EQ((*result)[1], ScaledNumber(1.0, -1001));
    EXPECT_EQ((*result)[2], ScaledNumber(1.0, -5002));
    EXPECT_EQ((*result)[3], ScaledNumber(1.0, -1002));  // ½ · 2^−1001, above 2^−1074
  }
  EXPECT_EQ(winners.first, (std::vector<Winners::Index>{0, 1, 2, 1}));
}

TEST(UnboundedRow, TakesTheFirstOfWinnersInTwoBands) {
  Table table(3, 1, 1.0);
  table(1, 0) = 0x1p-1000;
  UnboundedRow row(std::vector{1.0, 1.0, 1.0}), result;
  row[0] = row[0] * ScaledNumber(1.0, -1000);  // a tie with 1 · 2^−1000, of another band
  row[2] = ScaledNumber{};
  Winners winners;
  result.assign_composition(table, row, any_algebra<Max>(), &winners);
  EXPECT_EQ(winners.first, (std::vector<Winners::Index>{0}));
  EXPECT_EQ(result[0], ScaledNumber(1.0, -1000));
}

TEST(UnboundedRow, CarriesEvidenceBackInBands) {
  Table table(2, 3);
  const std::vector<double> rows{0.5, least_subnormal, 0.0, 0.0, 0.25, 0.75};
  std::copy(rows.begin(), rows.end(), table.data());
  UnboundedRow after(std::vector{0.0, 1.0, 0.5}), sum, max;
  after[2] = after[2] * ScaledNumber(1.0, -3000);
  sum.assign_carried_back(table, after, any_algebra<Sigma>());
  max.assign_carried_back(table, after, any_algebra<Max>());
  for (const UnboundedRow* const result : {&sum, &max}) {
    EXPECT_EQ((*result)[0], ScaledNumber(least_subnormal));
    EXPECT_EQ((*result)[1], ScaledNumber(0.25));
  }
}

TEST(UnboundedRow, OfZerosStaysZero) {
  const UnboundedRow row(std::vector{0.0, -0.0});
  EXPECT_TRUE(row.is_zero());
  UnboundedRow result;
  result.assign_composition(Table(2, 3, 1.0), row, any_algebra<Sigma>(), nullptr);
  EXPECT_EQ(result.size(), 3U);
  EXPECT_TRUE(result.is_zero());
  EXPECT_EQ(result.log_total(any_algebra<Sigma>()), log_zero);
}

TEST(UnboundedRow, OfGradesIsPlainMaxMin) {
  const UnboundedRow before(std::vector{0.5, 1.0});
  Table table(2, 2);
  table(0, 0) = 1.0, table(0, 1) = 0.25, table(1, 0) = 0.75, table(1, 1) = 0.5;
  Winners winners;
  UnboundedRow row, back;
  row.assign_composition(table, before, any_algebra<MaxMin>(), &winners);
  EXPECT_EQ(row[0], ScaledNumber{0.75});
  EXPECT_EQ(row[1], ScaledNumber{0.5});
  EXPECT_EQ(row.greatest(), 0U);
  ASSERT_EQ(winners.attempts.size(), 2U);
  for (const std::size_t k : {0U, 1U}) {  // the first attains ½ and ¼, the second more
    ASSERT_EQ(winners.attempts[k].size(), 2U);
    EXPECT_EQ(winners.attempts[k][0].index, 0U);
    EXPECT_EQ(winners.attempts[k][0].value, k == 0 ? 0.5 : 0.25);
    EXPECT_EQ(winners.attempts[k][1].index, 1U);
    EXPECT_EQ(winners.attempts[k][1].value, row[k].value());
  }
  back.assign_carried_back(table, before, any_algebra<MaxMin>());
  EXPECT_EQ(back[0], ScaledNumber{0.5});
  EXPECT_EQ(back[1], ScaledNumber{0.5});
}

}  // namespace kernels_unbounded_row_test
}  // namespace sigmax::kernels
