#include "hybrid/two_speeds.hpp"

namespace fit_test {

TEST(Fit, FindsTheLeastLossInEveryScale) {
  const std::vector<FitParameter> parameters = {{.name = "any", .start = -2.0, .scale = Scale::linear},
                                                {.name = "positive", .start = 100.0},
                                                {.name = "share", .start = 0.5, .least = 0.01, .most = 0.99}};
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

TEST(Fit, IsNeverWorseThanItsStartAndPassesOverWhatFails) {
  const std::vector<FitParameter> parameters = {{.name = "x", .start = 1.0}};
  const auto loss = [](const std::vector<double>& x) -> double {
    if (x[0] > 1.2) throw std::domain_error("no filter");
    return x[0] < 0.9 ? not_a_number : 2.0;
  };
  const Fit found = fit(parameters, loss, by_compass);
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
  EXPECT_INVALID(("'p'", "-1.5"), fit({{.name = "p", .start = -1.5}}, loss, by_compass));
  EXPECT_INVALID(("'x'", "bounds"), fit({{.name = "x", .least = 2.0, .most = 1.0}}, loss, by_compass));
}

}  // namespace fit_test
