// The code of docs/tuning.md, and what it claims of a simulated target.

#include <sigmax/hybrid/fit_target.hpp>
#include <sigmax/tuning/target.hpp>
#include <sigmax/tuning/tune.hpp>

#include "hybrid/two_speeds.hpp"

namespace tuning_walk_test {

/// A target of one motion, and what is seen of it to 2 m.
struct Seen {
  TargetChoice choice;
  std::vector<AnyDetection> detections;
};
Seen seen(std::size_t rows) {
  TargetChoice choice = two_speeds(false);
  choice.motions.resize(1);
  choice.models.resize(1);
  choice.transition = {{1.0}};
  return {choice, simulate(choice, 2.0, rows, 7).detections};
}

TEST(Tune, FindsTheSettingsThatMadeTheData) {
  Seen target = seen(400);
  TargetChoice& choice = target.choice;
  std::vector<AnyDetection>& detections = target.detections;
  choice.motions[0][MotionParameter::sigma_w] = 30.0;
  const TrackScale scale({detections});
  auto numbers = motion_numbers(choice, scale);
  numbers.push_back({{.name = "sigma_m", .start = 10.0, .least = 0.01, .most = 100.0},
                     [&](TargetChoice&, double sigma) { believe(detections, sigma); }});
  const RobustLoss robust({detections}, scale);
  const TuneProblem problem{parameters_of(numbers), [&](const std::vector<double>& x) {
                              for (std::size_t i = 0; i < x.size(); ++i) numbers[i].set(choice, x[i]);
                              return RowLosses{robust(0, log_scores(choice, detections))};
                            }};
  const Tuned tuned = tune(problem, folds_of(std::array{detections.size()}, 4));
  const std::vector<double> errors = standard_errors(problem, tuned);
  const std::array known = {1.0, 2.0};
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_LT(errors[i], 0.2) << i;
    EXPECT_LT(std::abs(std::log(tuned.fit.values[i] / known[i])), 3.0 * errors[i]) << i;
  }
  EXPECT_NEAR(mean_loss(tuned.held_out), tuned.fit.loss, 0.02);
  EXPECT_EQ(tune(problem, folds_of(std::array{detections.size()}, 4)).fit.values, tuned.fit.values);
}

TEST(Tune, SaysThatANumberOfAModeWhichNoRowIsInIsNotIdentifiable) {
  Seen target = seen(200);
  TargetChoice& choice = target.choice;
  std::vector<AnyDetection>& detections = target.detections;
  believe(detections, 2.0);
  choice.motions.push_back(choice.motions[0]);
  choice.motions[1][MotionParameter::sigma_w] = 3.0;
  choice.models = {"calm", "never"};
  choice.transition = {{1.0 - 1e-9, 1e-9}, {0.5, 0.5}};
  const TrackScale scale({detections});
  const auto numbers = motion_numbers(choice, scale);
  const TuneProblem problem{
      parameters_of(numbers),
      [&](const std::vector<double>& x) {
        for (std::size_t i = 0; i < x.size(); ++i) numbers[i].set(choice, x[i]);
        return RowLosses{log_scores(choice, detections)};
      },
      [](const RowLosses& scores, const RowCounts& counts) { return -mean_loss(scores, counts); }};
  const auto errors = standard_errors(problem, tune(problem, folds_of(std::array{detections.size()}, 2)));
  EXPECT_LT(errors[0], 0.3);
  EXPECT_TRUE(std::isinf(errors[1])) << errors[1];
}

TEST(TransitionNumbers, KeepRowsNormalisedAndSojournTimesTheirOrder) {
  for (const bool fuzzy : {false, true}) {
    TargetChoice choice = two_speeds(fuzzy);
    const auto numbers = transition_numbers(choice, TrackScale({}));
    ASSERT_EQ(numbers.size(), 2U);
    EXPECT_DOUBLE_EQ(numbers[0].parameter.start, choice.transition[0][1]);
    numbers[0].set(choice, 0.01);
    EXPECT_EQ(choice.transition[0], (std::vector<double>{fuzzy ? 1.0 : 0.99, 0.01}));
    choice.sojourn_s = {20.0, 5.0};
    transition_numbers(choice, TrackScale({}))[1].set(choice, 7.0);
    EXPECT_EQ(choice.sojourn_s, (std::vector<double>{20.0, 7.0}));
  }
}

TEST(RobustLoss, BoundsWhatAStrayDetectionLosesAndRefusesManyOfThem) {
  const auto detections = seen(100).detections;
  const RobustLoss robust({detections}, TrackScale({detections}));
  std::vector<double> scores(detections.size(), -5.0);
  const double usual = robust(0, scores)[3];
  scores[3] = -infinity;
  const RowLosses one = {robust(0, scores)};
  EXPECT_LT(one[0][3], usual + 30.0);
  EXPECT_NEAR(robust.strays(one), 0.01, 0.005);
  EXPECT_DOUBLE_EQ(robust.objective(one), mean_loss(one));
  std::fill_n(scores.begin(), 20, -infinity);
  EXPECT_GT(robust.objective({robust(0, scores)}), mean_loss({robust(0, scores)}) + 2.0);
}

}  // namespace tuning_walk_test
