#include "support/sigmax.hpp"

namespace detection_test {

const Gaussian<2> z{Vector<2>(1000.0, 0.5), SquareMatrix<2>{{25.0, 0.0}, {0.0, 1e-4}}};

TEST(Detection, IsAMeasurementOrTheNewsThatThereWasNone) {
  const Detection nothing(3.0, 7), something(4.0, z, 8), neither;
  EXPECT_FALSE(nothing.seen());
  EXPECT_EQ(nothing.time, 3.0);
  EXPECT_EQ(nothing.tag, 7U);
  EXPECT_TRUE(something.seen());
  EXPECT_EQ(something.measurement().n, 2);
  EXPECT_EQ(something.measurement().mean[1], 0.5);
  EXPECT_EQ(something.measurement().covariance[3], 1e-4);
  EXPECT_EQ(something.tag, 8U);
  EXPECT_EQ(neither.tag, 0U);
}

TEST(Detection, TellsAPositionIfItsSensorCan) {
  EXPECT_EQ(Detection(0.0, z).position<2>()->mean, z.mean);
  EXPECT_FALSE(Detection(0.0, z).position<3>()) << "along other axes";
  const PolarSensor<2> radar{Vector<2>(100.0, 200.0)};
  const auto found = Detection(0.0, z, radar).position<2>();
  EXPECT_EQ(found->mean, radar.position(z).mean);
  EXPECT_EQ(found->covariance, radar.position(z).covariance);
  EXPECT_FALSE(Detection(0.0).position<2>());
  EXPECT_FALSE(Detection(0.0, {Vector<1>(0.1), SquareMatrix<1>(1.0)}, BearingSensor{}).position<2>());
}

TEST(Detection, TellsAPositionAlongAsManyAxesAsItWasMeasured) {
  for (const int axes : {1, 2, 3}) {
    const Gaussian<Eigen::Dynamic, 3> position{Eigen::VectorXd::LinSpaced(axes, 1.0, 3.0),
                                               Eigen::MatrixXd::Identity(axes, axes)};
    const Detection detection(1.0, position);
    EXPECT_EQ(detection.measurement().n, axes);
    EXPECT_EQ(detection.position<Eigen::Dynamic>()->mean, position.mean);
    EXPECT_EQ(detection.position<2>().has_value(), axes == 2);
  }
  EXPECT_FALSE(Detection(0.0).position<Eigen::Dynamic>());
}

}  // namespace detection_test
