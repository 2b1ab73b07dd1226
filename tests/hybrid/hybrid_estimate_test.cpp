#include "hybrid/banks.hpp"

namespace hybrid_estimate_test {

TEST(RecordedStep, HasWhatTheMeasurementToldOfEachModeIfThereWasOneAndItWasTaken) {
  with_every_filter([](auto& filter) {
    const Gaussian<2> z{Vector<2>(12e3, 8e3), 100.0 * SquareMatrix<2>::Identity()};
    const PositionSensor<2> sensor;
    EXPECT_TRUE(filter.recorded(0.0).seen.empty());
    filter.step(0.5, z, sensor);
    const auto step = filter.recorded(0.5, z, sensor);
    EXPECT_EQ(step.dt, 0.5);
    ASSERT_EQ(step.seen.size(), 3U);
    EXPECT_EQ(step.seen[0].rows(), 2);
    EXPECT_EQ(step.state.estimates[1].mean, filter.estimates()[1].mean);
    EXPECT_EQ(step.state.belief.log(1), filter.belief().log(1));
    EXPECT_EQ(step.state.most_likely_mode, filter.most_likely_mode());
    EXPECT_REFUSED(std::logic_error, ("expected recorded(dt, z)"), filter.recorded(0.5));
    const Gate closed = Gate::squared_distance(0.0);
    filter.step(0.5, z, sensor, closed);
    EXPECT_TRUE(filter.recorded(0.5, z, sensor, closed).seen.empty()) << "a gate rejected it";
  });
}

}  // namespace hybrid_estimate_test
