// The code of docs/tuning.md, and what it claims of simulated targets.

#include "hybrid/two_speeds.hpp"

namespace tuning_walk_test {

/// 20 targets of known settings, each fitted alone: search, EM, search. The estimates lie about the truth.
TEST(Fit, FindsTheSettingsThatMadeTheData) {
  constexpr std::size_t targets = 20, rows = 120;
  const TargetChoice truth = two_speeds(false);
  const std::vector<double> known = {1.0, 12.0, 2.0, 0.05, 0.10};
  std::vector<std::vector<double>> logs(known.size());
  for (std::size_t t = 0; t < targets; ++t) {
    auto plots = simulate(truth, known[2], rows, 100 + t).plots;
    TargetChoice choice = truth;
    choice.transition = {{0.9, 0.1}, {0.1, 0.9}};
    std::vector<double> found = {2.0, 8.0, 3.0};
    const auto set = [&](const std::vector<double>& x) {
      choice.motions[0][MotionParameter::sigma_w] = x[0];
      choice.motions[1][MotionParameter::sigma_w] = x[1];
      believe(plots, x[2]);
    };
    const auto loss = [&](const std::vector<double>& x) {
      set(x);
      double sum = 0.0;
      for (const double score : log_scores(choice, plots)) sum -= std::isnan(score) ? 0.0 : score;
      return sum;
    };
    const auto coarse = [](const auto& function, const FitSearch& search) { compass(function, search, 0.15); };
    for (int round = 0; round < 2; ++round) {
      found = fit({{.name = "calm", .start = found[0]},
                   {.name = "turn", .start = found[1]},
                   {.name = "sensor", .start = found[2]}},
                  loss, coarse)
                  .values;
      set(found);
      for (int step = 0; step < 3; ++step) {
        TransitionCounts counts(2, false);
        count_transitions(
            choice, plots, [](std::size_t) { return true; }, counts);
        choice.transition = counts.transition(choice.transition);
      }
    }
    found.push_back(choice.transition[0][1]);
    found.push_back(choice.transition[1][0]);
    for (std::size_t i = 0; i < found.size(); ++i) logs[i].push_back(std::log(found[i]));
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    std::sort(logs[i].begin(), logs[i].end());
    const double median = 0.5 * (logs[i][9] + logs[i][10]), spread = (logs[i][14] - logs[i][5]) / 1.35;
    // the median of 20 lies within three of its standard errors, 0.84 of their spread
    EXPECT_LT(std::abs(median - std::log(known[i])), 0.84 * spread) << i << ": " << std::exp(median);
    EXPECT_LT(spread, 1.0) << i;
  }
}

}  // namespace tuning_walk_test
