#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#ifdef SIGMAX_WITH_HIGHWAY
#include "kernels/targets.hpp"  // before it: which of them the kernels are compiled for

#include <hwy/targets.h>
#endif

#include <sigmax/core/kernels/dense.hpp>
#include <sigmax/core/kernels/exponential.hpp>

namespace sigmax {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_normal = std::numeric_limits<double>::min(), last_place = 0x1p-1074;

/// Every instruction set of the machine that the kernels are compiled for; without Highway there are only plain loops.
std::vector<std::int64_t> instruction_sets() {
  std::vector<std::int64_t> sets;
#ifdef SIGMAX_WITH_HIGHWAY
  sets = hwy::SupportedAndGeneratedTargets();
#else
  sets.push_back(0);
#endif
  return sets;
}

class Tiled : public testing::TestWithParam<std::int64_t> {
 protected:
#ifdef SIGMAX_WITH_HIGHWAY
  void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
#endif
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, Tiled, testing::ValuesIn(instruction_sets()));

struct Size {
  std::size_t rows, inner, columns;
};
const std::vector<Size> sizes{{4, 32, 8},   {8, 8, 8},     {5, 13, 11},   {16, 16, 16},  {7, 129, 9},
                              {65, 33, 31}, {23, 40, 145}, {9, 130, 160}, {33, 513, 29}, {6, 20, 260}};

/// How the numbers of a table are drawn.
using Draw = double (*)(std::mt19937_64&);
double uniform(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1p-53; }
double tied(std::mt19937_64& bits) { return static_cast<double>(bits() % 4) / 4.0; }
double with_infinities(std::mt19937_64& bits) { return bits() % 50 == 0 ? infinity : tied(bits); }
double wide(std::mt19937_64& bits) {  // half of all products are subnormal, or smaller
  return bits() % 5 == 0 ? 0.0 : std::ldexp(uniform(bits), -static_cast<int>(bits() % 1060));
}
double subnormal(std::mt19937_64& bits) { return bits() % 3 == 0 ? 1.0 : static_cast<double>(bits() % 9) * last_place; }

Table drawn(std::size_t rows, std::size_t columns, Draw draw, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  Table table(rows, columns);
  for (double& number : table.values()) number = draw(bits);
  return table;
}

double summed(double sum, double weight, double value) { return sum + weight * value; }
double max_of(double sum, double weight, double value) { return weight * value > sum ? weight * value : sum; }
double max_min(double sum, double weight, double value) { return std::max(sum, std::min(weight, value)); }

/// The definition, one number after the other, with the first index that raised it last.
template <class Add>
Table defined(const Table& left, const Table& right, Add add, std::vector<kernels::Winner>& first) {
  Table result(right.rows(), left.columns(), 0.0);
  first.assign(result.size(), 0);
  for (std::size_t i = 0; i < right.rows(); ++i)
    for (std::size_t k = 0; k < left.columns(); ++k)
      for (std::size_t j = 0; j < left.rows(); ++j) {
        const double next = add(result(i, k), right(i, j), left(j, k));
        if (next != result(i, k)) first[i * left.columns() + k] = static_cast<kernels::Winner>(j);
        result(i, k) = next;
      }
  return result;
}

std::string at(const Size& size, std::size_t k) {
  return std::to_string(size.rows) + " × " + std::to_string(size.inner) + " × " + std::to_string(size.columns) +
         ", number " + std::to_string(k);
}

/// Composes with and without winners, and compares: to the bit from the least normal number up, below to the last
/// place.
template <class A, class Add>
void expect_as_defined(Draw draw, Add add) {
  for (const Size& size : sizes) {
    const Table right = drawn(size.rows, size.inner, draw, 1), left = drawn(size.inner, size.columns, draw, 2);
    std::vector<kernels::Winner> first;
    const Table expected = defined(left, right, add, first);
    Table plain(0, 0), result(0, 0);
    kernels::compose<A>(left, right, plain);
    kernels::FirstWinners winners;
    kernels::compose<A>(left, right, result, winners);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const double number = expected.data()[k];
      ASSERT_EQ(plain.data()[k], result.data()[k]) << at(size, k);
      if (number == 0.0 || number >= least_normal) {
        ASSERT_EQ(result.data()[k], number) << at(size, k);
        ASSERT_EQ(winners.all[k], first[k]) << at(size, k);
      } else {
        ASSERT_LE(std::abs(result.data()[k] - number), last_place) << at(size, k);
        const std::size_t i = k / size.columns, won = winners.all[k];
        ASSERT_LE(std::abs(add(0.0, right(i, won), left(won, k % size.columns)) - number), last_place) << at(size, k);
      }
    }
  }
}

