#include "support/sigmax.hpp"

namespace equal_frequency_fit_test {

using Values = std::vector<double>;

struct Fitted {
  Values cuts;
  int passes = 0;
};

Fitted fitted(const Values& values, std::size_t bins) {
  EqualFrequencyFit fit(bins);
  Fitted result;
  do {
    for (const double value : values) fit.see(value);
    ++result.passes;
  } while (fit.wants_another_pass());
  const Discretization found = fit.discretization();
  result.cuts.assign(found.cuts().begin(), found.cuts().end());
  return result;
}

Values cuts(const Discretization& bins) { return {bins.cuts().begin(), bins.cuts().end()}; }

/// Values of several shapes: close ones, of either sign, over all magnitudes, with many ties.
Values drawn(int shape, std::size_t count, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  Values values;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = normal(generator);
    switch (shape) {
      case 0:
        values.push_back(1000.0 + 1e-9 * x);
        break;
      case 1:
        values.push_back(x);
        break;
      case 2:
        values.push_back(std::copysign(std::exp(100.0 * x), normal(generator)));
        break;
      case 3:
        values.push_back(std::round(x));
        break;
      case 4:
        values.push_back(x < 1.2 ? 0.0 : x);  // most are the least
        break;
      default:
        values.push_back(i % 7 == 3 ? not_a_number : std::round(30.0 * x) / 10.0);
    }
  }
  return values;
}

TEST(EqualFrequencyFit, FindsTheCutsOfEqualFrequencyExactly) {
  std::mt19937_64 generator(5);
  for (const int shape : {0, 1, 2, 3, 4, 5})
    for (const std::size_t count : {2U, 9U, 8192U, 8193U, 60000U})
      for (const std::size_t bins : {1U, 2U, 8U, 300U}) {
        SCOPED_TRACE(testing::Message() << "shape " << shape << ", " << count << " values, " << bins << " bins");
        Values values = drawn(shape, count, generator);
        values.back() = 7.5;  // another one, however they are rounded
        const Fitted found = fitted(values, bins);
        EXPECT_EQ(found.cuts, cuts(equal_frequency(values, bins)));
        EXPECT_LE(found.passes, count <= 8192U ? 1 : 9);
      }
}

TEST(EqualFrequencyFit, NeedsFewPassesForFewDifferentValues) {
  std::mt19937_64 generator(5);
  EXPECT_LE(fitted(drawn(3, 100000, generator), 8).passes, 4);
  EXPECT_LE(fitted(drawn(1, 100000, generator), 8).passes, 4);
}

TEST(EqualFrequencyFit, KnowsHowManyValuesThereAreAndTheirEnds) {
  EqualFrequencyFit fit(2);
  EXPECT_TRUE(std::isnan(fit.least()) && std::isnan(fit.greatest()));
  do {
    for (int i = 0; i < 10000; ++i) fit.see(i == 5 ? NAN : 100.0 - i);
  } while (fit.wants_another_pass());
  EXPECT_EQ(fit.size(), 9999U);
  EXPECT_EQ(fit.least(), -9899.0);
  EXPECT_EQ(fit.greatest(), 100.0);
}

TEST(EqualFrequencyFit, CountsNothingTwiceWhereOthersWantAnotherPass) {
  for (const std::size_t bins : {1U, 3U, 8U}) {
    EqualFrequencyFit fit(bins);
    for (int pass = 0; pass < 3; ++pass) {
      for (int i = 0; i < 100; ++i) fit.see(i % 5);
      EXPECT_FALSE(fit.wants_another_pass());
      EXPECT_EQ(fit.size(), 100U);
      const Discretization found = fit.discretization();
      EXPECT_EQ(cuts(found), bins == 1 ? Values{} : bins == 3 ? (Values{1.0, 3.0}) : (Values{1.0, 2.0, 3.0, 4.0}));
    }
  }
}

TEST(EqualFrequencyFit, GivesOneBinWhereNoTwoValuesDiffer) {
  EXPECT_TRUE(fitted({}, 4).cuts.empty());
  EXPECT_TRUE(fitted({NAN, NAN}, 4).cuts.empty());
  EXPECT_TRUE(fitted(Values(20000, 2.5), 4).cuts.empty());
  EXPECT_TRUE(fitted({0.0, -0.0}, 4).cuts.empty());
}

TEST(EqualFrequencyFit, RefusesWhatCannotBeFitted) {
  EXPECT_INVALID(("at least one bin"), EqualFrequencyFit(0));
  EqualFrequencyFit fit(4);
  EXPECT_INVALID(("infinite"), fit.see(INFINITY));
  for (int i = 0; i < 20000; ++i) fit.see(i);
  ASSERT_TRUE(fit.wants_another_pass());
  fit.see(1.0);
  EXPECT_REFUSED(std::logic_error, ("other values"), fit.wants_another_pass());
}

}  // namespace equal_frequency_fit_test
