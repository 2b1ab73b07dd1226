#include <sigmax/hybrid/sound.hpp>

#include <gtest/gtest.h>

#include <limits>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/hybrid/components.hpp>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

const AnyModel model = dwna<1>(1.0);

TEST(Sound, AnEstimateIsFiniteAndItsVariancesAreNotNegative) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto sound = [](double x, double a, double b) {
    const Gaussian<2> estimate{Vector<2>(x, 0.0), SquareMatrix<2>{{a, 0.0}, {0.0, b}}};
    check::sound(model, detail::view(estimate));
  };
  EXPECT_NO_THROW(sound(1.0, 4.0, 0.0));
  EXPECT_NO_THROW(sound(1.0, 4.0, -1e-12)) << "that is rounding";
  EXPECT_TRUE(throws<std::domain_error>([&] { sound(1.0, 4.0, -1e-10); }, {"dwna", "not positive semi-definite"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { sound(nan, 4.0, 1.0); }, {"dwna", "not finite"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { sound(1.0, nan, 1.0); }, {"dwna", "not finite"}));
  EXPECT_TRUE(
      throws<std::domain_error>([&] { sound(1.0, std::numeric_limits<double>::infinity(), 1.0); }, {"not finite"}));
}

TEST(Sound, ThereIsAStartForEachModelOfItsSize) {
  const std::vector<AnyModel> models{dwna<1>(1.0), dwpa<1>(1.0)};
  Estimates starts = detail::estimates_of(models);
  EXPECT_NO_THROW(check::starts(models, starts));
  starts[1].covariance(2, 2) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { check::starts(models, starts); }, {"dwpa", "not finite"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { check::starts({model, model, model}, starts); }, {"3", "2"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { check::starts({model, model}, starts); }, {"dwna", "3", "2"}));
}

TEST(Sound, TheNumbersOfAnEntryPriorArePositive) {
  EXPECT_NO_THROW(check::prior({}));
  const auto refuses = [](const EntryPrior& prior, std::initializer_list<std::string_view> words) {
    EXPECT_TRUE(throws<std::invalid_argument>([&] { check::prior(prior); }, words));
  };
  refuses({.scales = {}}, {"no scale"});
  refuses({.scales = {3.0, -3.0}}, {"scale", "-3", "positive"});
  refuses({.vertical = 0.0}, {"vertical share", "0.0", "positive"});
  refuses({.turn_rate = std::numeric_limits<double>::infinity()}, {"turn rate", "inf"});
}

}  // namespace
}  // namespace sigmax
