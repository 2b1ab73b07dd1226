#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <numeric>

#include "hybrid/banks.hpp"
#include "support/throws.hpp"

/// What is asked of every multiple-model filter: `Order` is support::Interacting or support::SecondOrder.
namespace sigmax::support {

template <class Order, class Kind>
using Filter = typename Order::template Filter<VectorBank, Kind>;

template <class Order, Uncertainty Kind>
Filter<Order, Kind> vector_filter(const Interaction<Kind>& interaction = {}) {
  return {VectorBank{calm(1.0), calm(5.0), turning()}, transition_of<Kind>(), starts(), interaction};
}
template <class Order, Uncertainty Kind>
typename Order::template Filter<TupleBank, Kind> tuple_filter(const Interaction<Kind>& interaction = {}) {
  const auto all = starts();
  return {TupleBank{dwna<2>(1.0), dwna<2>(5.0), dwpa<2>(4.0)}, transition_of<Kind>(),
          std::tuple{Gaussian<4>{all[0].mean, all[0].covariance}, Gaussian<4>{all[1].mean, all[1].covariance},
                     Gaussian<6>{all[2].mean, all[2].covariance}},
          interaction};
}

template <class Order, Uncertainty Kind>
typename Order::Restated restated(const VectorBank& models, const Relation<Kind, Kind>& transition,
                                  const std::vector<State>& start, const Interaction<Kind>& interaction) {
  std::vector<restatement::Model> all;
  for (const Planar& model : models) all.push_back(restate(model));
  std::vector<restatement::State> states;
  for (const State& state : start) states.push_back(restate(state));
  return {all, restate(transition), states, restatement::Vector(models.size(), 1.0), restate(interaction)};
}

/// Both banks against the restatement over the whole flight.
template <class Order, Uncertainty Kind>
void equals_the_restatement(const Interaction<Kind>& interaction, std::size_t length = 220) {
  auto vector = vector_filter<Order, Kind>(interaction);
  auto tuple = tuple_filter<Order, Kind>(interaction);
  auto expected =
      restated<Order, Kind>({calm(1.0), calm(5.0), turning()}, transition_of<Kind>(), starts(), interaction);
  const auto scans = manoeuvring_target(length);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    step(vector, scans[k]);
    step(tuple, scans[k]);
    step(expected, scans[k]);
    ASSERT_TRUE(agrees(vector, expected)) << "vector, scan " << k;
    ASSERT_TRUE(agrees(tuple, expected)) << "tuple, scan " << k;
  }
}

/// One to four generated models with a generated transition, whose equal entries make ties, over a few scans.
template <class Order, Uncertainty Kind>
void generated_filters(const Interaction<Kind>& interaction) {
  const auto scans = manoeuvring_target(6);
  const auto modes = *rc::gen::inRange<std::size_t>(1, 5);
  VectorBank models;
  std::vector<State> start;
  std::vector<std::vector<double>> rows(modes, std::vector<double>(modes));
  for (std::size_t i = 0; i < modes; ++i) {
    const double sigma_w = *rc::gen::element(0.5, 3.0);
    models.push_back(*rc::gen::arbitrary<bool>() ? calm(sigma_w) : turning(sigma_w));
    const State from = starts()[models.back().size() == 4 ? 0 : 2];
    start.push_back({from.mean.array() + number_between(-20.0, 20.0), number_between(0.1, 9.0) * from.covariance});
    for (double& value : rows[i]) value = *rc::gen::element(0.0, 0.25, 0.5, 1.0);
    rows[i][i] = 1.0;
    if constexpr (std::is_same_v<Kind, Random>) {
      const double sum = std::accumulate(rows[i].begin(), rows[i].end(), 0.0);
      for (double& value : rows[i]) value /= sum;
    }
  }
  const auto transition = transition_by<Kind>(rows);
  Filter<Order, Kind> filter{models, transition, start, interaction};
  auto expected = restated<Order, Kind>(models, transition, start, interaction);
  for (const Scan& scan : scans) {
    step(filter, scan);
    step(expected, scan);
    if (const auto result = agrees(filter, expected); !result) RC_FAIL(std::string(result.message()));
  }
}

