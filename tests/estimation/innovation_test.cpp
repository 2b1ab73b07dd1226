#include <sigmax/estimation/kalman.hpp>

#include <sigmax/estimation/sensors.hpp>

#include "support/test.hpp"

namespace {

static_assert(std::is_same_v<InnovationOf<PolarSensor<3>>, Innovation<3>>);
static_assert(std::is_same_v<InnovationOf<ComponentSensor<4>>, Innovation<Eigen::Dynamic, 4>>);

TEST(Innovation, IsOfNothingAtFirst) { EXPECT_EQ((Innovation<Eigen::Dynamic, 4>{}.log_likelihood), 0.0); }

}  // namespace
