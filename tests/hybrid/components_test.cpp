#include <sigmax/hybrid/components.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/fixed_step_motion.hpp>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

using Names = std::vector<std::string>;

template <int N>
FixedStepMotion<N> with(const Names& names) {
  return {"any", names, 1.0, SquareMatrix<N>::Identity(), SquareMatrix<N>::Identity()};
}

using Models = std::tuple<FixedStepMotion<2>, FixedStepMotion<3>, FixedStepMotion<3>>;
const Models models{with<2>({"x", "vx"}), with<3>({"x", "vx", "omega"}), with<3>({"bias", "x", "vx"})};

TEST(Components, ThoseOfTheLargestModelLead) {
  const Components<Models> components(models);
  EXPECT_EQ(components.names(), (Names{"x", "vx", "omega", "bias"}));
  EXPECT_EQ(components.of_all()[2].in_source, (std::vector<Eigen::Index>{1, 2, -1, 0}));
  EXPECT_EQ(components.of_model(0)[2].in_source, (std::vector<Eigen::Index>{1, 2}));
  EXPECT_EQ(components.of_model(1)[0].in_source, (std::vector<Eigen::Index>{0, 1, -1}));
}

TEST(Components, EveryModelTakesItsShareOfAStart) {
  const Components<Models> components(models);
  const Gaussian<4> start{Vector<4>(1, 2, 3, 4),
                          SquareMatrix<4>{{10, 1, 2, 3}, {1, 20, 4, 5}, {2, 4, 30, 6}, {3, 5, 6, 40}}};
  const auto shares = components.shares(models, start);
  EXPECT_EQ(std::get<0>(shares).mean, (Vector<2>(1, 2)));
  EXPECT_EQ(std::get<1>(shares).covariance, (SquareMatrix<3>{{10, 1, 2}, {1, 20, 4}, {2, 4, 30}}));
  EXPECT_EQ(std::get<2>(shares).mean, (Vector<3>(4, 1, 2)));
  EXPECT_EQ(std::get<2>(shares).covariance, (SquareMatrix<3>{{40, 3, 5}, {3, 10, 1}, {5, 1, 20}}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        components.shares(models, Gaussian<2>{Vector<2>::Zero(), SquareMatrix<2>::Identity()});
      },
      {"2", "4"}));
}

TEST(Components, EachIsCarriedByTheModelThatWasChosenForIt) {
  const Components<Models> components(models);
  const std::tuple estimates{Gaussian<2>{Vector<2>(1, 2), SquareMatrix<2>{{1, 0.5}, {0.5, 2}}},
                             Gaussian<3>{Vector<3>(3, 4, 5), SquareMatrix<3>::Constant(7.0)},
                             Gaussian<3>{Vector<3>(6, 7, 8), SquareMatrix<3>::Constant(9.0)}};
  const auto first_that_has_it = [](const auto& has) {
    std::size_t l = 0;
    while (!has(l)) ++l;
    return l;
  };
  const auto found = components.carried(estimates, first_that_has_it);
  EXPECT_EQ(found.mean, (Vector<4>(1, 2, 5, 6)));
  EXPECT_EQ(found.covariance, (SquareMatrix<4>{{1, 0.5, 0, 0}, {0.5, 2, 0, 0}, {0, 0, 7, 0}, {0, 0, 0, 9}}));
}

TEST(Components, MoreThanTheirTypeAllowsAreRefused) {
  using Alike = std::vector<FixedStepMotion<2>>;
  const Alike different{with<2>({"x", "vx"}), with<2>({"x", "omega"})};
  EXPECT_TRUE(throws<std::invalid_argument>([&] { Components<Alike>{different}; }, {"3 different components", "2"}));
}

}  // namespace
}  // namespace sigmax
