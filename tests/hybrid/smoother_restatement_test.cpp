// The smoother against its restatement: belief, estimates and output of every step.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <sigmax/estimation/fixed_step_motion.hpp>
#include <sigmax/hybrid/fixed_interval_smoother.hpp>

#include "hybrid/laws.hpp"
#include "hybrid/named_sensor.hpp"
#include "support/smoother_restatement.hpp"

namespace sigmax {
namespace {

using namespace support;

/// A state given in some components, by the names of others.
restatement::State reordered(const restatement::State& state, const std::vector<std::string>& from,
                             const std::vector<std::string>& to) {
  restatement::State result{restatement::Vector(to.size()), restatement::Matrix(to.size(), to.size())};
  for (std::size_t a = 0; a < to.size(); ++a) {
    const auto in_a = restatement::position(from, to[a]).value();
    result.mean[a] = state.mean[in_a];
    for (std::size_t b = 0; b < to.size(); ++b)
      result.covariance(a, b) = state.covariance(in_a, restatement::position(from, to[b]).value());
  }
  return result;
}

void require_near_state(const restatement::State& found, const restatement::State& expected) {
  const std::span<const double> mean(found.mean), covariance(found.covariance.values);
  ASSERT_PRED_FORMAT3(near, mean, std::span<const double>(expected.mean), 1e-9);
  ASSERT_PRED_FORMAT3(near, covariance, std::span<const double>(expected.covariance.values), 1e-9);
}

/// Takes the scans and smooths them, both ways.
template <class Filter, class Restated, class Sensor = PositionSensor<2>>
void smooths_as_restated(Filter filter, const Restated& restated, const std::vector<Scan>& scans,
                         const Sensor& sensor = {}) {
  restatement::Smoother<Restated> expected{restated};
  std::vector record{filter.recorded(0.0)};
  for (const Scan& scan : scans) {
    scan.z ? filter.step(scan.dt, *scan.z, sensor) : filter.step(scan.dt);
    step(expected, scan);
    record.push_back(recorded(filter, scan));
  }
  const auto smoothed = smooth(filter, record);
  const auto moments = expected.smoothed();
  ASSERT_EQ(smoothed.size(), moments.size());
  std::set<std::size_t> winners;
  for (std::size_t k = smoothed.size(); k-- > 0;) {
    SCOPED_TRACE("step " + std::to_string(k));
    const auto& found = smoothed[k];
    const auto& moment = moments[k];
    ASSERT_PRED_FORMAT3(near, found.belief.logs(), std::span<const double>(moment.log_weights), 1e-9);
    ASSERT_EQ(found.most_likely_mode, moment.winner);
    for_each_mode(found.estimates,
                  [&](auto j) { require_near_state(restate(mode(found.estimates, j)), moment.states[j]); });
    require_near_state(restate(filter.estimate(found)),
                       reordered(expected.estimate(moment), expected.components(), filter.components()));
    if (testing::Test::HasFailure()) return;
    winners.insert(moment.winner);
  }
  EXPECT_GT(winners.size(), 1U) << "one mode is the most likely all the time";
}

template <class Order, Uncertainty Kind>
void smooths(const VectorBank& models, const std::vector<State>& start, const Interaction<Kind>& interaction = {},
             const Relation<Kind, Kind>& transition = transition_of<Kind>()) {
  smooths_as_restated(support::Filter<Order, Kind>{models, transition, start, interaction},
                      restated<Order, Kind>(models, transition, start, interaction), manoeuvring_target(140));
}

/// Turns of less noise than these are worse conditioned: of σ_w = 0.5 the log weights would differ by some 3e-9.
template <class Order, Uncertainty Kind>
void smooths_each_bank() {
  const auto from = starts();
  for (const Lift lift : lifts) {
    SCOPED_TRACE(testing::Message() << "lift " << static_cast<int>(lift));
    smooths<Order, Kind>({calm(1.0), calm(5.0), turning()}, from, {lift});
  }
  smooths<Order, Kind>({calm(0.5), calm(5.0), calm(40.0)}, {from[0], from[1], from[1]});
  smooths<Order, Kind>({turning(3.0), turning(8.0), turning(25.0)}, {from[2], from[2], from[2]});
  // Nothing comes to the first mode: it may be the start, and then has no weight.
  constexpr double stay = std::is_same_v<Kind, Random> ? 0.75 : 1.0;
  smooths<Order, Kind>({calm(1.0), calm(5.0), turning()}, from, {},
                       transition_by<Kind>({{0.0, stay, 0.25}, {0.0, stay, 0.25}, {0.0, 0.25, stay}}));
}

TEST(SmootherRestatement, OfAnImm) { smooths_each_bank<Interacting, Random>(); }
TEST(SmootherRestatement, OfAHimm) { smooths_each_bank<Interacting, Fuzzy>(); }
TEST(SmootherRestatement, OfGpb2) { smooths_each_bank<SecondOrder, Random>(); }
TEST(SmootherRestatement, OfAViterbiFilter) { smooths_each_bank<SecondOrder, Fuzzy>(); }

using Model = FixedStepMotion<3>;
const NamedSensor<2> sees_both{{"x", "y"}};

restatement::Model restated(const Model& model) {
  return {model.components(), [model](double dt) { return dense(model.transition(dt)); },
          [model](double dt) { return dense(model.process_covariance(dt)); },
          restated_matrix(sees_both.names, model.components())};
}

/// Each model lacks a component of the other, and they are ordered differently.
template <class Order, Uncertainty Kind>
void smooths_what_is_not_nested() {
  const Model drifting{"drifting",
                       {"x", "y", "drift"},
                       1.0,
                       SquareMatrix<3>{{1, 0, 1}, {0.1, 0.9, 0.2}, {0, 0, 0.95}},
                       SquareMatrix<3>{{0.5, 0.1, 0}, {0.1, 0.4, 0.1}, {0, 0.1, 0.2}}};
  const Model swinging{"swinging",
                       {"swing", "y", "x"},
                       1.0,
                       SquareMatrix<3>{{0.9, 0, 0.1}, {0.8, 1, 0}, {-0.3, 0.1, 0.9}},
                       SquareMatrix<3>{{0.6, 0, 0}, {0, 0.5, 0.2}, {0, 0.2, 0.7}}};
  const Gaussian<3> of_drifting{Vector<3>{1, 2, 0.5}, SquareMatrix<3>{{4, 1, 0.5}, {1, 3, 1}, {0.5, 1, 2}}};
  const Gaussian<3> of_swinging{Vector<3>{0, 1, 2}, SquareMatrix<3>{{1, 0.2, 0.1}, {0.2, 5, 1}, {0.1, 1, 4}}};
  constexpr double stay = std::is_same_v<Kind, Random> ? 0.75 : 1.0;
  const auto transition = transition_by<Kind>({{stay, 0.25}, {0.25, stay}});
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  std::vector<Scan> scans;
  for (int k = 0; k < 100; ++k) {
    scans.push_back({1.0, std::nullopt});
    const Vector<2> z{8.0 * std::sin(0.1 * k) + normal(generator), 8.0 * std::sin(0.4 * k) + normal(generator)};
    if (k % 5 != 3) scans.back().z = Gaussian<2>{z, SquareMatrix<2>{{2.0, 0.5}, {0.5, 1.0}}};
  }
  for (const Lift lift : lifts) {
    SCOPED_TRACE(testing::Message() << "lift " << static_cast<int>(lift));
    const Interaction<Kind> interaction{lift};
    typename Order::template Filter<std::tuple<Model, Model>, Kind> filter{
        std::tuple{drifting, swinging}, transition, std::tuple{of_drifting, of_swinging}, interaction};
    typename Order::Restated expected{{restated(drifting), restated(swinging)},
                                      restate(transition),
                                      {restate(of_drifting), restate(of_swinging)},
                                      {1.0, 1.0},
                                      restate(interaction)};
    smooths_as_restated(filter, expected, scans, sees_both);
  }
}

TEST(SmootherRestatement, OfModelsThatAreNotNested) {
  smooths_what_is_not_nested<Interacting, Random>();
  smooths_what_is_not_nested<Interacting, Fuzzy>();
  smooths_what_is_not_nested<SecondOrder, Random>();
  smooths_what_is_not_nested<SecondOrder, Fuzzy>();
}

}  // namespace
}  // namespace sigmax