TEST_P(Tiled, MaximaAreThoseOfTheDefinitionToTheBit) {
  for (const Draw draw : {uniform, tied, with_infinities}) expect_as_defined<Max>(draw, max_of);
}

TEST_P(Tiled, MaximaOfWhatUnderflowsAreNotLost) {
  for (const Draw draw : {wide, subnormal}) expect_as_defined<Max>(draw, max_of);
}

TEST_P(Tiled, GradesAreThoseOfTheDefinitionToTheBit) {
  for (const Draw draw : {uniform, tied, wide}) expect_as_defined<MaxMin>(draw, max_min);
}

TEST_P(Tiled, SumsAreThoseOfTheDefinitionToRounding) {
  for (const Draw draw : {uniform, tied, wide, subnormal})
    for (const Size& size : sizes) {
      const Table right = drawn(size.rows, size.inner, draw, 1), left = drawn(size.inner, size.columns, draw, 2);
      std::vector<kernels::Winner> last;
      const Table expected = defined(left, right, summed, last);
      Table result(0, 0);
      kernels::compose<Sigma>(left, right, result);
      const auto terms = static_cast<double>(size.inner);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const double number = expected.data()[k];
        ASSERT_LE(std::abs(result.data()[k] - number), terms * (0x1p-52 * number + last_place)) << at(size, k);
      }
    }
}

TEST_P(Tiled, SumsMayBeInfinite) {
  Table right(8, 16, 0.5), left(16, 9, 0.5);
  left(3, 2) = infinity;
  Table result(0, 0);
  kernels::compose<Sigma>(left, right, result);
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(result(i, k), k == 2 ? infinity : 4.0);
}

TEST_P(Tiled, ExponentialsAreWithinTwoPlaces) {
  std::mt19937_64 bits(1);
  for (const std::size_t n : {32U, 33U, 47U, 1000U}) {
    std::vector<double> logs(n);
    for (double& log : logs)
      log = bits() % 9 == 0 ? -infinity : -std::ldexp(uniform(bits), static_cast<int>(bits() % 11));
    logs[n / 2] = 0.0;
    long double sum = 0.0L;
    for (const double log : logs) sum += std::exp(static_cast<long double>(log));
    const auto expected = static_cast<double>(sum);
    EXPECT_NEAR(kernels::sum_of_exponentials(logs), expected, expected * (2.0 + std::log2(n)) * 0x1p-52) << n;
    EXPECT_EQ(kernels::greatest(logs), 0.0);
  }
}

/// Tables of few columns have a kernel of their own, which is the plain loop.
TEST(Narrow, TablesAreComposedAsDefinedToTheBit) {
  for (std::size_t columns = 1; columns <= kernels::narrow_columns; ++columns)
    for (const Draw draw : {uniform, tied, wide, subnormal}) {
      const Table right = drawn(3, 5, draw, 1), left = drawn(5, columns, draw, 2);
      std::vector<kernels::Winner> last;
      Table result(0, 0);
      kernels::compose<Sigma>(left, right, result);
      EXPECT_TRUE(std::ranges::equal(result.values(), defined(left, right, summed, last).values())) << columns;
      kernels::compose<Max>(left, right, result);
      EXPECT_TRUE(std::ranges::equal(result.values(), defined(left, right, max_of, last).values())) << columns;
      kernels::compose<MaxMin>(left, right, result);
      EXPECT_TRUE(std::ranges::equal(result.values(), defined(left, right, max_min, last).values())) << columns;
    }
}

TEST_P(Tiled, TheArithmeticOfTheCallerStaysAsItWas) {
  const Table right = drawn(16, 16, wide, 1), left = drawn(16, 16, wide, 2);
  Table result(0, 0);
  kernels::compose<Max>(left, right, result);
  volatile double least = least_normal;
  EXPECT_EQ(least / 2.0, 0x1p-1023);
}

}  // namespace
}  // namespace sigmax
