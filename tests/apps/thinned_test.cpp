#include "report/thinned.hpp"
#include "support/test.hpp"

namespace thinned_test {

TEST(Thinned, KeepsAllWhileItCan) {
  Thinned rows(2, 100, {0, 1});
  for (int i = 0; i < 100; ++i) rows.add(i, {1.0 * i, -1.0 * i});
  ASSERT_EQ(rows.times().size(), 100U);
  EXPECT_EQ(rows.column(1)[99], -99.0);
}

TEST(Thinned, KeepsEveryPeakAndNoMoreThanItMay) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  Thinned rows(3, 500, {0, 1, 2});
  std::vector<std::vector<double>> all;
  for (int i = 0; i < 200000; ++i) {
    all.push_back({noise(random), i % 5 == 0 ? not_a_number : noise(random), 1.0 * i});
    if (i == 123456) all.back()[0] = 1000.0;
    if (i == 77777) all.back()[1] = -1000.0;
    rows.add(i, all.back());
    ASSERT_LE(rows.kept(), 500U);
  }
  EXPECT_EQ(rows.taken(), 200000U);
  const auto times = rows.times();
  EXPECT_GT(times.size(), 100U);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times.back(), 199999.0);
  for (std::size_t column = 0; column < 3; ++column) {
    const auto kept = rows.column(column);
    ASSERT_EQ(kept.size(), times.size());
    for (std::size_t k = 0; k < kept.size(); ++k) {  // each is a row as it came
      const double came = all[static_cast<std::size_t>(times[k])][column];
      EXPECT_TRUE(kept[k] == came || (std::isnan(kept[k]) && std::isnan(came)));
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 123456.0), 1);
  EXPECT_EQ(std::count(times.begin(), times.end(), 77777.0), 1);
}

TEST(Thinned, KeepsThePeaksOfEveryPart) {
  Thinned rows(1, 400, {0});
  for (int i = 0; i < 100000; ++i) rows.add(i, {i % 10000 == 5000 ? 1.0 : 0.0});
  const auto kept = rows.column(0);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1.0), 10);
}

TEST(Thinned, MayBeGivenLessRoomLater) {
  Thinned rows(1, 1000, {0});
  for (int i = 0; i < 1000; ++i) rows.add(i, {std::sin(i)});
  rows.limit(100);
  EXPECT_LE(rows.kept(), 100U);
  EXPECT_GT(rows.kept(), 20U);
  rows.limit(0);
  EXPECT_LE(rows.kept(), 4U);
  EXPECT_GE(rows.kept(), 2U);
}

TEST(Thinned, KeepsTheFirstOfAStretchAndTheExtremesOfWatchedColumns) {
  Thinned rows(2, 8, {1});
  for (int i = 0; i < 1000; ++i) rows.add(i, {i == 500 ? 9.0 : 0.0, i == 700 ? 9.0 : 0.001 * (i % 7)});
  EXPECT_LE(rows.kept(), 8U);
  EXPECT_EQ(rows.times().front(), 0.0);
  EXPECT_EQ(std::ranges::count(rows.times(), 500.0), 0);
  EXPECT_EQ(std::ranges::count(rows.times(), 700.0), 1);
}

TEST(Thinned, RefusesWhatCannotBe) {
  EXPECT_THROW(Thinned(0, 10, {}), std::invalid_argument);
  EXPECT_THROW(Thinned(3, 7, {0, 2}), std::invalid_argument);
  Thinned rows(2, 10, {0, 1});
  EXPECT_THROW(rows.add(0.0, {1.0}), std::invalid_argument);
}

}  // namespace thinned_test
