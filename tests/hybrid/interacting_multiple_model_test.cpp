#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <numeric>

#include "hybrid/banks.hpp"
#include "support/throws.hpp"

namespace sigmax {

template class InteractingMultipleModel<VectorBank, Random>;
template class InteractingMultipleModel<VectorBank, Fuzzy>;
template class InteractingMultipleModel<TupleBank, Random>;
template class InteractingMultipleModel<TupleBank, Fuzzy>;

namespace {

using support::agrees;
using support::dense;
using support::entries;
using support::holds;
using support::manoeuvring_target;
using support::near;
using support::near_matrix;
using support::number_between;
using support::require_near;
using support::require_near_matrix;
using support::restate;
using support::Scan;
using support::throws;

using State = Gaussian<Eigen::Dynamic, 6>;

template <Uncertainty Kind>
using Filter = InteractingMultipleModel<VectorBank, Kind>;

const RandomVariable random_motion{"motion", {"calm", "rough", "turn"}};
const FuzzyVariable fuzzy_motion{"motion", {"calm", "rough", "turn"}};
const Relation random_transition{
    random_motion, random_motion, {{0.90, 0.07, 0.03}, {0.10, 0.80, 0.10}, {0.02, 0.08, 0.90}}};
const Relation fuzzy_transition{fuzzy_motion, fuzzy_motion, {{1.0, 0.5, 0.2}, {0.5, 1.0, 0.5}, {0.1, 0.5, 1.0}}};

template <Uncertainty Kind>
const Relation<Kind, Kind>& transition_of() {
  if constexpr (std::is_same_v<Kind, Random>)
    return random_transition;
  else
    return fuzzy_transition;
}

/// A mode variable without names, and the transition that these rows are.
template <Uncertainty Kind>
Relation<Kind, Kind> transition_by(const std::vector<std::vector<double>>& rows) {
  const Variable<Kind> motion{"motion", rows.size()};
  return {motion, motion, rows};
}

Planar calm(double sigma_w = 1.0) { return Planar{dwna<2>(sigma_w)}; }
Planar turning(double sigma_w = 4.0) { return Planar{dwpa<2>(sigma_w)}; }

/// Every start is wrong in its own way.
std::vector<State> starts() {
  SquareMatrix<4> small = 50.0 * SquareMatrix<4>::Identity();
  small.topRightCorner<2, 2>().setConstant(5.0);
  small.bottomLeftCorner<2, 2>().setConstant(5.0);
  SquareMatrix<6> large = 80.0 * SquareMatrix<6>::Identity();
  large.topRightCorner<2, 2>().setConstant(3.0);
  large.bottomLeftCorner<2, 2>().setConstant(3.0);
  return {State{Vector<4>{12005, 7990, -95, -103}, small}, State{Vector<4>{11996, 8004, -99, -108}, 2.0 * small},
          State{Vector<6>{12001, 8003, -101, -95, 3, -4}, large}};
}

template <Uncertainty Kind>
Filter<Kind> vector_filter(const Interaction<Kind>& interaction = {}) {
  return {VectorBank{calm(1.0), calm(5.0), turning()}, transition_of<Kind>(), starts(), interaction};
}
template <Uncertainty Kind>
InteractingMultipleModel<TupleBank, Kind> tuple_filter(const Interaction<Kind>& interaction = {}) {
  const auto all = starts();
  return {TupleBank{dwna<2>(1.0), dwna<2>(5.0), dwpa<2>(4.0)}, transition_of<Kind>(),
          std::tuple{Gaussian<4>{all[0].mean, all[0].covariance}, Gaussian<4>{all[1].mean, all[1].covariance},
                     Gaussian<6>{all[2].mean, all[2].covariance}},
          interaction};
}

template <Uncertainty Kind>
restatement::Filter restated(const VectorBank& models, const Relation<Kind, Kind>& transition,
                             const std::vector<State>& start, const Interaction<Kind>& interaction) {
  std::vector<restatement::Model> all;
  for (const Planar& model : models) all.push_back(restate(model));
  std::vector<restatement::State> states;
  for (const State& state : start) states.push_back(restate(state));
  return {all, restate(transition), states, restatement::Vector(models.size(), 1.0), restate(interaction)};
}

/// Both banks against the restatement over the whole flight.
template <Uncertainty Kind>
void equals_the_restatement(const Interaction<Kind>& interaction, std::size_t length = 220) {
  auto vector = vector_filter<Kind>(interaction);
  auto tuple = tuple_filter<Kind>(interaction);
  auto expected = restated<Kind>({calm(1.0), calm(5.0), turning()}, transition_of<Kind>(), starts(), interaction);
  const auto scans = manoeuvring_target(length);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    step(vector, scans[k]);
    step(tuple, scans[k]);
    step(expected, scans[k]);
    ASSERT_TRUE(agrees(vector, expected)) << "vector, scan " << k;
    ASSERT_TRUE(agrees(tuple, expected)) << "tuple, scan " << k;
  }
}

constexpr auto lifts = {Lift::zero, Lift::borrowed_variance, Lift::unbiased};
constexpr auto readings = {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred,
                           MixedCovariance::released};
constexpr auto ties = {Tie::stay, Tie::first, Tie::last};

TEST(InteractingMultipleModel, ImmEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Random>({lift, {}, Tie::stay});
}

TEST(InteractingMultipleModel, ImmWithReleasedWeightsEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Random>({lift, {MixingWeights::released}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithTheSelectedCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Fuzzy>({lift, {MixedCovariance::selected}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithItsOwnCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Fuzzy>({lift, {MixedCovariance::own}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithItsOwnRecentredCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Fuzzy>({lift, {MixedCovariance::own_recentred}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithTheReleasedCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Fuzzy>({lift, {MixedCovariance::released}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmEqualsTheRestatementUnderEachTieRule) {
  for (const Tie mixing : ties)
    for (const Tie output : ties)
      equals_the_restatement<Fuzzy>({Lift::zero, {MixedCovariance::selected, mixing}, output}, 120);
}

/// The paper's own pair: equal σ_w and ε = ½, where a reset DWPA predicts what DWNA predicts, and so ties with it.
template <Uncertainty Kind>
Filter<Kind> paper_pair(const Interaction<Kind>& interaction) {
  const auto all = starts();
  return {VectorBank{calm(3.0), turning(3.0)},
          transition_by<Kind>({{std::is_same_v<Kind, Random> ? 0.95 : 1.0, std::is_same_v<Kind, Random> ? 0.05 : 0.5},
                               {std::is_same_v<Kind, Random> ? 0.05 : 0.5, std::is_same_v<Kind, Random> ? 0.95 : 1.0}}),
          std::vector<State>{all[0], all[2]}, interaction};
}

TEST(InteractingMultipleModel, TheExactTiesOfThePapersPairAreBrokenAsTheRestatementBreaksThem) {
  const auto all = starts();
  for (const Tie mixing : ties)
    for (const Tie output : ties) {
      const Interaction<Fuzzy> interaction{Lift::zero, {MixedCovariance::selected, mixing}, output};
      auto filter = paper_pair(interaction);
      auto expected =
          restated<Fuzzy>({calm(3.0), turning(3.0)}, filter.system().transition(), {all[0], all[2]}, interaction);
      std::size_t tied = 0;
      for (const Scan& scan : manoeuvring_target(120)) {
        step(filter, scan);
        step(expected, scan);
        ASSERT_TRUE(agrees(filter, expected));
        // DWPA next comes as likely from DWNA, at ½ · 1, as from itself, at 1 · ½.
        if (std::abs(filter.belief().log(0) - std::log(2.0) - filter.belief().log(1)) <= tie_tolerance) ++tied;
      }
      EXPECT_GT(tied, 20U);
    }
}

/// One to four generated models with a generated transition, whose equal entries make ties, over a few scans.
template <Uncertainty Kind>
void generated_filters(const Interaction<Kind>& interaction) {
  const auto scans = manoeuvring_target(6);
  const auto modes = *rc::gen::inRange<std::size_t>(1, 5);
  VectorBank models;
  std::vector<State> start;
  std::vector<std::vector<double>> rows(modes, std::vector<double>(modes));
  for (std::size_t i = 0; i < modes; ++i) {
    const double sigma_w = *rc::gen::element(0.5, 3.0);
    models.push_back(*rc::gen::arbitrary<bool>() ? calm(sigma_w) : turning(sigma_w));
    const State from = starts()[models.back().order() == 2 ? 0 : 2];
    start.push_back({from.mean.array() + number_between(-20.0, 20.0), number_between(0.1, 9.0) * from.covariance});
    for (double& value : rows[i]) value = *rc::gen::element(0.0, 0.25, 0.5, 1.0);
    rows[i][i] = 1.0;
    if constexpr (std::is_same_v<Kind, Random>) {
      const double sum = std::accumulate(rows[i].begin(), rows[i].end(), 0.0);
      for (double& value : rows[i]) value /= sum;
    }
  }
  const auto transition = transition_by<Kind>(rows);
  Filter<Kind> filter{models, transition, start, interaction};
  auto expected = restated<Kind>(models, transition, start, interaction);
  for (const Scan& scan : scans) {
    step(filter, scan);
    step(expected, scan);
    if (const auto result = agrees(filter, expected); !result) RC_FAIL(std::string(result.message()));
  }
}

TEST(InteractingMultipleModel, AnyImmEqualsTheRestatement) {
  holds([] {
    generated_filters<Random>({*rc::gen::elementOf(std::vector(lifts)),
                               {*rc::gen::element(MixingWeights::correct, MixingWeights::released)},
                               *rc::gen::elementOf(std::vector(ties))});
  });
}

TEST(InteractingMultipleModel, AnyHimmEqualsTheRestatement) {
  holds([] {
    generated_filters<Fuzzy>({*rc::gen::elementOf(std::vector(lifts)),
                              {*rc::gen::elementOf(std::vector(readings)), *rc::gen::elementOf(std::vector(ties))},
                              *rc::gen::elementOf(std::vector(ties))});
  });
}

/// The plain Kalman filter of one model.
struct Alone {
  Planar model;
  State state;
  double log_likelihood = 0.0;

  void step(const Scan& scan) {
    predict(model, state, scan.dt, state);
    if (scan.z) log_likelihood += update(model, state, *scan.z, state).log_likelihood;
  }
};

/// `modes` copies of one model are the Kalman filter.
template <Uncertainty Kind>
void is_the_kalman_filter(const Interaction<Kind>& interaction, std::size_t modes) {
  std::vector<std::vector<double>> rows(
      modes, std::vector<double>(modes, std::is_same_v<Kind, Random> ? 0.3 / static_cast<double>(modes) : 0.3));
  for (std::size_t i = 0; i < modes; ++i) rows[i][i] += 0.7;
  Filter<Kind> filter{VectorBank(modes, turning()), transition_by<Kind>(rows), std::vector<State>(modes, starts()[2]),
                      interaction};
  Alone alone{turning(), starts()[2]};
  for (const Scan& scan : manoeuvring_target(40)) {
    step(filter, scan);
    alone.step(scan);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().mean, alone.state.mean, 1e-9);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().covariance, alone.state.covariance, 1e-9);
  }
}

TEST(InteractingMultipleModel, OneModelOrEqualModelsAreTheKalmanFilterUnderEveryReading) {
  for (const std::size_t modes : {1U, 3U})
    for (const Lift lift : lifts) {
      is_the_kalman_filter<Random>({lift, {MixingWeights::correct}, Tie::stay}, modes);
      is_the_kalman_filter<Random>({lift, {MixingWeights::released}, Tie::stay}, modes);
      for (const MixedCovariance reading : readings) is_the_kalman_filter<Fuzzy>({lift, {reading}, Tie::stay}, modes);
    }
}

template <Uncertainty Kind>
void never_mixes(const Interaction<Kind>& interaction) {
  Filter<Kind> filter{VectorBank{calm(), turning()}, transition_by<Kind>({{1.0, 0.0}, {0.0, 1.0}}),
                      std::vector<State>{starts()[0], starts()[2]}, interaction};
  std::vector<Alone> alone{{calm(), starts()[0]}, {turning(), starts()[2]}};
  for (const Scan& scan : manoeuvring_target(60)) {
    step(filter, scan);
    for (std::size_t j = 0; j < 2; ++j) {
      alone[j].step(scan);
      ASSERT_PRED_FORMAT3(near_matrix, filter.estimates()[j].mean, alone[j].state.mean, 1e-12);
      ASSERT_PRED_FORMAT3(near_matrix, filter.estimates()[j].covariance, alone[j].state.covariance, 1e-12);
    }
    ASSERT_PRED_FORMAT3(near, filter.belief().log(0) - filter.belief().log(1),
                        alone[0].log_likelihood - alone[1].log_likelihood, 1e-9);
  }
}

TEST(InteractingMultipleModel, ATransitionThatIsTheIdentityNeverMixes) {
  never_mixes<Random>({});
  for (const MixedCovariance reading :
       {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred})
    never_mixes<Fuzzy>({Lift::zero, {reading}, Tie::stay});
}

TEST(InteractingMultipleModel, AnAllOnesTransitionRestartsAllFromTheWinner) {
  Filter<Fuzzy> filter{VectorBank{calm(1.0), calm(5.0), calm(20.0)},
                       transition_by<Fuzzy>({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), starts()[0],
                       Interaction<Fuzzy>{Lift::zero, {MixedCovariance::selected}, Tie::stay}};
  std::size_t winners = 0;  // as bits
  for (const Scan& scan : manoeuvring_target()) {
    if (!scan.z) continue;
    const std::size_t winner = filter.most_likely_mode();
    const auto logs = filter.belief().logs();
    const bool alone = std::count_if(logs.begin(), logs.end(), [](double log) { return log > -1e-6; }) == 1;
    std::vector<State> expected;
    for (const Planar& model : filter.system().models()) {
      expected.emplace_back();
      predict(model, filter.estimates()[winner], scan.dt, expected.back());
    }
    Filter<Fuzzy> probe = filter;
    probe.step(scan.dt);
    if (alone) {  // With a tie, each of the tied ones stays with itself.
      winners |= std::size_t{1} << winner;
      for (std::size_t j = 0; j < 3; ++j) {
        ASSERT_EQ(probe.estimates()[j].mean, expected[j].mean);
        ASSERT_EQ(probe.estimates()[j].covariance, expected[j].covariance);
        ASSERT_EQ(probe.belief().log(j), 0.0);
      }
    }
    step(filter, scan);
  }
  EXPECT_GT(std::popcount(winners), 1) << "not always the same model should win";
}

TEST(InteractingMultipleModel, PossibilitiesHaveTheMaximumOneAndProbabilitiesTheSumOneAtEveryStep) {
  auto himm = vector_filter<Fuzzy>();
  auto imm = vector_filter<Random>();
  for (const Scan& scan : manoeuvring_target()) {
    step(himm, scan);
    step(imm, scan);
    const auto logs = himm.belief().logs();
    ASSERT_EQ(*std::max_element(logs.begin(), logs.end()), 0.0);
    ASSERT_EQ(logs[himm.most_likely_mode()], 0.0);
    double sum = 0.0;
    for (const double log : imm.belief().logs()) sum += std::exp(log);
    ASSERT_PRED_FORMAT3(near, sum, 1.0, 1e-14);
  }
}

TEST(InteractingMultipleModel, ScalingEveryLikelihoodChangesNoWeight) {
  holds([] {
    const double shift = number_between(-1e5, 1e5);
    const auto same = [shift](const auto& variable) {
      const Belief prior =
          compose(transition_by<typename std::decay_t<decltype(variable)>::kind>({{1.0}}),
                  Belief{uninformative(Variable<typename std::decay_t<decltype(variable)>::kind>{"motion", 1})});
      RC_ASSERT(prior.log(0) == 0.0);
      Likelihood likelihood{variable}, scaled{variable};
      for (std::size_t j = 0; j < variable.size(); ++j) {
        const double log = number_between(-50.0, 50.0);
        likelihood.set_log(j, log);
        scaled.set_log(j, log + shift);
      }
      const Belief before{uninformative(variable)};
      const auto plain = update(before, likelihood), shifted = update(before, scaled);
      require_near(shifted.logs(), plain.logs(), 1e-9);
    };
    same(random_motion);
    same(fuzzy_motion);
  });
}

template <Uncertainty Kind>
void relabelling(const Interaction<Kind>& interaction) {
  const VectorBank models{calm(1.0), calm(5.0), turning()};
  const std::vector<std::size_t> order{2, 0, 1};
  VectorBank relabelled;
  std::vector<State> start;
  std::vector<std::vector<double>> rows(3, std::vector<double>(3));
  for (std::size_t i = 0; i < 3; ++i) {
    relabelled.push_back(models[order[i]]);
    start.push_back(starts()[order[i]]);
    for (std::size_t j = 0; j < 3; ++j) rows[i][j] = transition_of<Kind>()(order[i], order[j]);
  }
  auto filter = vector_filter<Kind>(interaction);
  Filter<Kind> other{relabelled, transition_by<Kind>(rows), start, interaction};
  for (const Scan& scan : manoeuvring_target(110)) {
    step(filter, scan);
    step(other, scan);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_PRED_FORMAT3(near, other.belief().log(i), filter.belief().log(order[i]), 1e-9);
      ASSERT_PRED_FORMAT3(near_matrix, other.estimates()[i].mean, filter.estimates()[order[i]].mean, 1e-9);
    }
    if (!scan.z) continue;  // The weights before a measurement may tie, and ties go by the label.
    ASSERT_EQ(order[other.most_likely_mode()], filter.most_likely_mode());
    ASSERT_PRED_FORMAT3(near_matrix, other.estimate().mean, filter.estimate().mean, 1e-9);
    ASSERT_PRED_FORMAT3(near_matrix, other.estimate().covariance, filter.estimate().covariance, 1e-9);
  }
}

TEST(InteractingMultipleModel, RelabellingTheModelsChangesNothing) {
  for (const Lift lift : {Lift::borrowed_variance, Lift::unbiased}) {
    relabelling<Random>({lift, {}, Tie::stay});
    for (const MixedCovariance reading :
         {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred})
      relabelling<Fuzzy>({lift, {reading}, Tie::stay});
  }
}

/// A step of no duration shows the mixed starts: nothing moves, and DWNA adds no noise.
TEST(InteractingMultipleModel, MixingPreservesTheMixturesFirstTwoMoments) {
  holds([] {
    std::vector<State> start;
    for (int j = 0; j < 3; ++j) {
      const auto state = support::generated_gaussian<4>();
      start.push_back({state.mean, state.covariance});
    }
    Filter<Random> filter{VectorBank{calm(1.0), calm(2.0), calm(3.0)}, random_transition, start};
    for (int k = 0; k < 3; ++k) {
      const auto before = filter.estimate();
      filter.step(0.0);
      require_near_matrix(filter.estimate().mean, before.mean, 1e-11);
      require_near_matrix(filter.estimate().covariance, before.covariance, 1e-11);
    }
  });
}

TEST(InteractingMultipleModel, WhatHimmPutsOutIsExactlyOneFiltersEstimate) {
  for (const MixedCovariance reading : readings) {
    auto filter = vector_filter<Fuzzy>({Lift::zero, {reading}, Tie::stay});
    for (const Scan& scan : manoeuvring_target()) {
      step(filter, scan);
      const State& winner = filter.estimates()[filter.most_likely_mode()];
      const auto n = winner.size();
      const auto output = filter.estimate();
      ASSERT_EQ(output.mean.head(n), winner.mean);
      ASSERT_EQ(output.covariance.topLeftCorner(n, n), winner.covariance);
      ASSERT_EQ(output.mean, filter.most_likely_estimate().mean);
    }
  }
}

TEST(InteractingMultipleModel, TheMostLikelyEstimateOfAnImmIsOneFiltersToo) {
  auto filter = vector_filter<Random>();
  for (const Scan& scan : manoeuvring_target(100)) {
    step(filter, scan);
    const State& winner = filter.estimates()[filter.most_likely_mode()];
    const auto output = filter.most_likely_estimate();
    ASSERT_EQ(output.mean.head(winner.size()), winner.mean);
    ASSERT_EQ(output.covariance.topLeftCorner(winner.size(), winner.size()), winner.covariance);
  }
}

template <Uncertainty Kind>
void stays_positive(const Interaction<Kind>& interaction) {
  auto filter = vector_filter<Kind>(interaction);
  const auto positive = [](const auto& covariance) {
    const Eigen::Index n = covariance.rows();
    const Eigen::VectorXd scale = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd correlation(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        correlation(i, j) = scale(i) * covariance(i, j) * scale(j) + (i == j ? 1e-12 : 0.0);
    return covariance == covariance.transpose() && Eigen::LLT<Eigen::MatrixXd>(correlation).info() == Eigen::Success;
  };
  for (const Scan& scan : manoeuvring_target(110)) {
    step(filter, scan);
    for (const State& state : filter.estimates()) ASSERT_TRUE(positive(state.covariance)) << state.covariance;
    ASSERT_TRUE(positive(filter.estimate().covariance)) << filter.estimate().covariance;
  }
}

TEST(InteractingMultipleModel, CovariancesStaySymmetricAndPositive) {
  for (const Lift lift : lifts) {
    stays_positive<Random>({lift, {MixingWeights::correct}, Tie::stay});
    stays_positive<Random>({lift, {MixingWeights::released}, Tie::stay});
    for (const MixedCovariance reading : readings) stays_positive<Fuzzy>({lift, {reading}, Tie::stay});
  }
}

/// A measurement of a target at rest at the origin, that many standard deviations off.
Gaussian<2> measured(double deviations) {
  return {Vector<2>::Constant(10.0 * deviations), 100.0 * SquareMatrix<2>::Identity()};
}

template <Uncertainty Kind>
void survives_an_outlier() {
  const auto zero = [](const Planar& model) {
    return State{Eigen::VectorXd::Zero(model.size()), 100.0 * Eigen::MatrixXd::Identity(model.size(), model.size())};
  };
  const VectorBank models{calm(1.0), calm(5.0), turning(2.0)};
  Filter<Kind> filter{models, transition_of<Kind>(), {zero(models[0]), zero(models[1]), zero(models[2])}};
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 30; ++k) filter.step(1.0, measured(normal(generator)));
  auto spared = filter;

  filter.step(1.0, measured(1e6));
  const auto logs = filter.belief().logs();
  double total = 0.0;
  for (const double log : logs) {
    ASSERT_TRUE(std::isfinite(log));
    total = std::is_same_v<Kind, Random> ? total + std::exp(log) : std::max(total, std::exp(log));
  }
  EXPECT_PRED_FORMAT3(near, total, 1.0, 1e-14);
  // Of three models surprised beyond all measure, the one with the widest S is surprised least.
  const auto& innovations = filter.innovations();
  const auto widest = std::max_element(innovations.begin(), innovations.end(), [](const auto& a, const auto& b) {
    return a.covariance(0, 0) < b.covariance(0, 0);
  });
  EXPECT_EQ(filter.most_likely_mode(), static_cast<std::size_t>(widest - innovations.begin()));
  EXPECT_TRUE(all_finite(filter.estimate()));
  EXPECT_TRUE(std::isfinite(filter.nis()));

  spared.step(1.0);
  std::size_t steps = 0;
  double distance = 1e300;
  while (distance > 3.0 && steps < 200) {  // until the position is within 3 σ of a filter's that was spared it
    const auto z = measured(normal(generator));
    filter.step(1.0, z);
    spared.step(1.0, z);
    ++steps;
    const auto expected = spared.estimate();
    distance = 0.0;
    for (Eigen::Index axis = 0; axis < 2; ++axis)
      distance = std::max(distance, std::abs(filter.estimate().mean(axis) - expected.mean(axis)) /
                                        std::sqrt(expected.covariance(axis, axis)));
  }
  EXPECT_LE(steps, 40U);
}

TEST(InteractingMultipleModel, ImmSurvivesAnOutlierAMillionDeviationsAway) { survives_an_outlier<Random>(); }
TEST(InteractingMultipleModel, HimmSurvivesAnOutlierAMillionDeviationsAway) { survives_an_outlier<Fuzzy>(); }

template <Uncertainty Kind>
void survives_an_unreachable_mode(const Interaction<Kind>& interaction) {
  const auto transition = transition_by<Kind>({{1.0, 0.0}, {1.0, 0.0}});
  Filter<Kind> filter{VectorBank{calm(), turning()}, transition, std::vector<State>{starts()[0], starts()[2]},
                      interaction};
  auto expected = restated<Kind>({calm(), turning()}, transition, {starts()[0], starts()[2]}, interaction);
  Alone alone{turning(), starts()[2]};
  for (const Scan& scan : manoeuvring_target(40)) {
    step(filter, scan);
    step(expected, scan);
    alone.step(scan);
    ASSERT_TRUE(agrees(filter, expected));
    ASSERT_EQ(filter.belief().log(0), 0.0);
    ASSERT_EQ(filter.belief().log(1), log_zero);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimates()[1].mean, alone.state.mean, 1e-12);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimates()[1].covariance, alone.state.covariance, 1e-12);
  }
}

TEST(InteractingMultipleModel, AnUnreachableModeKeepsItsOwnStateWithTheWeightZero) {
  for (const Lift lift : lifts) {
    survives_an_unreachable_mode<Random>({lift, {}, Tie::stay});
    for (const MixedCovariance reading : readings) survives_an_unreachable_mode<Fuzzy>({lift, {reading}, Tie::stay});
  }
}

template <Uncertainty Kind>
void refusals() {
  auto filter = vector_filter<Kind>();
  const auto scans = manoeuvring_target(4);
  for (const Scan& scan : scans) step(filter, scan);
  const auto before = filter;
  const Gaussian<2> z = *scans[0].z;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    auto in_mean = z;
    in_mean.mean(1) = bad;
    EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(0.2, in_mean); }, {"measurement", "not finite"}));
    auto in_covariance = z;
    in_covariance.covariance(1, 0) = bad;
    EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(0.2, in_covariance); }, {"covariance", "not finite"}));
    EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(bad, z); }, {"step", "finite"}));
    EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(bad); }, {"step", "finite"}));
  }
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(-0.25, z); }, {"step", "-0.25", "not negative"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(-0.25); }, {"step", "-0.25", "not negative"}));
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(filter.estimates()[j].mean, before.estimates()[j].mean);
    EXPECT_EQ(filter.belief().log(j), before.belief().log(j));
  }
}

