#include <sigmax/hybrid/history_filter.hpp>

#include <gtest/gtest.h>

#include <sigmax/estimation/fixed_step_motion.hpp>
#include <sigmax/hybrid/target.hpp>

#include "hybrid/banks.hpp"
#include "support/history_restatement.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using namespace support;

const VectorBank bank{calm(1.0), calm(5.0), turning()};

/// No two ways have one weight, so that nothing ties where histories are dropped.
template <Uncertainty Kind>
Relation<Kind, Kind> untied() {
  if constexpr (std::is_same_v<Kind, Random>)
    return transition_by<Kind>({{0.90, 0.073, 0.027}, {0.113, 0.80, 0.087}, {0.021, 0.079, 0.90}});
  else
    return transition_by<Kind>({{1.0, 0.073, 0.027}, {0.113, 1.0, 0.087}, {0.021, 0.079, 1.0}});
}

template <Uncertainty Kind>
HistoryFilter<VectorBank, Kind> made(const HistoryRules<Kind>& rules, std::vector<double> scales = {5.0, 21.0}) {
  Interaction<Kind> interaction{Lift::prior};
  interaction.entry.scales = std::move(scales);
  return {bank, untied<Kind>(), starts(), rules, interaction};
}

template <Uncertainty Kind>
restatement::HistoryFilter restated(const HistoryFilter<VectorBank, Kind>& filter) {
  std::vector<restatement::Model> models;
  std::vector<restatement::State> states;
  for (const Planar& model : filter.system().models()) models.push_back(restate(model));
  for (const State& state : filter.estimates()) states.push_back(restate(state));
  restatement::HistoryOptions options;
  options.kind = std::is_same_v<Kind, Fuzzy> ? restatement::Kind::himm : restatement::Kind::imm;
  options.histories = filter.rules().histories;
  options.least = filter.rules().least_log_weight;
  options.cut = filter.rules().cut;
  options.tempering = filter.rules().tempering;
  options.scales = filter.interaction().entry.scales;
  return {models, restate(filter.system().transition()), states, options};
}

void step(restatement::HistoryFilter& filter, const Scan& scan) {
  if (scan.z)
    filter.step(scan.dt, entries(scan.z->mean), dense(scan.z->covariance));
  else
    filter.step(scan.dt);
}

