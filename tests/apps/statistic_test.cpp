#include "study/study.hpp"
#include "support/test.hpp"

namespace statistic_test {

using Columns = std::vector<std::vector<double>>;

/// Student's quantile for 99 degrees of freedom, by integrating its density: 97.5 % and 1 − 0.025/9.
constexpr double student = 1.98421695, student_of_nine = 2.83502736;

/// The standard error by leaving out one batch after the other, which shares nothing with the delta method.
double jackknife(const Columns& columns, const std::function<double(const std::vector<double>&)>& figure) {
  const std::size_t n = columns.front().size();
  std::vector<double> without;
  for (std::size_t left_out = 0; left_out < n; ++left_out) {
    std::vector<double> sums(columns.size(), 0.0);
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t i = 0; i < n; ++i)
        if (i != left_out) sums[c] += columns[c][i];
    without.push_back(figure(sums));
  }
  double mean = 0.0, squares = 0.0;
  for (const double value : without) mean += value / static_cast<double>(n);
  for (const double value : without) squares += (value - mean) * (value - mean);
  return std::sqrt(squares * static_cast<double>(n - 1) / static_cast<double>(n));
}

Columns draw() {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  Columns columns(3, std::vector<double>(100));
  for (std::size_t i = 0; i < 100; ++i) {
    const double shared = normal(engine);
    columns[0][i] = 40.0 + 3.0 * shared + normal(engine);
    columns[1][i] = 30.0 + 2.0 * shared + normal(engine);
    columns[2][i] = 10.0 + static_cast<double>(i % 3);  // runs
  }
  return columns;
}

TEST(Statistic, TheIntervalIsTheJackknifes) {
  const Columns columns = draw();
  const Statistic a = sqrt(Statistic::mean(columns[0], columns[2]));
  const Statistic b = sqrt(Statistic::mean(columns[1], columns[2]));
  const auto check = [&](const Statistic& statistic, const std::function<double(double, double)>& of) {
    const auto figure = [&](const std::vector<double>& sums) {
      return of(std::sqrt(sums[0] / sums[2]), std::sqrt(sums[1] / sums[2]));
    };
    std::vector<double> sums(3, 0.0);
    for (std::size_t c = 0; c < 3; ++c)
      for (const double value : columns[c]) sums[c] += value;
    EXPECT_NEAR(statistic.value(), figure(sums), 1e-12);
    const double expected = student * jackknife(columns, figure);
    EXPECT_NEAR(statistic.interval().half_width, expected, 0.01 * expected);
  };
  check(a, [](double x, double) { return x; });
  check(a / b - 1.0, [](double x, double y) { return x / y - 1.0; });
  check((a + b) * 2.0 - a / b, [](double x, double y) { return 2.0 * (x + y) - x / y; });
}

TEST(Statistic, IntervalsThatHoldTogetherAreWider) {
  const Columns columns = draw();
  const Statistic a = Statistic::mean(columns[0], columns[2]);
  EXPECT_NEAR(a.interval(9).half_width / a.interval().half_width, student_of_nine / student, 1e-8);
}

TEST(Statistic, WhatIsSharedCancels) {
  const Columns columns = draw();
  const Statistic a = Statistic::mean(columns[0], columns[2]);
  EXPECT_NEAR((a - a).interval().half_width, 0.0, 1e-12);
  EXPECT_NEAR((a / a).value(), 1.0, 1e-12);
}

TEST(Statistic, OneBatchHasNoBoundsAndNoCountNoValue) {
  const std::vector<double> one = {3.0}, none = {0.0};
  EXPECT_TRUE(std::isinf(Statistic::mean(one, one).interval().half_width));
  EXPECT_TRUE(std::isnan(Statistic::mean(none, none).value()));
}

}  // namespace statistic_test