/// `modes` copies of one model are the Kalman filter.
template <class Order, Uncertainty Kind>
void is_the_kalman_filter(const Interaction<Kind>& interaction, std::size_t modes) {
  std::vector<std::vector<double>> rows(
      modes, std::vector<double>(modes, std::is_same_v<Kind, Random> ? 0.3 / static_cast<double>(modes) : 0.3));
  for (std::size_t i = 0; i < modes; ++i) rows[i][i] += 0.7;
  Filter<Order, Kind> filter{VectorBank(modes, turning()), transition_by<Kind>(rows),
                             std::vector<State>(modes, starts()[2]), interaction};
  Alone alone{turning(), starts()[2]};
  for (const Scan& scan : manoeuvring_target(40)) {
    step(filter, scan);
    alone.step(scan);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().mean, alone.state.mean, 1e-9);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().covariance, alone.state.covariance, 1e-9);
  }
}

template <class Order, Uncertainty Kind>
void never_mixes(const Interaction<Kind>& interaction) {
  Filter<Order, Kind> filter{VectorBank{calm(), turning()}, transition_by<Kind>({{1.0, 0.0}, {0.0, 1.0}}),
                             std::vector<State>{starts()[0], starts()[2]}, interaction};
  std::vector<Alone> alone{{calm(), starts()[0]}, {turning(), starts()[2]}};
  for (const Scan& scan : manoeuvring_target(60)) {
    step(filter, scan);
    for (std::size_t j = 0; j < 2; ++j) {
      alone[j].step(scan);
      ASSERT_PRED_FORMAT3(near_matrix, filter.estimates()[j].mean, alone[j].state.mean, 1e-9);
      ASSERT_PRED_FORMAT3(near_matrix, filter.estimates()[j].covariance, alone[j].state.covariance, 1e-9);
    }
    ASSERT_PRED_FORMAT3(near, filter.belief().log(0) - filter.belief().log(1),
                        alone[0].log_likelihood - alone[1].log_likelihood, 1e-9);
  }
}

/// Possibilities have the maximum one and probabilities the sum one, at every step.
template <class Order>
void stays_normalized() {
  auto fuzzy = vector_filter<Order, Fuzzy>();
  auto random = vector_filter<Order, Random>();
  for (const Scan& scan : manoeuvring_target()) {
    step(fuzzy, scan);
    step(random, scan);
    const auto logs = fuzzy.belief().logs();
    ASSERT_EQ(*std::max_element(logs.begin(), logs.end()), 0.0);
    ASSERT_EQ(logs[fuzzy.most_likely_mode()], 0.0);
    double sum = 0.0;
    for (const double log : random.belief().logs()) sum += std::exp(log);
    ASSERT_PRED_FORMAT3(near, sum, 1.0, 1e-14);
  }
}

template <class Order, Uncertainty Kind>
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
  auto filter = vector_filter<Order, Kind>(interaction);
  Filter<Order, Kind> other{relabelled, transition_by<Kind>(rows), start, interaction};
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