void require_near(const restatement::State& found, const restatement::State& expected) {
  ASSERT_PRED_FORMAT3(near, std::span<const double>(found.mean), std::span<const double>(expected.mean), 1e-9);
  ASSERT_PRED_FORMAT3(near, std::span<const double>(found.covariance.values),
                      std::span<const double>(expected.covariance.values), 1e-9);
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

template <Uncertainty Kind>
void equals_the_restatement(const HistoryRules<Kind>& rules) {
  auto filter = made<Kind>(rules);
  auto expected = restated(filter);
  for (const Scan& scan : measured_flight()) {
    support::step(filter, scan);
    step(expected, scan);
    ASSERT_EQ(filter.state().size(), expected.histories().size());
    const auto logs = expected.log_weights();
    ASSERT_PRED_FORMAT3(near, filter.belief().logs(), std::span<const double>(logs), 1e-9);
    ASSERT_EQ(filter.most_likely_mode(), expected.winner());
    for (std::size_t j = 0; j < 3; ++j) require_near(restate(filter.estimates()[j]), expected.of_mode(j));
    require_near(restate(filter.estimate()), expected.estimate());
    ASSERT_PRED_FORMAT3(near, filter.nis(), expected.nis(), 1e-9);
    ASSERT_PRED_FORMAT3(near, filter.gate_distance(), expected.gate_distance(), 1e-9);
  }
}

TEST(HistoryFilter, EqualsTheRestatementOfAFuzzyModeWhileHistoriesAreDropped) {
  equals_the_restatement<Fuzzy>({.histories = 9});
  equals_the_restatement<Fuzzy>({.histories = 40, .least_log_weight = -6.0, .cut = 1.0, .tempering = 0.6});
}

TEST(HistoryFilter, EqualsTheRestatementOfARandomModeWhileHistoriesAreDropped) {
  equals_the_restatement<Random>({.histories = 9});
  equals_the_restatement<Random>({.histories = 40, .least_log_weight = -6.0, .cut = 0.2, .tempering = 0.6});
}

/// All mode sequences of a few steps, each with a Kalman filter from its start: and its sum twin by enumeration.
template <Uncertainty Kind>
void equals_all_histories() {
  constexpr std::size_t steps = 4, M = 3;
  const std::vector<double> scales{5.0, 21.0};
  auto scans = manoeuvring_target(steps);
  scans[2].z.reset();
  auto filter = made<Kind>({.histories = 3000, .least_log_weight = -1e300}, scales);
  for (const Scan& scan : scans) support::step(filter, scan);

  // A sequence is its modes and, wherever the turn begins, the number of a scale: digits of base 3 and of base 2.
  restatement::Vector logs(M, restatement::nothing);
  std::array<State, M> best;
  std::array<double, M> greatest{restatement::nothing, restatement::nothing, restatement::nothing};
  std::size_t sequences = 0;
  for (std::size_t code = 0; code < 243; ++code)
    for (std::size_t scale_code = 0; scale_code < 16; ++scale_code) {
      std::array<std::size_t, steps + 1> modes{};
      for (std::size_t k = 0, rest = code; k <= steps; ++k, rest /= M) modes[k] = rest % M;
      Alone alone{bank[modes[0]], starts()[modes[0]]};
      double log_weight = 0.0;
      bool counted = true;
      for (std::size_t k = 1; k <= steps && counted; ++k) {
        const std::size_t from = modes[k - 1], to = modes[k], scale = scale_code >> (k - 1) & 1U;
        const bool begins = from != 2 && to == 2;
        counted = begins || scale == 0;  // a scale that nothing asks for is no other sequence
        log_weight += std::log(filter.system().transition()(from, to));
        if (begins && std::is_same_v<Kind, Random>) log_weight -= std::log(2.0);
        if (bank[from].size() != bank[to].size()) {
          State read{Eigen::VectorXd::Zero(bank[to].size()), Eigen::MatrixXd::Zero(bank[to].size(), bank[to].size())};
          const Eigen::Index n = std::min(read.size(), alone.state.size());
          read.mean.head(n) = alone.state.mean.head(n);
          read.covariance.topLeftCorner(n, n) = alone.state.covariance.topLeftCorner(n, n);
          for (Eigen::Index i = n; i < read.size(); ++i) read.covariance(i, i) = scales[scale] * scales[scale];
          alone.state = read;
        }
        alone.model = bank[to];
        alone.step(scans[k - 1]);
      }
      if (!counted) continue;
      ++sequences;
      const std::size_t last = modes[steps];
      log_weight += alone.log_likelihood;
      logs[last] = restatement::log_total(
          {logs[last], log_weight}, std::is_same_v<Kind, Fuzzy> ? restatement::Kind::himm : restatement::Kind::imm);
      if (log_weight > greatest[last]) {
        greatest[last] = log_weight;
        best[last] = alone.state;
      }
    }
  EXPECT_EQ(filter.state().size(), sequences);
  for (std::size_t j = 0; j < M; ++j) {
    EXPECT_PRED_FORMAT3(near, filter.belief().log(j) - filter.belief().log(0), logs[j] - logs[0], 1e-9);
    if constexpr (std::is_same_v<Kind, Fuzzy>) {
      EXPECT_PRED_FORMAT3(near_matrix, filter.estimates()[j].mean, best[j].mean, 1e-9);
      EXPECT_PRED_FORMAT3(near_matrix, filter.estimates()[j].covariance, best[j].covariance, 1e-9);
    }
  }
}

TEST(HistoryFilter, WithoutDroppingIsTheMaximumOrTheSumOverAllHistories) {
  equals_all_histories<Fuzzy>();
  equals_all_histories<Random>();
}

template <Uncertainty Kind>
void keeps_the_laws() {
  HistoryFilter<VectorBank, Kind> one{VectorBank{turning()}, transition_by<Kind>({{1.0}}), {starts()[2]}};
  HistoryFilter<VectorBank, Kind> apart{VectorBank{calm(), turning()}, transition_by<Kind>({{1.0, 0.0}, {0.0, 1.0}}),
                                        std::vector<State>{starts()[0], starts()[2]}};
  std::vector<Alone> alone{{calm(), starts()[0]}, {turning(), starts()[2]}};
  for (const Scan& scan : manoeuvring_target(60)) {
    support::step(one, scan);
    support::step(apart, scan);
    for (Alone& each : alone) each.step(scan);
    ASSERT_PRED_FORMAT3(near_matrix, one.estimate().mean, alone[1].state.mean, 1e-12);
    ASSERT_PRED_FORMAT3(near_matrix, one.estimate().covariance, alone[1].state.covariance, 1e-12);
    ASSERT_EQ(apart.state().size(), 2U);
    for (std::size_t j = 0; j < 2; ++j) ASSERT_EQ(apart.estimates()[j].mean, alone[j].state.mean);
    ASSERT_PRED_FORMAT3(near, apart.belief().log(0) - apart.belief().log(1),
                        alone[0].log_likelihood - alone[1].log_likelihood, 1e-9);
  }
}

TEST(HistoryFilter, OneModelIsTheKalmanFilterAndTheIdentityNeverBranches) {
  keeps_the_laws<Fuzzy>();
  keeps_the_laws<Random>();
}

template <Uncertainty Kind>
void leaves_a_mode_that_nothing_reaches() {
  HistoryFilter<VectorBank, Kind> filter{VectorBank{calm(1.0), calm(5.0)},
                                         transition_by<Kind>({{1.0, 0.0}, {1.0, 0.0}}),
                                         std::vector<State>{starts()[0], starts()[0]}};
  Alone alone{calm(1.0), starts()[0]};
  for (const Scan& scan : manoeuvring_target(30)) {
    support::step(filter, scan);
    alone.step(scan);
    ASSERT_EQ(filter.belief().log(1), log_zero);
    ASSERT_EQ(filter.most_likely_mode(), 0U);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().mean, alone.state.mean, 1e-12);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().covariance, alone.state.covariance, 1e-12);
  }
}

