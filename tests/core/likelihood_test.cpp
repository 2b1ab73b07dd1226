#include "support/core.hpp"

namespace likelihood_test {

const RandomVariable emitter{"emitter", {"e1", "e2", "e3"}};

static_assert(!std::convertible_to<RandomVariable, Likelihood<Random>>);
static_assert(!std::constructible_from<Likelihood<Random>, FuzzyVariable, std::vector<double>>);

TEST(Likelihood, IsKeptAsLogarithmsAndNeverNormalized) {
  const Likelihood likelihood{emitter, {2.0, 0.5, 0.0}};
  EXPECT_EQ(likelihood.size(), 3U);
  EXPECT_EQ(likelihood.log(0), std::log(2.0));
  EXPECT_EQ(likelihood.log(2), -infinity);
  EXPECT_CLOSE(likelihood["e1"], 2.0, 1e-15);
  EXPECT_CLOSE(likelihood[1], 0.5, 1e-15);
  EXPECT_EQ(likelihood["e3"], 0.0);
}

TEST(Likelihood, OfNoEvidenceIsOneEverywhere) {
  const Likelihood likelihood{emitter};
  for (std::size_t i = 0; i < likelihood.size(); ++i) EXPECT_EQ(likelihood[i], 1.0);
}

TEST(Likelihood, KeepsSubnormalAndHugeValues) {
  const Likelihood likelihood{emitter, {least_subnormal, std::numeric_limits<double>::max(), 1.0}};
  EXPECT_CLOSE(likelihood.log(0), -1074.0 * std::log(2.0), 1e-14);
  EXPECT_CLOSE(likelihood.log(1), 1024.0 * std::log(2.0), 1e-14);
}

TEST(Likelihood, RefusesNegativeInfiniteAndMissingValues) {
  EXPECT_INVALID(("'emitter'", "'e2'", "-0.5", "finite and not negative"), Likelihood(emitter, {1.0, -0.5, 0.0}));
  EXPECT_INVALID(("'emitter'", "'e2'", "inf"), Likelihood(emitter, {1.0, infinity, 0.0}));
  EXPECT_INVALID(("'emitter'", "'e3'", "nan"), Likelihood(emitter, {1.0, 0.0, not_a_number}));
  EXPECT_INVALID(("'emitter'", "3 outcomes", "2 values"), Likelihood(emitter, {1.0, 0.0}));
}

TEST(Likelihood, HoldsNumbersExactly) {
  const RandomVariable x{"x", 1000};
  std::vector<double> thousandths(1000);
  for (std::size_t k = 0; k < 1000; ++k) thousandths[k] = static_cast<double>(k) / 1000.0;
  const Likelihood likelihood{x, thousandths};
  for (std::size_t k = 0; k < 1000; ++k) ASSERT_EQ(likelihood[k], thousandths[k]);
  EXPECT_EQ(likelihood.log(125), std::log(0.125));
  EXPECT_EQ(likelihood.at(125), 0.125);
  EXPECT_INVALID(("'x'", "1000"), likelihood.at(1000));
}

TEST(Likelihood, GivenALogarithmKeepsLogarithms) {
  Likelihood likelihood{emitter, {0.125, 0.0, 1.0}};
  likelihood.set_log(2, -2000.0);
  EXPECT_EQ(likelihood.log(2), -2000.0);
  EXPECT_EQ(likelihood.log(0), std::log(0.125));
  EXPECT_TRUE(likelihood.excludes(1));
  EXPECT_FALSE(likelihood.excludes(2));
  EXPECT_EQ(likelihood[2], 0.0);
  EXPECT_CLOSE(likelihood.number(2).log(), -2000.0, 1e-15);
}

TEST(Likelihood, RefusesALogarithmOfNoNumberAndStaysAsItWas) {
  Likelihood likelihood{emitter};
  EXPECT_INVALID(("'emitter'", "'e2'"), likelihood.set_log(1, not_a_number));
  EXPECT_INVALID(("'emitter'", "'e3'"), likelihood.set_log(2, infinity));
  EXPECT_EQ(likelihood.log(1), 0.0);
  EXPECT_EQ(likelihood.log(2), 0.0);
  EXPECT_NO_THROW(likelihood.set_log(2, std::numeric_limits<double>::max()));
}

}  // namespace likelihood_test