template <class Order, Uncertainty Kind>
void stays_positive(const Interaction<Kind>& interaction) {
  auto filter = vector_filter<Order, Kind>(interaction);
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

/// A measurement of a target at rest at the origin, that many standard deviations off.
inline Gaussian<2> measured(double deviations) {
  return {Vector<2>::Constant(10.0 * deviations), 100.0 * SquareMatrix<2>::Identity()};
}

template <class Order, Uncertainty Kind>
void survives_an_outlier() {
  const auto zero = [](const Planar& model) {
    return State{Eigen::VectorXd::Zero(model.size()), 100.0 * Eigen::MatrixXd::Identity(model.size(), model.size())};
  };
  const VectorBank models{calm(1.0), calm(5.0), turning(2.0)};
  Filter<Order, Kind> filter{models, transition_of<Kind>(), {zero(models[0]), zero(models[1]), zero(models[2])}};
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
  EXPECT_TRUE(detail::all_finite(filter.estimate()));
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

template <class Order, Uncertainty Kind>
void survives_an_unreachable_mode(const Interaction<Kind>& interaction) {
  const auto transition = transition_by<Kind>({{1.0, 0.0}, {1.0, 0.0}});
  Filter<Order, Kind> filter{VectorBank{calm(), turning()}, transition, std::vector<State>{starts()[0], starts()[2]},
                             interaction};
  auto expected = restated<Order, Kind>({calm(), turning()}, transition, {starts()[0], starts()[2]}, interaction);
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

template <class Order, Uncertainty Kind>
void refusals() {
  auto filter = vector_filter<Order, Kind>();
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

template <class Order, Uncertainty Kind>
void require_same(const Filter<Order, Kind>& a, const Filter<Order, Kind>& b) {
  ASSERT_EQ(a.most_likely_mode(), b.most_likely_mode());
  for (std::size_t j = 0; j < a.modes(); ++j) {
    ASSERT_EQ(a.estimates()[j].mean, b.estimates()[j].mean);
    ASSERT_EQ(a.estimates()[j].covariance, b.estimates()[j].covariance);
    ASSERT_EQ(a.belief().log(j), b.belief().log(j));
  }
}

template <class Order, Uncertainty Kind>
void misses_what_is_outside_the_gate() {
  auto gated = vector_filter<Order, Kind>();
  auto taking = gated, missing = gated;
  std::size_t taken = 0, missed = 0;
  for (const Scan& scan : manoeuvring_target()) {
    if (!scan.z) continue;
    taking = missing = gated;
    taking.step(scan.dt, *scan.z);
    missing.step(scan.dt);
    const double gate = 1.0;
    gated.step(scan.dt, *scan.z, gate);
    ASSERT_EQ(gated.gate_distance(), taking.gate_distance());
    ASSERT_EQ(gated.measured(), taking.gate_distance() <= gate);
    require_same<Order, Kind>(gated, gated.measured() ? taking : missing);
    ++(gated.measured() ? taken : missed);
    gated = taking;
  }
  EXPECT_GT(taken, 20U);
  EXPECT_GT(missed, 20U);
}

template <class Order, Uncertainty Kind>
void names_the_failed_step() {
  auto filter = vector_filter<Order, Kind>();
  const auto scans = manoeuvring_target(4);
  for (const Scan& scan : scans) step(filter, scan);
  const auto before = filter;
  auto z = *scans[0].z;
  z.covariance = -1e6 * SquareMatrix<2>::Identity();
  EXPECT_TRUE(
      throws<std::domain_error>([&] { filter.step(0.25, z); }, {"step 5", "0.25", "model 'dwna'", "not positive"}));
  require_same<Order, Kind>(filter, before);
  z.mean(0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(0.25, z); }, {"step 5", "0.25", "not finite"}));
  auto lost = before.state();
  for (State& estimate : lost.estimates) estimate.covariance *= -1.0;
  filter.restore(lost);
  EXPECT_TRUE(throws<std::domain_error>([&] { filter.step(0.0, *scans[0].z); }, {"step 5", "model", "not positive"}));
}

template <class Order, Uncertainty Kind>
void goes_on_from_a_restored_state() {
  auto filter = vector_filter<Order, Kind>();
  auto other = filter;
  const auto scans = manoeuvring_target(60);
  for (std::size_t k = 0; k < 30; ++k) step(filter, scans[k]);
  other.restore(filter.state());
  EXPECT_FALSE(other.measured());
  for (std::size_t k = 30; k < 60; ++k) {
    step(filter, scans[k]);
    step(other, scans[k]);
    require_same<Order, Kind>(filter, other);
  }
  filter.restart(starts()[2]);
  other = Filter<Order, Kind>{filter.system().models(), transition_of<Kind>(), starts()[2]};
  require_same<Order, Kind>(filter, other);
  auto misfit = filter.state();
  misfit.estimates[0] = misfit.estimates[2];
  EXPECT_TRUE(throws<std::invalid_argument>([&] { other.restore(misfit); }, {"model 'dwna'", "6", "expected 4"}));
}

/// A function that gives one transition for short steps and another for long ones, and counts how often it is asked.
template <Uncertainty Kind>
struct ByStep {
  using kind = Kind;
  Relation<Kind, Kind> brief, lengthy;
  std::shared_ptr<int> asked = std::make_shared<int>(0);

  Relation<Kind, Kind> operator()(double dt) const {
    ++*asked;
    return dt < 0.3 ? brief : lengthy;
  }
};

template <class Order, Uncertainty Kind>
void takes_a_function_of_the_step() {
  const Relation<Kind, Kind> lengthy = compose(transition_of<Kind>(), transition_of<Kind>());
  const VectorBank models{calm(1.0), calm(5.0), turning()};
  const ByStep<Kind> by_step{transition_of<Kind>(), lengthy};
  Filter<Order, Kind> filter{models, by_step, starts()};
  auto brief = vector_filter<Order, Kind>();
  Filter<Order, Kind> expected{models, lengthy, starts()};
  const int asked = *by_step.asked;
  double last = 0.0;
  int changes = 0;
  for (const Scan& scan : manoeuvring_target(60)) {
    auto& one = scan.dt < 0.3 ? brief : expected;
    one.restore(filter.state());
    step(one, scan);
    step(filter, scan);
    require_same<Order, Kind>(filter, one);
    changes += scan.dt != last ? 1 : 0;
    last = scan.dt;
  }
  EXPECT_EQ(*by_step.asked - asked, changes);
}

}  // namespace sigmax::support
