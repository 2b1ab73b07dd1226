#include "hybrid/banks.hpp"

namespace fixed_lag_smoother_test {

/// Every state that a lag gives is that of smoothing the interval from the start to `lag` steps later.
template <class Filter>
void is_the_interval_up_to_the_lag(Filter filter, std::size_t lag) {
  FixedLagSmoother smoother(filter, lag);
  std::vector record{filter.recorded(0.0)};
  std::vector<std::decay_t<decltype(record[0].state)>> found;
  const auto take = [&] {
    if (const auto* state = smoother.take(record.back())) found.push_back(*state);
  };
  take();
  for (const Scan& scan : manoeuvring_target(12)) {
    const PositionSensor<2> sensor;
    scan.z ? filter.step(scan.dt, *scan.z, sensor) : filter.step(scan.dt);
    record.push_back(scan.z ? filter.recorded(scan.dt, *scan.z, sensor) : filter.recorded(scan.dt));
    take();
  }
  for (const auto& state : smoother.rest()) found.push_back(state);

  ASSERT_EQ(found.size(), record.size());
  for (std::size_t k = 0; k < record.size(); ++k) {
    const auto end = record.begin() + static_cast<std::ptrdiff_t>(std::min(k + lag + 1, record.size()));
    const auto expected = smooth(filter, std::vector(record.begin(), end))[k];
    EXPECT_EQ(found[k].most_likely_mode, expected.most_likely_mode);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(found[k].belief.log(j), expected.belief.log(j));
      EXPECT_EQ(found[k].estimates[j].mean, expected.estimates[j].mean);
      EXPECT_EQ(found[k].estimates[j].covariance, expected.estimates[j].covariance);
    }
  }
}

TEST(FixedLagSmoother, IsTheIntervalUpToTheLag) {
  for (const std::size_t lag : {0U, 1U, 3U, 12U, 100U})
    with_every_filter([&](const auto& filter) { is_the_interval_up_to_the_lag(filter, lag); });
}

TEST(FixedLagSmoother, OfNothingIsNothing) {
  with_every_filter([](const auto& filter) { EXPECT_TRUE(FixedLagSmoother(filter, 3).rest().empty()); });
}

}  // namespace fixed_lag_smoother_test