TEST(InteractingMultipleModel, RefusesWhatIsNotFiniteAndStepsBackAndIsThenUnchanged) {
  refusals<Random>();
  refusals<Fuzzy>();
}

TEST(InteractingMultipleModel, RefusesAStartThatDoesNotFit) {
  const VectorBank models{calm(), calm(), turning()};
  const auto build = [&](const std::vector<State>& start) { Filter<Fuzzy>{models, fuzzy_transition, start}; };
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build({starts()[0], starts()[1]}); }, {"3 models", "2 starts"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        build({starts()[0], starts()[1], starts()[0]});
      },
      {"start of model 'dwpa'", "4", "expected 6"}));
  auto bad = starts();
  bad[1].covariance(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build(bad); }, {"start of model 'dwna'", "not finite"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { Filter<Fuzzy>(models, fuzzy_transition, starts()[0]); },
                                            {"start has 4", "6"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        Filter<Fuzzy>(VectorBank{calm(), turning()}, fuzzy_transition, starts()[2]);
      },
      {"3 outcomes", "2 models"}));
}

TEST(InteractingMultipleModel, OneStartServesAllModels) {
  const State start = starts()[2];
  const InteractingMultipleModel filter{VectorBank{calm(), calm(), turning()}, fuzzy_transition, start};
  EXPECT_EQ(filter.components(), (std::vector<std::string>{"x", "y", "vx", "vy", "ax", "ay"}));
  EXPECT_EQ(filter.estimates()[0].mean, start.mean.head(4));
  EXPECT_EQ(filter.estimates()[0].covariance, start.covariance.topLeftCorner(4, 4));
  EXPECT_EQ(filter.estimates()[2].mean, start.mean);
  EXPECT_EQ(filter.estimates()[2].covariance, start.covariance);
  EXPECT_EQ(filter.modes(), 3U);
  EXPECT_EQ(filter.most_likely_mode(), 0U);
  EXPECT_FALSE(filter.measured());
}

TEST(InteractingMultipleModel, ThereIsNoNisWithoutAMeasurement) {
  auto filter = vector_filter<Random>();
  EXPECT_TRUE(throws<std::logic_error>([&] { filter.nis(); }, {"without a measurement"}));
  filter.step(0.2, *manoeuvring_target(1)[0].z);
  EXPECT_TRUE(filter.measured());
  EXPECT_TRUE(std::isfinite(filter.nis()));
  filter.step(0.2);
  EXPECT_FALSE(filter.measured());
  EXPECT_TRUE(throws<std::logic_error>([&] { filter.nis(); }, {"without a measurement"}));
}

}  // namespace
}  // namespace sigmax
