#include "support/sigmax.hpp"

namespace sensor_ref_test {

const Extended filter{dwna<2>(1.0)};

TEST(SensorRef, AsksASensorByTheFunctionsThatItHas) {
  const PositionSensor<2> position;
  const LinearSensor<2, 3> linear{RectangularMatrix<2, 3>::Ones()};
  const PolarSensor<2> polar;
  const auto leading = detail::sensor_ref(position, filter), by_matrix = detail::sensor_ref(linear, filter),
             by_function = detail::sensor_ref(polar, filter);
  EXPECT_TRUE(leading.table->leading && leading.table->linear && !leading.table->measure);
  EXPECT_TRUE(!by_matrix.table->leading && by_matrix.table->linear && !by_matrix.table->difference);
  EXPECT_TRUE(!by_function.table->linear && by_function.table->difference && !by_function.table->mean);
  EXPECT_EQ(leading.table->seen(leading.sensor), 2);
  EXPECT_EQ(by_matrix.table->seen(by_matrix.sensor), 3);
  EXPECT_EQ(by_function.sensor, &polar);
  EXPECT_EQ(by_function.model, &filter.motion()) << "a sensor asks the motion of a member";
}

TEST(SensorRef, OfAnySensorIsThatOfTheSensorThatItIs) {
  const AnySensor any = PolarSensor<2>{};
  const AnyModel model = filter;
  const auto ref = detail::sensor_ref(any, model);
  EXPECT_EQ(ref.table, (&detail::sensor_table<PolarSensor<2>, AnyModel, true>));
  EXPECT_EQ(ref.sensor, any.sensor());
  EXPECT_EQ(ref.model, &model);
}

}  // namespace sensor_ref_test