TEST(HistoryFilter, AModeThatNothingReachesHasNoWeight) {
  leaves_a_mode_that_nothing_reaches<Fuzzy>();
  leaves_a_mode_that_nothing_reaches<Random>();
}

/// Measures the position in millimetres: every Λ is 10⁻⁶ times as great.
struct Millimetres {
  static constexpr int measurement_size = 2;
  static constexpr int seen_size = 2;
  template <class Scalar>
  Eigen::Matrix<Scalar, 2, 1> measure(const Eigen::Matrix<Scalar, 2, 1>& x) const {
    return Scalar(1000.0) * x;
  }
  SquareMatrix<2> measurement_jacobian(const Vector<2>&) const { return 1000.0 * SquareMatrix<2>::Identity(); }
};

TEST(HistoryFilter, ScalingTheLikelihoodChangesNothing) {
  auto metres = made<Fuzzy>({.histories = 12});
  auto millimetres = metres;
  for (const Scan& scan : measured_flight()) {
    support::step(metres, scan);
    millimetres.step(scan.dt, {1e3 * scan.z->mean, 1e6 * scan.z->covariance}, Millimetres{});
    ASSERT_PRED_FORMAT3(near, millimetres.belief().logs(), metres.belief().logs(), 1e-8);
    ASSERT_PRED_FORMAT3(near_matrix, millimetres.estimate().mean, metres.estimate().mean, 1e-9);
  }
}

/// After one step from one estimate a mode there is no history yet that the others have merged: GPB2 and the Viterbi
/// filter are this filter then, and without a measurement so are the IMM and the HIMM.
template <Uncertainty Kind>
void is_the_others_for_one_step() {
  const auto filter = made<Kind>({}, {17.0});
  const auto interaction = filter.interaction();
  Interaction<Kind> selected = interaction;
  if constexpr (std::is_same_v<Kind, Fuzzy>) selected.collapse.mixed_covariance = MixedCovariance::selected;
  const auto require_same = [](const auto& found, const auto& expected) {
    ASSERT_PRED_FORMAT3(near, found.belief().logs(), expected.belief().logs(), 1e-12);
    for (std::size_t j = 0; j < 3; ++j) {
      ASSERT_PRED_FORMAT3(near_matrix, found.estimates()[j].mean, expected.estimates()[j].mean, 1e-9);
      ASSERT_PRED_FORMAT3(near_matrix, found.estimates()[j].covariance, expected.estimates()[j].covariance, 1e-9);
    }
  };
  auto measured = filter, missed = filter;
  SecondOrderMultipleModel<VectorBank, Kind> pairs{bank, untied<Kind>(), starts(), interaction};
  InteractingMultipleModel<VectorBank, Kind> mixed{bank, untied<Kind>(), starts(), selected};
  const Scan scan = manoeuvring_target(1).front();
  support::step(measured, scan);
  support::step(pairs, scan);
  require_same(measured, pairs);
  missed.step(0.3);
  mixed.step(0.3);
  require_same(missed, mixed);
}

TEST(HistoryFilter, IsTheSecondOrderFilterForOneStepAndWithoutAMeasurementTheInteractingOne) {
  is_the_others_for_one_step<Fuzzy>();
  is_the_others_for_one_step<Random>();
}

