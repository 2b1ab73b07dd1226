// `smooth` and `sojourn_s`: what a whole recording says of each time, and modes that follow the time.

#include "apps/manoeuvring_targets.hpp"
#include "apps/temporary_directory.hpp"
#include "support/program.hpp"
#include "support/smoother_restatement.hpp"

namespace {

program::Ending himm_demo(const Arguments& arguments, const Arguments& sets) {
  return program::run(SIGMAX_HIMM_DEMO, arguments + setting(sets));
}

/// estimates.csv
std::string estimates(const std::string& text, const std::vector<std::string>& sets,
                      const std::vector<std::string>& options = {}) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "out";
  program::succeeds(
      SIGMAX_HIMM_DEMO,
      Arguments{"track", directory.write("recording.csv", text), "--quiet", "--out", out} + options + setting(sets));
  return contents(out / "estimates.csv");
}

/// `found` are the rows of a filter that started at `start_time`.
void expect_restated(const restatement::Options& options, const std::vector<Point>& points,
                     const std::vector<TextRow>& found) {
  using restatement::Index;
  const std::vector starts = {restated_start(6), restated_start(9)};
  const bool fuzzy = options.kind == restatement::Kind::himm;
  const restatement::Matrix transition(2, 2,
                                       fuzzy ? std::vector{1.0, 0.5, 0.25, 1.0} : std::vector{0.95, 0.05, 0.1, 0.9});
  restatement::Smoother smoother{restatement::Filter({restatement::dwna(3, 3.0), restatement::dwpa(3, 4.0)}, transition,
                                                     starts, {1.0, 1.0}, options)};
  restatement::Matrix R(3, 3);
  for (Index i = 0; i < 3; ++i) R(i, i) = 100.0;
  std::vector<double> nis;
  double time = start_time;
  for (const auto& point : points) {
    smoother.step(point.time - time, point.z, R);
    nis.push_back(*smoother.nis());
    time = point.time;
  }
  const auto moments = smoother.smoothed();
  ASSERT_EQ(found.size(), points.size());
  ASSERT_EQ(moments.size(), points.size() + 1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    SCOPED_TRACE("step " + std::to_string(k));
    const auto& moment = moments[k + 1];
    const auto estimate = smoother.estimate(moment);
    ASSERT_EQ(std::stod(found[k].at("time_s")), points[k].time);
    expect_row(found[k], estimate, 3);
    ASSERT_CLOSE(std::stod(found[k].at("weight_dwna")), std::exp(moment.log_weights[0]), 1e-9);
    ASSERT_CLOSE(std::stod(found[k].at("weight_dwpa")), std::exp(moment.log_weights[1]), 1e-9);
    ASSERT_EQ(found[k].at("most_likely"), moment.winner == 0 ? "dwna" : "dwpa");
    ASSERT_CLOSE(std::stod(found[k].at("nis")), nis[k], 1e-9) << "that of the filter";
  }
}

TEST(HimmDemoSmoothing, EqualsThePlainRestatementAtEveryStep) {
  const auto points = accelerating_target();
  const auto found = rows(estimates(
      csv(points), {"filters=[imm,himm,gpb2,viterbi]", "smooth=true", "start=given",
                    "start_mean=[1200,800,300,-95,-85,1,0.5,-0.25,0]",
                    "start_covariance_diagonal=[400,500,600,100,110,120,25,16,9]", "start_time_s=2.5", "sigma_w=[3,4]",
                    "transition_probability=[[0.95,0.05],[0.1,0.9]]", "transition_possibility=[[1,0.5],[0.25,1]]"}));
  using restatement::Kind, restatement::Order;
  for (const auto& [name, kind, order] :
       {std::tuple{"imm", Kind::imm, Order::interacting}, std::tuple{"himm", Kind::himm, Order::interacting},
        std::tuple{"gpb2", Kind::imm, Order::second_order}, std::tuple{"viterbi", Kind::himm, Order::second_order}}) {
    SCOPED_TRACE(name);
    restatement::Options options;
    options.kind = kind;
    options.order = order;
    options.lift = restatement::Lift::borrowed_variance;
    options.mixed_covariance = restatement::MixedCovariance::own_recentred;
    expect_restated(options, points, of_filter(found, name));
  }
}

