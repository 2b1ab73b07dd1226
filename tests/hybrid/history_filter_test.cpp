#include "hybrid/banks.hpp"
#include "support/history_restatement.hpp"

namespace history_filter_test {

/// No two ways have one weight, so that nothing ties where histories are dropped.
TargetChoice untied(bool fuzzy) {
  TargetChoice choice = chosen(fuzzy, Scheme::histories);
  choice.entry.scales = {5.0, 21.0};
  choice.transition = fuzzy ? Rows{{1.0, 0.073, 0.027}, {0.113, 1.0, 0.087}, {0.021, 0.079, 1.0}}
                            : Rows{{0.90, 0.073, 0.027}, {0.113, 0.80, 0.087}, {0.021, 0.079, 0.90}};
  return choice;
}

template <Uncertainty Kind>
HistoryFilter<Models, Kind> made(const HistoryRules<Kind>& rules,
                                 const TargetChoice& choice = untied(std::is_same_v<Kind, Fuzzy>)) {
  return {models_of(choice), transition_of<Kind>(choice), starts(choice), rules, interaction_of<Kind>(choice)};
}

template <Uncertainty Kind>
restatement::HistoryFilter restated(const HistoryRules<Kind>& rules) {
  const TargetChoice choice = untied(std::is_same_v<Kind, Fuzzy>);
  return {restated_models(choice),
          restate(choice.transition),
          restate(Estimates(starts())),
          {choice.fuzzy ? restatement::Kind::himm : restatement::Kind::imm, rules.histories, rules.least_log_weight,
           rules.cut, rules.tempering, choice.entry.scales}};
}

/// The flight with a measurement in every scan and time between them: else histories that changed at one or the other
/// scan tie but for rounding, and which of them is dropped is a matter of that.
std::vector<Scan> measured_flight() {
  std::vector<Scan> scans;
  double waited = 0.0;
  for (const Scan& scan : manoeuvring_target()) {
    waited += scan.dt;
    if (!scan.z || scan.dt == 0.0) continue;
    scans.push_back({waited, scan.z});
    waited = 0.0;
  }
  return scans;
}

template <class Filter>
void take(Filter& filter, const Scan& scan) {
  scan.z ? filter.step(scan.dt, *scan.z, PositionSensor<2>{}) : filter.step(scan.dt);
}

template <Uncertainty Kind>
void equals_the_restatement(const HistoryRules<Kind>& rules, const std::vector<Scan>& scans = measured_flight()) {
  auto filter = made<Kind>(rules);
  auto expected = restated<Kind>(rules);
  for (const Scan& scan : scans) {
    take(filter, scan);
    step(expected, scan);
    ASSERT_EQ(filter.state().histories.size(), expected.histories().size());
    const auto logs = expected.log_weights();
    ASSERT_CLOSE(filter.belief().logs(), std::span<const double>(logs), 1e-9);
    ASSERT_EQ(filter.most_likely_mode(), expected.winner());
    for (std::size_t j = 0; j < 3; ++j) ASSERT_CLOSE(filter.estimates()[j], expected.of_mode(j), 1e-9);
    ASSERT_CLOSE(filter.estimate(), expected.estimate(), 1e-9);
    if (!scan.z) continue;
    for (std::size_t j = 0; j < 3; ++j) {
      const AnyInnovation& found = filter.innovations()[j];
      ASSERT_CLOSE((Estimate{found.residual(), found.covariance()}), expected.innovation_of_mode(j), 1e-9);
    }
    ASSERT_CLOSE(filter.nis(), expected.nis(), 1e-9);
    ASSERT_CLOSE(filter.gate_distance(), expected.gate_distance(), 1e-9);
    ASSERT_CLOSE(filter.log_evidence(), expected.log_evidence(), 1e-9);
    ASSERT_CLOSE(filter.log_score(), expected.log_score(), 1e-9);
  }
}

TEST(HistoryFilter, EqualsTheRestatementWhileHistoriesAreDropped) {
  equals_the_restatement<Fuzzy>({.histories = 9});
  equals_the_restatement<Fuzzy>({.histories = 40, .least_log_weight = -6.0, .cut = 1.0, .tempering = 0.6});
  equals_the_restatement<Random>({.histories = 9});
  equals_the_restatement<Random>({.histories = 40, .least_log_weight = -6.0, .cut = 0.2, .tempering = 0.6});
}

/// All mode sequences of a few steps, each with a Kalman filter from its start: and its sum twin by enumeration.
TEST(HistoryFilter, WithoutDroppingIsTheMaximumOrTheSumOverAllHistories) {
  auto scans = manoeuvring_target(4);
  scans[2].z.reset();
  equals_the_restatement<Fuzzy>({.histories = 3000, .least_log_weight = -1e300}, scans);
  equals_the_restatement<Random>({.histories = 3000, .least_log_weight = -1e300}, scans);
}

TEST(HistoryFilter, AModeThatNothingReachesHasNoWeight) {
  for (const bool fuzzy : {false, true}) {
    AnyFilter filter(with(chosen(fuzzy, Scheme::histories), {calm(1.0), calm(5.0)}, {{1.0, 0.0}, {1.0, 0.0}}),
                     std::vector<State>(2, starts()[0]));
    AnyFilter expected = alone(calm(1.0), starts()[0]);
    for (const Scan& scan : manoeuvring_target(30)) {
      filter.step(scan);
      expected.step(scan);
      ASSERT_EQ(filter.logs[1], log_zero);
      ASSERT_EQ(filter.winner, 0U);
      ASSERT_CLOSE(filter.estimate, expected.estimate, 1e-11);
    }
  }
}

/// The best of all histories, told from the links, ends where the filter is and has the mode's changes in its dates.
TEST(HistoryFilter, ATargetTellsWhenItsModeChanged) {
  const TargetChoice choice =
      with(chosen(true, Scheme::histories), {calm(3.0), turning(0.5)}, {{1.0, 0.008}, {0.03, 1.0}});
  Target target{made<Fuzzy>({}, choice),
                [&](std::span<const Detection> detections, std::size_t) -> std::optional<StartAt<std::vector<State>>> {
                  return StartAt<std::vector<State>>{detections.back().time, starts(choice)};
                },
                TargetRules{.gate_probability = 1.0, .record = true}};
  double time = 0.0, begins = 0.0, ends = 0.0;
  std::size_t k = 0;
  for (const Scan& scan : manoeuvring_target()) {
    time += scan.dt;
    if (k == 80) begins = time;
    if (k == 130) ends = time;
    ++k;
    target.take(scan.z ? Detection(time, *scan.z) : Detection(time));
  }
  std::vector<std::pair<double, std::size_t>> stays;
  target.explained([&](const auto& kept, std::size_t mode) { stays.emplace_back(kept.time, mode); });
  ASSERT_EQ(stays.back().second, target.filter().most_likely_mode());
  std::size_t turns = 0;
  for (std::size_t s = 0; s < stays.size(); ++s) {
    if (s > 0) EXPECT_NE(stays[s].second, stays[s - 1].second);
    if (stays[s].second != 1 || stays[s].first < 5.0) continue;
    ++turns;
    EXPECT_NEAR(stays[s].first, begins, 1.0);
    ASSERT_LT(s + 1, stays.size());
    EXPECT_NEAR(stays[s + 1].first, ends, 1.0);
  }
  EXPECT_EQ(turns, 1U);
}

TEST(HistoryFilter, TurnsWithItsCoordinates) {
  auto filter = made<Random>({});
  const auto scans = manoeuvring_target(30);
  for (std::size_t k = 0; k < 20; ++k) take(filter, scans[k]);
  auto turned = filter;
  const SquareMatrix<2> A{{0.6, -0.8}, {0.8, 0.6}};
  const Vector<2> b(100.0, -7.0);
  turned.transform(A, b);
  for (std::size_t k = 20; k < 30; ++k) {
    take(filter, scans[k]);
    Scan scan = scans[k];
    if (scan.z) scan.z = Gaussian<2>{A * scan.z->mean + b, A * scan.z->covariance * A.transpose()};
    take(turned, scan);
    ASSERT_CLOSE(turned.estimate().mean.head<2>(), A * filter.estimate().mean.head<2>() + b, 1e-9);
  }
}

TEST(HistoryFilter, RefusesRulesThatMakeNoSense) {
  EXPECT_INVALID(("2 histories", "3 modes"), made<Fuzzy>({.histories = 2}));
  EXPECT_INVALID(("dropped"), made<Fuzzy>({.least_log_weight = 0.0}));
  EXPECT_INVALID(("cut", "1.5"), made<Fuzzy>({.cut = 1.5}));
  EXPECT_INVALID(("cut", "-0.5"), made<Fuzzy>({.cut = -0.5}));
  EXPECT_INVALID(("power"), made<Fuzzy>({.tempering = 0.0}));
  EXPECT_INVALID(("power"), made<Fuzzy>({.tempering = 1.5}));
  auto filter = made<Fuzzy>({.histories = 5});
  const auto other = made<Fuzzy>({.histories = 6});
  EXPECT_INVALID(("6 histories", "5"), filter.restore(other.state()));
}

}  // namespace history_filter_test