/// Models that forget all: the likelihood is of the mode alone, not of its history.
TEST(HistoryFilter, IsTheForwardPassOfAHiddenMarkovModelIfLikelihoodsForgetTheHistory) {
  using Forgets = FixedStepMotion<1>;
  const auto model = [](double variance) {
    return Forgets("forgets", {"x"}, 1.0, SquareMatrix<1>::Zero(), SquareMatrix<1>::Constant(variance));
  };
  const RandomVariable mode{"mode", 2};
  const Relation transition{mode, mode, {{0.9, 0.1}, {0.3, 0.7}}};
  const Gaussian<1> start{Vector<1>::Zero(), SquareMatrix<1>::Identity()};
  HistoryFilter<std::tuple<Forgets, Forgets>, Random> filter{std::tuple{model(1.0), model(9.0)},
                                                             transition,
                                                             std::tuple{start, start},
                                                             {.histories = 200, .least_log_weight = -1e300}};
  double calm = 0.5, wild = 0.5;
  for (const double z : {0.3, -4.0, 2.5, 0.1, 0.2, 6.0}) {
    filter.step(1.0, {Vector<1>::Constant(z), SquareMatrix<1>::Constant(0.5)}, ComponentSensor<1>(std::array{0}));
    const auto density = [&](double variance) { return std::exp(-0.5 * z * z / variance) / std::sqrt(variance); };
    const double next_calm = (0.9 * calm + 0.3 * wild) * density(1.5),
                 next_wild = (0.1 * calm + 0.7 * wild) * density(9.5);
    calm = next_calm / (next_calm + next_wild);
    wild = 1.0 - calm;
    ASSERT_PRED_FORMAT3(near, filter.belief()[0], calm, 1e-12);
  }
}

template <Uncertainty Kind>
void goes_on_to_the_bit() {
  auto filter = made<Kind>({});
  auto other = filter;
  const auto scans = manoeuvring_target(60);
  for (std::size_t k = 0; k < 30; ++k) support::step(filter, scans[k]);
  other.restore(filter.state());
  for (std::size_t k = 30; k < 60; ++k) {
    support::step(filter, scans[k]);
    support::step(other, scans[k]);
    ASSERT_EQ(filter.most_likely_mode(), other.most_likely_mode());
    ASSERT_EQ(filter.estimate().mean, other.estimate().mean);
    ASSERT_EQ(filter.estimate().covariance, other.estimate().covariance);
    for (std::size_t j = 0; j < 3; ++j) {
      ASSERT_EQ(filter.estimates()[j].covariance, other.estimates()[j].covariance);
      ASSERT_EQ(filter.belief().log(j), other.belief().log(j));
    }
  }
  filter.restart(starts());
  EXPECT_EQ(filter.state().size(), 3U);
  EXPECT_EQ(filter.estimates()[2].mean, starts()[2].mean);
}

TEST(HistoryFilter, GoesOnFromARestoredStateToTheBit) {
  goes_on_to_the_bit<Fuzzy>();
  goes_on_to_the_bit<Random>();
}

TEST(HistoryFilter, AGateMakesAMissOfAMeasurementOutsideIt) {
  auto gated = made<Fuzzy>({});
  std::size_t missed = 0;
  for (const Scan& scan : manoeuvring_target(110)) {
    if (!scan.z) continue;
    auto taking = gated, missing = gated;
    taking.step(scan.dt, *scan.z);
    missing.step(scan.dt);
    gated.step(scan.dt, *scan.z, 1.0);
    ASSERT_EQ(gated.measured(), taking.gate_distance() <= 1.0);
    ASSERT_EQ(gated.estimate().mean, (gated.measured() ? taking : missing).estimate().mean);
    missed += gated.measured() ? 0 : 1;
    gated = taking;
  }
  EXPECT_GT(missed, 20U);
}

