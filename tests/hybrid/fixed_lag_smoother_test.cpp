#include <sigmax/hybrid/fixed_lag_smoother.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hybrid/laws.hpp"

namespace sigmax {
namespace {

using namespace support;

/// Every state that a lag gives is that of smoothing the interval from the start to `lag` steps later.
template <class Order, Uncertainty Kind>
void is_the_interval_up_to_the_lag(std::size_t lag) {
  auto filter = vector_filter<Order, Kind>();
  const auto scans = manoeuvring_target(12);
  FixedLagSmoother smoother(filter, lag);
  std::vector record{filter.recorded(0.0)};
  std::vector<HybridEstimate<VectorBank, Kind>> found;
  const auto note = [&](const auto* state) {
    if (state) found.push_back(*state);
  };
  note(smoother.take(record.front()));
  for (const Scan& scan : scans) {
    step(filter, scan);
    record.push_back(recorded(filter, scan));
    note(smoother.take(record.back()));
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
  for (const std::size_t lag : {0U, 1U, 3U, 12U, 100U}) {
    is_the_interval_up_to_the_lag<Interacting, Random>(lag);
    is_the_interval_up_to_the_lag<SecondOrder, Fuzzy>(lag);
  }
}

TEST(FixedLagSmoother, OfNothingIsNothing) {
  const auto filter = vector_filter<Interacting, Fuzzy>();
  EXPECT_TRUE((FixedLagSmoother<VectorBank, Fuzzy>(filter, 3).rest().empty()));
}

}  // namespace
}  // namespace sigmax
