#include <sigmax/hybrid/bank.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/fixed_step_motion.hpp>

namespace sigmax {
namespace {

using Dwna = IndependentAxes<3, DiscreteWhiteNoise<2>>;
using Dwpa = IndependentAxes<3, DiscreteWhiteNoise<3>>;
using Moves = AnyMotion<9, Dwna, Dwpa>;
using RunTime = AnyMember<Moves>;

static_assert(Bank<std::tuple<Dwna, Dwpa>>::axes == 3);
static_assert(Bank<std::tuple<Dwna, Dwpa>>::max_components == 15);
static_assert(std::is_same_v<Bank<std::tuple<Dwna, Dwpa>>::Estimates, std::tuple<Gaussian<6>, Gaussian<9>>>);
static_assert(Bank<std::tuple<FixedStepMotion<4>>>::axes == 0);

static_assert(Bank<std::vector<RunTime>>::axes == 3);
static_assert(Bank<std::vector<RunTime>>::max_components == 9);
static_assert(std::is_same_v<Bank<std::vector<RunTime>>::Estimates, std::vector<Gaussian<Eigen::Dynamic, 9>>>);

TEST(Bank, CountsItsModes) {
  static_assert(mode_count(std::tuple{1, 2.0, 'c'}) == 3);
  EXPECT_EQ(mode_count(std::vector{1, 2}), 2U);
  EXPECT_EQ(mode_count(std::vector<int>{}), 0U);
}

TEST(Bank, VisitsEveryModeInOrder) {
  std::vector<std::size_t> visited;
  for_each_mode(std::tuple{'a', 2, 3.0}, [&](auto j) { visited.push_back(j); });
  for_each_mode(std::vector{5, 6}, [&](auto j) { visited.push_back(j); });
  EXPECT_EQ(visited, (std::vector<std::size_t>{0, 1, 2, 0, 1}));
}

TEST(Bank, GivesTheEntryOfEachMode) {
  std::tuple<int, double> different{1, 2.5};
  std::vector<int> alike{7, 8};
  double sum = 0.0;
  for_each_mode(different, [&](auto j) { sum += static_cast<double>(mode(different, j)); });
  for_each_mode(alike, [&](auto j) { mode(alike, j) += 10; });
  EXPECT_EQ(sum, 3.5);
  EXPECT_EQ(alike, (std::vector{17, 18}));
  const auto& constant = different;
  EXPECT_EQ(mode(constant, std::integral_constant<std::size_t, 1>{}), 2.5);
}

TEST(Bank, MakesRoomForOneEstimateOfEachModel) {
  static_assert(std::is_same_v<decltype(detail::estimates_for(std::declval<const std::tuple<Dwna, Dwpa>&>())),
                               std::tuple<Gaussian<6>, Gaussian<9>>>);
  EXPECT_EQ(
      detail::estimates_for(std::vector<RunTime>{Extended<Moves>{dwna<3>(1.0)}, Extended<Moves>{dwpa<3>(1.0)}}).size(),
      2U);
}

}  // namespace
}  // namespace sigmax
