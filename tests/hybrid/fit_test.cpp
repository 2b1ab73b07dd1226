#include "hybrid/two_speeds.hpp"

namespace fit_test {

TEST(Fit, FindsTheLeastLossInEveryScale) {
  const std::vector<FitParameter> parameters = {{.name = "any", .start = -2.0, .scale = Scale::linear},
                                                {.name = "positive", .start = 100.0},
                                                {.name = "probability", .start = 0.5, .scale = Scale::logistic}};
  const auto loss = [](const std::vector<double>& x) {
    EXPECT_GT(x[1], 0.0);
    EXPECT_TRUE(x[2] > 0.0 && x[2] < 1.0);
    return std::pow(x[0] - 3.0, 2) + std::pow(std::log(x[1] / 0.7), 2) + std::pow(x[2] - 0.95, 2);
  };
  const Fit found = fit(parameters, loss, by_compass);
  EXPECT_NEAR(found.values[0], 3.0, 0.05);
  EXPECT_NEAR(found.values[1], 0.7, 0.05);
  EXPECT_NEAR(found.values[2], 0.95, 0.01);
  EXPECT_EQ(found.loss, loss(found.values));
}

TEST(Fit, SeveralStartsFindTheDeeperOfTwoValleysAndASeedFindsItAgain) {
  const std::vector<FitParameter> parameters = {{.name = "x", .start = 0.0, .scale = Scale::linear, .step = 1.0}};
  const auto loss = [](const std::vector<double>& x) {
    return std::min(std::pow(x[0] + 0.5, 2), std::pow(4.0 * (x[0] - 1.8), 2) - 1.0);
  };
  EXPECT_NEAR(fit(parameters, loss, by_compass).values[0], -0.5, 0.05);
  const Fit many = fit(parameters, loss, by_compass, {.starts = 12, .seed = 5});
  EXPECT_NEAR(many.values[0], 1.8, 0.05);
  EXPECT_EQ(fit(parameters, loss, by_compass, {.starts = 12, .seed = 5}).values, many.values);

  Fit best;  // the starts one by one, in another order
  for (const std::size_t s : {7U, 3U, 11U, 0U, 1U, 2U, 4U, 5U, 6U, 8U, 9U, 10U}) {
    const Fit one = fit_from(parameters, loss, by_compass, fit_search(parameters, 5, s));
    if (one.loss < best.loss) best = one;
  }
  EXPECT_EQ(best.values, many.values);
  EXPECT_NE(fit_search(parameters, 6, 1).start, fit_search(parameters, 5, 1).start);
}

TEST(Fit, IsNeverWorseThanItsStartAndPassesOverWhatFails) {
  const std::vector<FitParameter> parameters = {{.name = "x", .start = 1.0}};
  const auto loss = [](const std::vector<double>& x) -> double {
    if (x[0] > 1.2) throw std::domain_error("no filter");
    return x[0] < 0.9 ? not_a_number : 2.0;
  };
  const Fit found = fit(parameters, loss, by_compass, {.starts = 3});
  EXPECT_EQ(found.loss, 2.0);
  EXPECT_TRUE(found.values[0] >= 0.9 && found.values[0] <= 1.2);
  EXPECT_EQ(fit(
                {}, [](const auto&) { return 7.0; }, by_compass)
                .loss,
            7.0);
}

TEST(Fit, RefusesAParameterThatCannotStart) {
  const auto loss = [](const std::vector<double>&) { return 0.0; };
  EXPECT_INVALID(("'sigma_w'", "start at 0"), fit({{.name = "sigma_w", .start = 0.0}}, loss, by_compass));
  EXPECT_INVALID(("'p'", "1.5"), fit({{.name = "p", .start = 1.5, .scale = Scale::logistic}}, loss, by_compass));
}

}  // namespace fit_test
