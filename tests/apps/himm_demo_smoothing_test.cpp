// `smooth` and `sojourn_s`: what a whole recording says of each time, and modes that follow the time.

#include "apps/manoeuvring_targets.hpp"
#include "support/smoother_restatement.hpp"

namespace himm_demo_smoothing_test {

std::string estimates_of(const std::string& text, const Arguments& sets) { return tracked(text, sets).estimates; }

TEST(HimmDemoSmoothing, EqualsThePlainRestatementAtEveryStep) {
  const auto points = accelerating_target();
  const auto all = estimates(csv(points), given + Arguments{"filters=[imm,himm,gpb2,viterbi]", "smooth=true"});
  using restatement::Kind, restatement::Order;
  for (const auto& [name, kind, order] :
       {std::tuple{"imm", Kind::imm, Order::interacting}, std::tuple{"himm", Kind::himm, Order::interacting},
        std::tuple{"gpb2", Kind::imm, Order::second_order}, std::tuple{"viterbi", Kind::himm, Order::second_order}}) {
    SCOPED_TRACE(name);
    auto options = usual(kind);
    options.order = order;
    restatement::Smoother smoother{restated(options)};
    std::vector<double> nis;
    double time = start_time;
    for (const auto& [now, z] : detections(points)) {
      smoother.step(now - time, z->z, z->R);
      nis.push_back(*smoother.nis());
      time = now;
    }
    const auto moments = smoother.smoothed();
    const auto found = of_filter(all, name);
    ASSERT_EQ(found.size(), points.size());
    ASSERT_EQ(moments.size(), points.size() + 1);
    for (std::size_t k = 0; k < points.size(); ++k) {
      SCOPED_TRACE("step " + std::to_string(k));
      const auto& moment = moments[k + 1];
      ASSERT_EQ(std::stod(found[k].at("time_s")), points[k].time);
      expect_row(found[k], smoother.estimate(moment), 3);
      ASSERT_CLOSE(std::stod(found[k].at("weight_dwna")), std::exp(moment.log_weights[0]), 1e-9);
      ASSERT_CLOSE(std::stod(found[k].at("weight_dwpa")), std::exp(moment.log_weights[1]), 1e-9);
      ASSERT_EQ(found[k].at("most_likely"), moment.winner == 0 ? "dwna" : "dwpa");
      ASSERT_CLOSE(std::stod(found[k].at("nis")), nis[k], 1e-9) << "that of the filter";
    }
  }
}

TEST(HimmDemoSmoothing, IsOfEachFilterThatAsksForIt) {
  const std::string text = csv(turning_target());
  const auto both = estimates(text, {"filters=[imm,imm_smoothed]", "filter.imm_smoothed.smooth=true"});
  const auto filtered = estimates(text, {"filters=[imm]"});
  const auto smoothed = estimates(text, {"filters=[imm]", "smooth=true"});
  EXPECT_EQ(of_filter(both, "imm"), filtered);
  auto named = of_filter(both, "imm_smoothed");
  for (auto& row : named) row["filter"] = "imm";
  EXPECT_EQ(named, smoothed);
  EXPECT_EQ(smoothed.back(), filtered.back()) << "of the last row nothing more is known";
  EXPECT_NE(smoothed.front(), filtered.front());
}

TEST(HimmDemoSmoothing, TakesTheRowsThatWaitForAGivenStart) {
  const auto points = turning_target();  // whose first step is 1 s
  const std::vector<std::string> sets = {"filters=imm", "smooth=true", "start=given",
                                         "start_mean=[0,0,0,40,15,0,0,0,0]",
                                         "start_covariance_diagonal=[100,100,1,400,400,1,9,9,1]"};
  auto timed = sets;
  timed.push_back("start_time_s=-1");
  const auto found = estimates_of(csv(points), sets);
  EXPECT_EQ(found, estimates_of(csv(points), timed));
  EXPECT_EQ(rows(found).size(), points.size());
}

TEST(HimmDemoSmoothing, TakesAStartWithoutVariance) {
  const auto found = estimates(csv(turning_target()),
                               {"filters=imm", "smooth=true", "models=[dwna]", "sigma_w=0", "start=given",
                                "start_mean=[0,0,0,0,0,0,0,0,0]", "start_covariance_diagonal=[0,0,0,0,0,0,0,0,0]"});
  EXPECT_EQ(std::stod(found.front().at("x_m")), 0.0) << "what is certain stays so";
  EXPECT_EQ(std::stod(found.front().at("sigma_x_m")), 0.0);
}

TEST(HimmDemoSmoothing, DoesNotReachOverARestart) {
  auto points = turning_target();
  for (std::size_t k = 50; k < points.size(); ++k) points[k].time += 100.0;
  const std::vector<Point> sooner(points.begin(), points.begin() + 50), later(points.begin() + 50, points.end());
  const std::vector<std::string> sets = {"filters=imm", "restart_after_s=20", "smooth=true"};
  const auto all = estimates_of(csv(points), sets);
  const auto second = estimates_of(csv(later), sets);
  EXPECT_EQ(all, estimates_of(csv(sooner), sets) + second.substr(second.find('\n') + 1));
}

TEST(HimmDemoSmoothing, OfOneTrackIsAsIfItWereAlone) {
  const auto points = turning_target();
  std::string all = "time_s,ship,x_m,y_m\n", alone = "time_s,x_m,y_m\n";
  for (const auto& point : points) {
    const std::string rest = exact(point.z[0]) + "," + exact(point.z[1]) + "\n";
    all += exact(point.time) + ",a," + rest + exact(point.time) + ",b,0,0\n";
    alone += exact(point.time) + "," + rest;
  }
  auto found = estimates(all, {"filters=himm", "smooth=true"}, {"--track-id", "ship"});
  std::erase_if(found, [](const TextRow& row) { return row.at("track") != "a"; });
  for (auto& row : found) row.erase("track");
  EXPECT_EQ(found, estimates(alone, {"filters=himm", "smooth=true"}));
}

TEST(HimmDemoSmoothing, IsBetterThanTheFilterInEveryPhaseOfThePaper) {
  const TemporaryDirectory directory;
  const auto& out = directory.path();
  program::succeeds(SIGMAX_HIMM_DEMO,
                    Arguments{"simulate", "--runs", "20", "--quiet", "--out", out} +
                        setting({"filters=[imm,himm,imm_smoothed,himm_smoothed]", "filter.imm_smoothed.smooth=true",
                                 "filter.himm_smoothed.smooth=true", "augmentation=borrowed_variance"}));
  const auto found = rows(contents(out / "filters.csv"));
  for (const std::string name : {"imm", "himm"})
    for (const char* phase : {"rmse_before_m", "rmse_during_m", "rmse_after_m"})
      EXPECT_LT(std::stod(of_filter(found, name + "_smoothed")[0].at(phase)),
                0.8 * std::stod(of_filter(found, name)[0].at(phase)))
          << name << ' ' << phase;
}

/// exp(QT) of two modes in closed form.
std::string transition_over(double T, double first, double second, bool fuzzy) {
  const double a = 1.0 / first, b = 1.0 / second, moved = -std::expm1(-(a + b) * T) / (a + b);
  std::array<std::array<double, 2>, 2> P = {{{1.0 - a * moved, a * moved}, {b * moved, 1.0 - b * moved}}};
  if (fuzzy)
    for (auto& row : P) {
      const double greatest = std::max(row[0], row[1]);
      for (double& value : row) value /= greatest;
    }
  return "[[" + exact(P[0][0]) + "," + exact(P[0][1]) + "],[" + exact(P[1][0]) + "," + exact(P[1][1]) + "]]";
}

TEST(HimmDemoSojourn, OfEvenStepsIsTheTransitionOverOne) {
  for (const double T : {0.5, 3.0}) {
    auto points = turning_target();
    for (auto& point : points) point.time *= T;
    const auto by_time = estimates(csv(points), {"filters=[imm,himm,viterbi]", "sojourn_s=[60,8]"});
    const auto by_scan = estimates(
        csv(points), {"filters=[imm,himm,viterbi]", "transition_probability=" + transition_over(T, 60.0, 8.0, false),
                      "transition_possibility=" + transition_over(T, 60.0, 8.0, true)});
    ASSERT_EQ(by_time.size(), by_scan.size());
    for (std::size_t k = 0; k < by_time.size(); ++k)
      for (const char* name : {"x_m", "vy_mps", "sigma_vx_mps", "weight_dwna", "weight_dwpa"})
        ASSERT_CLOSE(std::stod(by_time[k].at(name)), std::stod(by_scan[k].at(name)), 1e-9)
            << name << " of row " << k << " at steps of " << T;
  }
}

TEST(HimmDemoSojourn, FollowsEachStep) {
  // No measurement tells the modes apart, so that a weight is the first row of P over all the time.
  const std::string text = "time_s,x_m,y_m\n1,,\n1.5,,\n6,,\n6.25,,\n";
  const auto found =
      estimates(text, {"filters=imm", "models=[dwna,dwna]", "sojourn_s=[20,5]", "start=given", "start_time_s=0",
                       "start_mean=[0,0,0,0,0,0,0,0,0]", "start_covariance_diagonal=[1,1,1,1,1,1,1,1,1]"});
  ASSERT_EQ(found.size(), 4U);
  for (const auto& row : found) {
    const double a = 0.05, b = 0.2, t = std::stod(row.at("time_s"));
    const double first = b / (a + b) + (0.5 - b / (a + b)) * std::exp(-(a + b) * t);  // from equal weights
    EXPECT_CLOSE(std::stod(row.at("weight_dwna")), first, 1e-12);
  }
}

}  // namespace himm_demo_smoothing_test
