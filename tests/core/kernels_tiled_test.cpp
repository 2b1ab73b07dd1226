#ifdef SIGMAX_WITH_HIGHWAY
#include "kernels/targets.hpp"  // before it: which of them the kernels are compiled for

#include <hwy/targets.h>
#endif

#include "kernels/exponential.hpp"
#include "kernels/narrow.hpp"
#include "kernels/tiled.hpp"
#include "support/drawn_tables.hpp"

namespace kernels_tiled_test {

using namespace drawn_tables;

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

std::string name_of([[maybe_unused]] std::int64_t set) {
#ifdef SIGMAX_WITH_HIGHWAY
  return hwy::TargetName(set);
#else
  return "PlainLoops";
#endif
}

class Tiled : public testing::TestWithParam<std::int64_t> {
 protected:
#ifdef SIGMAX_WITH_HIGHWAY
  void SetUp() override {
    hwy::SetSupportedTargetsForTest(GetParam());
    ASSERT_EQ(hwy::SupportedTargets() & GetParam(), GetParam()) << "the machine has it, but it is not taken";
  }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
#endif
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, Tiled, testing::ValuesIn(instruction_sets()),
                         [](const auto& test) { return name_of(test.param); });

struct Size {
  std::size_t rows, inner, columns;
};
/// Whole tiles, tiles and a rest, more than a block; and as many sizes again drawn at random, of which some are too
/// small for tiles.
const std::vector<Size> sizes = [] {
  std::vector<Size> all{{4, 32, 8},   {8, 8, 8},     {5, 13, 11},   {16, 16, 16},  {7, 129, 9},
                        {65, 33, 31}, {23, 40, 145}, {9, 130, 160}, {33, 513, 29}, {6, 20, 260}};
  std::mt19937_64 bits(5);
  for (int i = 0; i < 40; ++i) all.push_back({1 + bits() % 30, 1 + bits() % 40, 1 + bits() % 60});
  return all;
}();

std::string at(const Size& size, std::size_t k) {
  return std::to_string(size.rows) + " × " + std::to_string(size.inner) + " × " + std::to_string(size.columns) +
         ", number " + std::to_string(k);
}

/// Composes and compares: to the bit from the least normal number up, below to the last place.
template <class A, class Add>
void expect_as_defined(Draw draw, Add add) {
  for (const Size& size : sizes) {
    const Table right = drawn(size.rows, size.inner, draw, 1), left = drawn(size.inner, size.columns, draw, 2);
    const Table expected = defined(left, right, add);
    Table result(0, 0);
    kernels::compose<A>(left, right, result);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const double number = expected.data()[k];
      const double allowed = number == 0.0 || number >= least_normal ? 0.0 : last_place;
      ASSERT_TRUE(result.data()[k] == number || std::abs(result.data()[k] - number) <= allowed) << at(size, k);
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
  for (const Draw draw : {uniform, tied, wide, subnormal}) expect_as_defined<MaxMin>(draw, max_min);
}

TEST_P(Tiled, SumsAreThoseOfTheDefinitionToRounding) {
  for (const Draw draw : {uniform, tied, wide, subnormal, positive_with_infinities})
    for (const Size& size : sizes) {
      const Table right = drawn(size.rows, size.inner, draw, 1), left = drawn(size.inner, size.columns, draw, 2);
      const Table expected = defined(left, right, summed);
      Table result(0, 0);
      kernels::compose<Sigma>(left, right, result);
      const auto terms = static_cast<double>(size.inner);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const double number = expected.data()[k], found = result.data()[k];
        ASSERT_TRUE(found == number || std::abs(found - number) <= terms * (0x1p-52 * number + last_place))
            << at(size, k) << ": " << found << ", not " << number;
      }
    }
}

/// Logarithms as they are of normalised numbers and of others, zero among them, and of numbers that are subnormal.
double log_of_some(std::mt19937_64& bits) {
  return bits() % 9 == 0 ? -infinity : -std::ldexp(uniform(bits), static_cast<int>(bits() % 11));
}
double tied_log(std::mt19937_64& bits) { return -static_cast<double>(bits() % 3); }
double log_of_subnormal(std::mt19937_64& bits) { return -700.0 - 50.0 * uniform(bits); }
double nearly_none(std::mt19937_64& bits) {
  return bits() % 2 == 0 ? -0.0 : -static_cast<double>(bits() % 9) * last_place;
}
double none(std::mt19937_64&) { return -infinity; }

TEST_P(Tiled, ExponentialsAreWithinTwoPlaces) {
  std::mt19937_64 bits(1);
  for (const Draw draw : {log_of_some, tied_log, log_of_subnormal, nearly_none, none})
    for (const std::size_t n : {1U, 2U, 7U, 31U, 32U, 33U, 47U, 48U, 63U, 65U, 127U, 1000U, 1001U}) {
      std::vector<double> logs(n);
      for (double& log : logs) log = draw(bits);
      long double sum = 0.0L;
      for (const double log : logs) sum += std::exp(static_cast<long double>(log));
      const auto expected = static_cast<double>(sum), terms = static_cast<double>(n);
      EXPECT_NEAR(kernels::sum_of_exponentials(logs), expected,
                  expected * (2.0 + std::log2(terms)) * 0x1p-52 + 2.0 * terms * last_place)
          << n;
      EXPECT_EQ(kernels::greatest(logs), *std::max_element(logs.begin(), logs.end())) << n;
    }
}

/// Tables of few columns have a kernel of their own, which is the plain loop, the same for every instruction set.
TEST(Narrow, TablesAreComposedAsDefinedToTheBit) {
  for (std::size_t columns = 1; columns <= kernels::narrow_columns; ++columns)
    for (const auto& [rows, inner] : {std::pair{1U, 1U}, {1U, 7U}, {3U, 5U}, {2U, 33U}})
      for (const Draw draw : {uniform, tied, wide, subnormal, positive_with_infinities}) {
        const Table right = drawn(rows, inner, draw, 1), left = drawn(inner, columns, draw, 2);
        Table result(0, 0);
        kernels::compose<Sigma>(left, right, result);
        EXPECT_TRUE(std::ranges::equal(result.values(), defined(left, right, summed).values())) << columns;
        kernels::compose<Max>(left, right, result);
        EXPECT_TRUE(std::ranges::equal(result.values(), defined(left, right, max_of).values())) << columns;
        kernels::compose<MaxMin>(left, right, result);
        EXPECT_TRUE(std::ranges::equal(result.values(), defined(left, right, max_min).values())) << columns;
      }
}

TEST_P(Tiled, TheArithmeticOfTheCallerStaysAsItWas) {
  const Table right = drawn(16, 16, wide, 1), left = drawn(16, 16, wide, 2);
  Table result(0, 0);
  kernels::compose<Max>(left, right, result);
  volatile double least = least_normal;
  EXPECT_EQ(least / 2.0, 0x1p-1023);
}

}  // namespace kernels_tiled_test
