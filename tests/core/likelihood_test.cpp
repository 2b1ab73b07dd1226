#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <limits>
#include <stdexcept>
#include <vector>

#include <sigmax/core/likelihood.hpp>

#include "support/near.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::near;
using support::throws;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

const RandomVariable emitter{"emitter", {"e1", "e2", "e3"}};

static_assert(!std::convertible_to<RandomVariable, Likelihood<Random>>);
static_assert(!std::constructible_from<Likelihood<Random>, FuzzyVariable, std::vector<double>>);

TEST(Likelihood, IsKeptAsLogarithmsAndNeverNormalized) {
  const Likelihood likelihood{emitter, {2.0, 0.5, 0.0}};
  EXPECT_EQ(likelihood.size(), 3U);
  EXPECT_EQ(likelihood.log(0), std::log(2.0));
  EXPECT_EQ(likelihood.log(2), -infinity);
  EXPECT_PRED_FORMAT3(near, likelihood["e1"], 2.0, 1e-15);
  EXPECT_PRED_FORMAT3(near, likelihood[1], 0.5, 1e-15);
  EXPECT_EQ(likelihood["e3"], 0.0);
}

TEST(Likelihood, OfNoEvidenceIsOneEverywhere) {
  const Likelihood likelihood{emitter};
  for (std::size_t i = 0; i < likelihood.size(); ++i) EXPECT_EQ(likelihood[i], 1.0);
}

TEST(Likelihood, MayBeSetByItsLogarithmBeyondWhatANumberHolds) {
  Likelihood likelihood{emitter};
  likelihood.set_log(0, -1e6);
  likelihood.set_log(1, -infinity);
  likelihood.set_log(2, std::numeric_limits<double>::max());
  EXPECT_EQ(likelihood.log(0), -1e6);
  EXPECT_EQ(likelihood.log(1), -infinity);
  EXPECT_EQ(likelihood.log(2), std::numeric_limits<double>::max());
}

TEST(Likelihood, KeepsSubnormalAndHugeValues) {
  const Likelihood likelihood{emitter,
                              {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(), 1.0}};
  EXPECT_PRED_FORMAT3(near, likelihood.log(0), -1074.0 * std::log(2.0), 1e-14);
  EXPECT_PRED_FORMAT3(near, likelihood.log(1), 1024.0 * std::log(2.0), 1e-14);
}

TEST(Likelihood, RefusesNegativeInfiniteAndMissingValues) {
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        Likelihood(emitter, {1.0, -0.5, 0.0});
      },
      {"'emitter'", "'e2'", "-0.5", "finite and not negative"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        Likelihood(emitter, {1.0, infinity, 0.0});
      },
      {"'emitter'", "'e2'", "inf"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        Likelihood(emitter, {1.0, 0.0, nan});
      },
      {"'emitter'", "'e3'", "nan"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        Likelihood(emitter, {1.0, 0.0});
      },
      {"'emitter'", "3 outcomes", "2 values"}));
}

TEST(Likelihood, RefusesALogarithmOfNoNumberAndStaysAsItWas) {
  Likelihood likelihood{emitter};
  EXPECT_TRUE(throws<std::invalid_argument>([&] { likelihood.set_log(1, nan); }, {"'emitter'", "'e2'"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { likelihood.set_log(2, infinity); }, {"'emitter'", "'e3'"}));
  EXPECT_EQ(likelihood.log(1), 0.0);
  EXPECT_EQ(likelihood.log(2), 0.0);
}

}  // namespace
}  // namespace sigmax
