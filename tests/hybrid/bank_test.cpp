#include "support/sigmax.hpp"

namespace bank_test {

using Dwna = IndependentAxes<2, DiscreteWhiteNoise<2>>;
using Dwpa = IndependentAxes<2, DiscreteWhiteNoise<3>>;
using Pair = std::tuple<Dwna, Dwpa>;

static_assert(Bank<Pair>::axes == 2);
static_assert(Bank<Pair>::max_components == 10);
static_assert(std::is_same_v<Bank<Pair>::Estimates, std::tuple<Gaussian<4>, Gaussian<6>>>);
static_assert(Bank<std::tuple<FixedStepMotion<4>>>::axes == 0);
static_assert(Bank<std::vector<Dwpa>>::axes == 2 && Bank<std::vector<Dwpa>>::max_components == 6);
static_assert(Bank<std::vector<AnyModel>>::axes == Eigen::Dynamic && Bank<std::vector<AnyModel>>::max_components == 32);

static_assert(SensorOfBank<PositionSensor<2>, Pair> && SensorOfBank<PositionSensor<2>, std::vector<AnyModel>>);
static_assert(!SensorOfBank<PositionSensor<3>, Pair>);
static_assert(SensorOfBank<LinearSensor<6, 4>, Pair>);
static_assert(!SensorOfBank<LinearSensor<1, 5>, Pair>, "DWNA has four components");
static_assert(!SensorOfBank<LinearSensor<7, 4>, Pair> && !SensorOfBank<LinearSensor<7, 4>, std::vector<AnyModel>>,
              "seven quantities");

TEST(Bank, IsOneVectorWhateverItWasFilledBy) {
  const std::vector<AnyModel> of_tuple = detail::bank_of(Pair{dwna<2>(1.0), dwpa<2>(2.0)});
  ASSERT_EQ(of_tuple.size(), 2U);
  EXPECT_EQ(of_tuple[1].name(), "dwpa");
  EXPECT_EQ(of_tuple[1].axes(), 2);
  const std::vector<AnyModel> of_vector = detail::bank_of(std::vector{dwna<2>(1.0), dwna<2>(3.0)});
  ASSERT_EQ(of_vector.size(), 2U);
  EXPECT_EQ(of_vector[0].size(), 4);
  EXPECT_EQ(detail::bank_of(of_vector)[0].ref().motion, of_vector[0].ref().motion) << "a handle";
}

}  // namespace bank_test
