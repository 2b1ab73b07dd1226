#include <sigmax/estimation/innovation.hpp>

#include <gtest/gtest.h>

#include <type_traits>

#include <sigmax/estimation/sensors.hpp>

namespace sigmax {
namespace {

static_assert(std::is_same_v<InnovationOf<PolarSensor<3>>, Innovation<3>>);
static_assert(std::is_same_v<InnovationOf<ComponentSensor<4>>, Innovation<Eigen::Dynamic, 4>>);

TEST(Innovation, IsOfNothingAtFirst) {
  const Innovation<Eigen::Dynamic, 4> innovation;
  EXPECT_EQ(innovation.residual.size(), 0);
  EXPECT_EQ(innovation.squared_distance, 0.0);
  EXPECT_EQ(innovation.log_likelihood, 0.0);
}

}  // namespace
}  // namespace sigmax
