#include <sigmax/hybrid/mixture.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/hybrid/collapse.hpp>

#include "support/matrices.hpp"

namespace sigmax {
namespace {

using support::near_matrix;

const auto weight = [](std::size_t l) { return l == 0 ? 0.25 : 0.75; };
const Gaussian<1> first{Vector<1>(1.0), SquareMatrix<1>(2.0)}, second{Vector<1>(5.0), SquareMatrix<1>(4.0)};

TEST(Mixture, OfEstimatesOfOneModelCollapsesToItsMomentsOrToOneOfThem) {
  const std::vector estimates{first, second};
  Gaussian<1> result = first;
  collapse(MomentMatching{}, EstimateMixture<Gaussian<1>>{estimates}, weight, 1, result);
  EXPECT_DOUBLE_EQ(result.mean(0), 4.0);
  EXPECT_DOUBLE_EQ(result.covariance(0), 0.25 * (2.0 + 9.0) + 0.75 * (4.0 + 1.0));
  collapse(Selection{}, EstimateMixture<Gaussian<1>>{estimates}, weight, 1, result);
  EXPECT_EQ(result.mean, second.mean);
  EXPECT_EQ(result.covariance, second.covariance);
}

TEST(Mixture, OfInnovationsIsThatOfTheirResiduals) {
  std::vector<AnyInnovation> innovations(2);
  innovations[0].residual = first.mean;
  innovations[0].covariance = first.covariance;
  innovations[1].residual = second.mean;
  innovations[1].covariance = second.covariance;
  Gaussian<Eigen::Dynamic, max_measurement_size> result{first.mean, first.covariance};
  collapse(MomentMatching{}, InnovationMixture{innovations}, weight, 1, result);
  EXPECT_DOUBLE_EQ(result.mean(0), 4.0);
  EXPECT_DOUBLE_EQ(result.covariance(0), 6.5);
}

TEST(Mixture, OfDifferentModelsIsReadInTheComponentsOfTheReceiver) {
  using Estimates = std::tuple<Gaussian<2>, Gaussian<3>>;
  const Estimates estimates{Gaussian<2>{Vector<2>(1, 2), SquareMatrix<2>{{1, 0.5}, {0.5, 2}}},
                            Gaussian<3>{Vector<3>(3, 4, 5), SquareMatrix<3>{{3, 0, 0}, {0, 4, 0}, {0, 0, 5}}}};
  const std::vector<std::string> few{"x", "vx"}, many{"x", "vx", "ax"};
  const std::vector<Correspondence> maps{{many, few}, {many, many}};
  const LiftedMixture<Gaussian<3>, Estimates> mixture{std::get<1>(estimates), estimates, maps.data(), Lift::zero};
  Gaussian<3> result = std::get<1>(estimates);
  collapse(Selection{}, mixture, weight, 0, result);
  EXPECT_EQ(result.mean, (Vector<3>(1, 2, 0)));
  EXPECT_EQ(result.covariance, (SquareMatrix<3>{{1, 0.5, 0}, {0.5, 2, 0}, {0, 0, 0}}));
  collapse(MomentMatching{}, mixture, weight, 0, result);
  EXPECT_PRED_FORMAT3(near_matrix, result.mean, (Vector<3>(2.5, 3.5, 3.75)), 1e-15);
}

using Dwna = IndependentAxes<2, DiscreteWhiteNoise<2>>;
using Dwpa = IndependentAxes<2, DiscreteWhiteNoise<3>>;
static_assert(SensorOfBank<PositionSensor<2>, std::tuple<Dwna, Dwpa>>);
static_assert(!SensorOfBank<PositionSensor<3>, std::tuple<Dwna, Dwpa>>);
static_assert(SensorOfBank<LinearSensor<6, 4>, std::tuple<Dwna, Dwpa>>);
static_assert(!SensorOfBank<LinearSensor<1, 5>, std::tuple<Dwna, Dwpa>>, "DWNA has four components");
static_assert(!SensorOfBank<LinearSensor<7, 4>, std::vector<Dwna>>, "seven quantities");

}  // namespace
}  // namespace sigmax
