#include <sigmax/hybrid/sound.hpp>

#include <gtest/gtest.h>

#include <limits>

#include <sigmax/estimation/discrete_white_noise.hpp>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

const auto model = dwna<1>(1.0);

TEST(Sound, AnEstimateIsFiniteAndItsVariancesAreNotNegative) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto of = [](double x, double a, double b) {
    return Gaussian<2>{Vector<2>(x, 0.0), SquareMatrix<2>{{a, 0.0}, {0.0, b}}};
  };
  EXPECT_NO_THROW(check::sound(model, of(1.0, 4.0, 0.0)));
  EXPECT_NO_THROW(check::sound(model, of(1.0, 4.0, -1e-12))) << "that is rounding";
  EXPECT_TRUE(throws<std::domain_error>([&] { check::sound(model, of(1.0, 4.0, -1e-10)); },
                                        {"dwna", "not positive semi-definite"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { check::sound(model, of(nan, 4.0, 1.0)); }, {"dwna", "not finite"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { check::sound(model, of(1.0, nan, 1.0)); }, {"dwna", "not finite"}));
  EXPECT_TRUE(throws<std::domain_error>(
      [&] { check::sound(model, of(1.0, std::numeric_limits<double>::infinity(), 1.0)); }, {"not finite"}));
}

TEST(Sound, ThereIsAStartForEachModelOfItsSize) {
  const std::tuple models{dwna<1>(1.0), dwpa<1>(1.0)};
  const Gaussian<2> narrow{Vector<2>::Zero(), SquareMatrix<2>::Identity()};
  Gaussian<3> wide{Vector<3>::Zero(), SquareMatrix<3>::Identity()};
  EXPECT_NO_THROW(check::starts(models, std::tuple{narrow, wide}));
  wide.covariance(2, 2) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        check::starts(models, std::tuple{narrow, wide});
      },
      {"dwpa", "not finite"}));
  const std::vector alike{dwna<1>(1.0), dwna<1>(2.0)};
  EXPECT_TRUE(throws<std::invalid_argument>([&] { check::starts(alike, std::vector{narrow}); }, {"2", "1"}));
}

}  // namespace
}  // namespace sigmax
