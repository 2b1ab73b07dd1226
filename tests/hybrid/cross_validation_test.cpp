#include "support/sigmax.hpp"

namespace cross_validation_test {

constexpr double unknown = not_a_number;

TEST(CrossValidation, CutsAFewRecordingsInTimeAndSharesManyOut) {
  EXPECT_EQ(folds_of(std::array<std::size_t, 2>{6, 3}, 3), (RowFolds{{0, 0, 1, 1, 2, 2}, {0, 1, 2}}));
  EXPECT_EQ(folds_of(std::array<std::size_t, 5>{2, 1, 1, 0, 3}, 2), (RowFolds{{0, 0}, {1}, {0}, {}, {0, 0, 0}}));
}

TEST(CrossValidation, TakesEachRowFromTheSettingsThatHaveNotSeenIt) {
  const RowFolds folds{{0, 1, 1}, {0}};
  const std::vector<RowLosses> without{{{1.0, 2.0, 3.0}, {4.0}}, {{10.0, 20.0, 30.0}, {40.0}}};
  EXPECT_EQ(held_out(folds, without), (RowLosses{{1.0, 20.0, 30.0}, {4.0}}));
}

TEST(CrossValidation, MeansAreOfTheRowsThatAreJudgedAndCount) {
  const RowLosses losses{{1.0, unknown, 2.0}, {6.0}};
  EXPECT_EQ(mean_loss(losses), 3.0);
  EXPECT_EQ(mean_loss(losses, [](std::size_t recording, std::size_t) { return recording == 0; }), 1.5);
  EXPECT_TRUE(std::isnan(mean_loss(losses, [](std::size_t, std::size_t row) { return row == 1; })));
}

TEST(CrossValidation, DifferencesKnowThatNeighboursAreNotIndependent) {
  const MeanDifference none = mean_difference({{unknown}}, {{1.0}});
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_EQ(none.error, 0.0);
  const MeanDifference by_hand = mean_difference({{3.0, unknown, 5.0}}, {{1.0, 2.0, 1.0}});  // 2 and 4, a block each
  EXPECT_EQ(by_hand.mean, 3.0);
  EXPECT_DOUBLE_EQ(by_hand.error, std::sqrt(2.0 * 2.0 / 1.0) / 2.0);
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  RowLosses alone(1), alike(1);  // as many rows; of the second ten neighbours are the same
  for (int block = 0; block < 200; ++block) {
    const double common = normal(generator);
    for (int k = 0; k < 10; ++k) {
      alone[0].push_back(normal(generator));
      alike[0].push_back(common);
    }
  }
  const RowLosses zero{std::vector<double>(2000, 0.0)};
  EXPECT_NEAR(mean_difference(alone, zero).error, 1.0 / std::sqrt(2000.0), 0.4 / std::sqrt(2000.0));
  EXPECT_NEAR(mean_difference(alike, zero).error, 1.0 / std::sqrt(200.0), 0.4 / std::sqrt(200.0));
}

TEST(CrossValidation, SelectsTheBestAndTheSimplestThatIsAsGood) {
  const auto losses = [](double mean, double spread) {
    RowLosses result(1);
    for (int k = 0; k < 100; ++k) result[0].push_back(mean + (k / 5 % 2 == 0 ? spread : -spread));
    return result;
  };
  const std::vector<RowLosses> all{losses(5.0, 0.0), losses(1.01, 0.5), losses(1.0, 0.0), losses(1.0, 0.0)};
  const Selected selected = select_settings(all, std::array<std::size_t, 4>{0, 2, 7, 7});
  EXPECT_EQ(selected.best, 2U);
  EXPECT_EQ(selected.simple, 1U);
  EXPECT_EQ(select_settings(all, std::array<std::size_t, 4>{0, 8, 7, 7}).simple, 2U);
  EXPECT_INVALID(("0 settings"), select_settings({}, {}));
  EXPECT_INVALID(("1", "4"), select_settings(all, std::array<std::size_t, 1>{3}));
}

TEST(LossSurface, TellsWhereTheOthersAreBestIfANumberIsOff) {
  const LossSurface surface(3, 0.1, [](const std::vector<double>& x) {
    return RowLosses{{1.0 + x[0] * x[0] + x[0] * x[1] + 1.5 * x[1] * x[1]}};
  });
  const auto ridges = surface.shape().ridges;
  EXPECT_NEAR(ridges[0][1], -1.0 / 3.0, 1e-9);
  EXPECT_NEAR(ridges[1][0], -0.5, 1e-9);
  EXPECT_EQ(ridges[0][0], 1.0);
  EXPECT_TRUE(ridges[2].empty());
}

/// Minus the log-densities of numbers by a mean and the logarithm of a standard deviation; a third setting changes
/// nothing.
TEST(LossSurface, RowsThatOnlyRepeatOthersTellNoMoreTogether) {
  const auto of = [](std::size_t copies) {
    return LossSurface(1, 0.1, [=](const std::vector<double>& x) {
      RowLosses result(1);
      for (std::size_t k = 0; k < 30 * copies; ++k)
        result[0].push_back(std::pow(x[0] - std::sin(static_cast<double>(k / copies)), 2));
      return result;
    });
  };
  const double once = of(1).shape().error[0];
  EXPECT_NEAR(of(4).shape({}, 4).error[0], once, 1e-12);
  EXPECT_NEAR(of(4).shape().error[0], once / 2.0, 1e-12);
}

TEST(LossSurface, KnowsTheBestNumbersOfAGaussianAndTheirErrors) {
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal(5.1, 2.0);
  std::vector<double> numbers(4000);
  for (double& number : numbers) number = normal(generator);
  const auto losses = [&](const std::vector<double>& offsets) {
    RowLosses result(1);
    const double mean = 5.1 + offsets[0], log_sigma = std::log(2.0) + offsets[1];
    for (const double number : numbers)
      result[0].push_back(log_sigma + 0.5 * std::pow((number - mean) / std::exp(log_sigma), 2));
    result[0][7] = unknown;
    return result;
  };
  std::size_t asked = 0;
  const LossSurface surface(3, 0.05, [&](const std::vector<double>& offsets) {
    ++asked;
    return losses(offsets);
  });
  EXPECT_EQ(asked, LossSurface::asked(3));
  for (const bool half : {false, true}) {
    double sum = 0.0, squares = 0.0, rows = 0.0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (k == 7 || (half && k % 2 == 0)) continue;
      sum += numbers[k];
      squares += numbers[k] * numbers[k];
      ++rows;
    }
    const double mean = sum / rows, sigma = std::sqrt(squares / rows - mean * mean);
    const auto shape = surface.shape([&](std::size_t, std::size_t row) { return !half || row % 2 == 1; });
    EXPECT_NEAR(5.1 + shape.least[0], mean, 0.01);
    EXPECT_NEAR(2.0 * std::exp(shape.least[1]), sigma, 0.01);
    EXPECT_NEAR(shape.error[0], sigma / std::sqrt(rows), 0.05 * sigma / std::sqrt(rows));
    EXPECT_NEAR(shape.error[1], 1.0 / std::sqrt(2.0 * rows), 0.15 / std::sqrt(2.0 * rows));
    EXPECT_EQ(shape.least[2], 0.0);
    EXPECT_TRUE(std::isinf(shape.error[2]));
  }
}

}  // namespace cross_validation_test
