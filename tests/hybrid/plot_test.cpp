#include <sigmax/hybrid/plot.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/estimation/sensors.hpp>

namespace sigmax {
namespace {

const Gaussian<2> z{Vector<2>(1000.0, 0.5), SquareMatrix<2>{{25.0, 0.0}, {0.0, 1e-4}}};

TEST(Plot, IsAMeasurementOrTheNewsThatThereWasNone) {
  const Plot<PositionSensor<2>> nothing(3.0, 7), something(4.0, z, 8), neither;
  EXPECT_FALSE(nothing.seen.has_value());
  EXPECT_EQ(nothing.time, 3.0);
  EXPECT_EQ(nothing.tag, 7U);
  EXPECT_EQ(something.seen->z.mean, z.mean);
  EXPECT_EQ(something.tag, 8U);
  EXPECT_EQ(neither.tag, 0U);
  const Plot<PolarSensor<2>> radar(5.0, z, PolarSensor<2>{Vector<2>(1.0, 2.0)}, 9);
  EXPECT_EQ(radar.seen->sensor.origin(), (Vector<2>(1.0, 2.0)));
  EXPECT_EQ(radar.tag, 9U);
}

TEST(Plot, TellsAPositionIfItsSensorCan) {
  EXPECT_EQ(detail::position_told<2>(Plot<PositionSensor<2>>(0.0, z))->mean, z.mean);
  const PolarSensor<2> radar{Vector<2>(100.0, 200.0)};
  const auto found = detail::position_told<2>(Plot<PolarSensor<2>>(0.0, z, radar));
  EXPECT_EQ(found->mean, radar.position(z).mean);
  EXPECT_EQ(found->covariance, radar.position(z).covariance);
  EXPECT_FALSE(detail::position_told<2>(Plot<PositionSensor<2>>(0.0)).has_value());
  EXPECT_FALSE(detail::position_told<2>(Plot<BearingSensor>(0.0, {Vector<1>(0.1), SquareMatrix<1>(1.0)})).has_value());

  using Any = AnySensor<PositionSensor<2>, PolarSensor<2>, BearingSensor>;
  const MeasurementOf<Any> same{z.mean, z.covariance}, bearing{Vector<1>(0.1), SquareMatrix<1>(1.0)};
  EXPECT_EQ(detail::position_told<2>(Plot<Any>(0.0, same, radar))->mean, radar.position(z).mean);
  EXPECT_FALSE(detail::position_told<2>(Plot<Any>(0.0, bearing, BearingSensor{})).has_value());
}

}  // namespace
}  // namespace sigmax