/// The best of all histories, told from the links, ends where the filter is and has the mode's changes in its dates.
TEST(HistoryFilter, ATargetTellsWhenItsModeChanged) {
  const VectorBank two{calm(3.0), turning(0.5)};
  HistoryFilter<VectorBank, Fuzzy> filter{two, transition_by<Fuzzy>({{1.0, 0.008}, {0.03, 1.0}}),
                                          std::vector<State>{starts()[0], starts()[2]}};
  Target target{filter,
                [](const Gaussian<2>&) {
                  return std::vector<State>{starts()[0], starts()[2]};
                },
                TargetRules{.gate_probability = 1.0, .record = true}};
  double time = 0.0, begins = 0.0, ends = 0.0;
  std::size_t k = 0;
  for (const Scan& scan : manoeuvring_target()) {
    time += scan.dt;
    if (k == 80) begins = time;
    if (k == 130) ends = time;
    if (k++ == 0) {
      target.take(time, *scan.z);
      continue;
    }
    if (scan.z)
      target.take(time, *scan.z);
    else
      target.take(time);
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

/// A target takes a late plot as if it had been in time, and its record is smoothed.
TEST(HistoryFilter, IsFollowedByATargetWithLatePlotsAndSmoothed) {
  const auto start = [](const Gaussian<2>& z) {
    std::vector<State> all = starts();
    for (State& each : all) each.mean.head<2>() = z.mean;
    return all;
  };
  const TargetRules rules{.gate_probability = 0.9999, .buffer = 3, .record = true};
  Target target{made<Fuzzy>({}), start, rules};
  auto late = target;
  const auto scans = manoeuvring_target(60);
  std::vector<std::pair<double, Gaussian<2>>> plots;
  double time = 0.0;
  for (const Scan& scan : scans) {
    time += scan.dt;
    if (scan.z && scan.dt > 0.0) plots.emplace_back(time, *scan.z);
  }
  for (const auto& [at, z] : plots) target.take(at, z);
  for (std::size_t k = 0; k < plots.size(); ++k) {
    const std::size_t swapped = k % 5 == 3 && k + 1 < plots.size() ? k + 1 : k % 5 == 4 ? k - 1 : k;
    late.take(plots[swapped].first, plots[swapped].second);
  }
  EXPECT_EQ(late.time(), target.time());
  EXPECT_EQ(late.filter().estimate().mean, target.filter().estimate().mean);
  EXPECT_EQ(late.filter().estimate().covariance, target.filter().estimate().covariance);

  double filtered = 0.0, smoothed = 0.0;
  std::size_t points = 0;
  target.smoothed([&](const auto& kept, const auto& state) {
    filtered += target.filter().estimate(kept.step.state).covariance(0, 0);
    smoothed += target.filter().estimate(state).covariance(0, 0);
    ++points;
  });
  EXPECT_EQ(points, plots.size());
  EXPECT_LT(smoothed, 0.7 * filtered);
}

TEST(HistoryFilter, TurnsWithItsCoordinates) {
  auto filter = made<Random>({});
  const auto scans = manoeuvring_target(30);
  for (std::size_t k = 0; k < 20; ++k) support::step(filter, scans[k]);
  auto turned = filter;
  const SquareMatrix<2> A{{0.6, -0.8}, {0.8, 0.6}};
  const Vector<2> b(100.0, -7.0);
  turned.transform(A, b);
  for (std::size_t k = 20; k < 30; ++k) {
    support::step(filter, scans[k]);
    Scan scan = scans[k];
    if (scan.z) scan.z = Gaussian<2>{A * scan.z->mean + b, A * scan.z->covariance * A.transpose()};
    support::step(turned, scan);
    ASSERT_PRED_FORMAT3(near_matrix, turned.estimate().mean.head<2>(), A * filter.estimate().mean.head<2>() + b, 1e-9);
  }
}

TEST(HistoryFilter, RefusesRulesThatMakeNoSense) {
  const auto refuses = [](const HistoryRules<Fuzzy>& rules, std::initializer_list<std::string_view> words) {
    return throws<std::invalid_argument>([&] { made<Fuzzy>(rules); }, words);
  };
  EXPECT_TRUE(refuses({.histories = 2}, {"2 histories", "3 modes"}));
  EXPECT_TRUE(refuses({.least_log_weight = 0.0}, {"dropped"}));
  EXPECT_TRUE(refuses({.cut = 1.5}, {"cut", "1.5"}));
  EXPECT_TRUE(refuses({.tempering = 0.0}, {"power"}));
  EXPECT_TRUE(throws<std::invalid_argument>([] { made<Fuzzy>({}, {}); }, {"no scale"}));
  EXPECT_TRUE(throws<std::invalid_argument>([] { made<Fuzzy>({}, {-3.0}); }, {"scale", "-3", "positive"}));
  auto filter = made<Fuzzy>({.histories = 5});
  const auto other = made<Fuzzy>({.histories = 6});
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.restore(other.state()); }, {"6 histories", "5"}));
}

}  // namespace
}  // namespace sigmax
