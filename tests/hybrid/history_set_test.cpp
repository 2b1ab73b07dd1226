#include "support/sigmax.hpp"

namespace history_set_test {

Estimates one_and_two() {
  Estimates starts;
  starts.add(1);
  starts.add(2);
  return starts;
}

TEST(HistorySet, StartsWithAHistoryForEachModeAndHasRoomForMore) {
  HistorySet set(one_and_two(), 5);
  EXPECT_EQ(set.size(), 2U);
  EXPECT_EQ(set.room(), 5U);
  set.resize(4);
  set[2] = {1, 0, -3.0};
  set[3] = {0, 1, -1.0};
  set.view(2).mean[1] = 7.0;
  set.view(2).covariance[3] = 8.0;
  EXPECT_EQ(EstimateAt<const double>(std::as_const(set).view(2)).mean, (Vector<2>(0.0, 7.0)));
  EXPECT_EQ(EstimateAt<const double>(std::as_const(set).view(2)).covariance(1, 1), 8.0);
  EXPECT_EQ(EstimateAt<const double>(std::as_const(set).view(3)).size(), 1)
      << "an estimate is of the size of its last mode's model";
}

TEST(HistorySet, KnowsTheFirstOfItsBestAndWhereEachCameFrom) {
  HistorySet set(one_and_two(), 4);
  set.resize(3);
  set[0] = {0, 1, -2.0};
  set[1] = {1, 0, -0.5};
  set[2] = {1, 1, -0.5};
  ASSERT_EQ(set.all().size(), 3U);
  EXPECT_EQ(best_of(set.all()), 1U);
  EXPECT_EQ(set.all()[0].mode, 0U);
  EXPECT_EQ(set.all()[0].parent, 1U);
}

}  // namespace history_set_test