TEST(HimmDemoSmoothing, IsOfEachFilterThatAsksForIt) {
  const std::string text = csv(turning_target());
  const auto both = rows(estimates(text, {"filters=[imm,imm_smoothed]", "filter.imm_smoothed.smooth=true"}));
  const auto filtered = rows(estimates(text, {"filters=[imm]"}));
  const auto smoothed = rows(estimates(text, {"filters=[imm]", "smooth=true"}));
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
  const auto found = estimates(csv(points), sets);
  EXPECT_EQ(found, estimates(csv(points), timed));
  EXPECT_EQ(rows(found).size(), points.size());
}

TEST(HimmDemoSmoothing, TakesAStartWithoutVariance) {
  const auto found = rows(estimates(
      csv(turning_target()), {"filters=imm", "smooth=true", "models=[dwna]", "sigma_w=0", "start=given",
                              "start_mean=[0,0,0,0,0,0,0,0,0]", "start_covariance_diagonal=[0,0,0,0,0,0,0,0,0]"}));
  EXPECT_EQ(std::stod(found.front().at("x_m")), 0.0) << "what is certain stays so";
  EXPECT_EQ(std::stod(found.front().at("sigma_x_m")), 0.0);
}

TEST(HimmDemoSmoothing, DoesNotReachOverARestart) {
  auto points = turning_target();
  for (std::size_t k = 50; k < points.size(); ++k) points[k].time += 100.0;
  const std::vector<Point> sooner(points.begin(), points.begin() + 50), later(points.begin() + 50, points.end());
  const std::vector<std::string> sets = {"filters=imm", "restart_after_s=20", "smooth=true"};
  const auto all = estimates(csv(points), sets);
  const auto second = estimates(csv(later), sets);
  EXPECT_EQ(all, estimates(csv(sooner), sets) + second.substr(second.find('\n') + 1));
}

TEST(HimmDemoSmoothing, OfOneTrackIsAsIfItWereAlone) {
  const auto points = turning_target();
  std::string all = "time_s,ship,x_m,y_m\n", alone = "time_s,x_m,y_m\n";
  for (const auto& point : points) {
    const std::string rest = exact(point.z[0]) + "," + exact(point.z[1]) + "\n";
    all += exact(point.time) + ",a," + rest + exact(point.time) + ",b,0,0\n";
    alone += exact(point.time) + "," + rest;
  }
  auto found = rows(estimates(all, {"filters=himm", "smooth=true"}, {"--track-id", "ship"}));
  std::erase_if(found, [](const TextRow& row) { return row.at("track") != "a"; });
  for (auto& row : found) row.erase("track");
  EXPECT_EQ(found, rows(estimates(alone, {"filters=himm", "smooth=true"})));
}

TEST(HimmDemoSmoothing, IsBetterThanTheFilterInEveryPhaseOfThePaper) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "out";
  program::succeeded(himm_demo({"simulate", "--runs", "20", "--quiet", "--out", out},
                               {"filters=[imm,himm,imm_smoothed,himm_smoothed]", "filter.imm_smoothed.smooth=true",
                                "filter.himm_smoothed.smooth=true", "lift=borrowed_variance"}));
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
    const auto by_time = rows(estimates(csv(points), {"filters=[imm,himm,viterbi]", "sojourn_s=[60,8]"}));
    const auto by_scan = rows(estimates(
        csv(points), {"filters=[imm,himm,viterbi]", "transition_probability=" + transition_over(T, 60.0, 8.0, false),
                      "transition_possibility=" + transition_over(T, 60.0, 8.0, true)}));
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
      rows(estimates(text, {"filters=imm", "models=[dwna,dwna]", "sojourn_s=[20,5]", "start=given", "start_time_s=0",
                            "start_mean=[0,0,0,0,0,0,0,0,0]", "start_covariance_diagonal=[1,1,1,1,1,1,1,1,1]"}));
  ASSERT_EQ(found.size(), 4U);
  for (const auto& row : found) {
    const double a = 0.05, b = 0.2, t = std::stod(row.at("time_s"));
    const double first = b / (a + b) + (0.5 - b / (a + b)) * std::exp(-(a + b) * t);  // from equal weights
    EXPECT_CLOSE(std::stod(row.at("weight_dwna")), first, 1e-12);
  }
}

}  // namespace
