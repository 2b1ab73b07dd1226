#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <numbers>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include "support/enveloped.hpp"
#include "support/matrices.hpp"
#include "support/restatement.hpp"
#include "support/second_order_restatement.hpp"

namespace sigmax {

/// The banks of these tests: planar motion, as a vector of one run-time type and as a tuple.
using PlanarMotion = AnyMotion<6, IndependentAxes<2, DiscreteWhiteNoise<2>>, IndependentAxes<2, DiscreteWhiteNoise<3>>>;
using Planar = AnyMember<PlanarMotion>;
using VectorBank = std::vector<Planar>;
using TupleBank = std::tuple<IndependentAxes<2, DiscreteWhiteNoise<2>>, IndependentAxes<2, DiscreteWhiteNoise<2>>,
                             IndependentAxes<2, DiscreteWhiteNoise<3>>>;

// Instantiated once, by interacting_multiple_model_test.cpp.
extern template class InteractingMultipleModel<VectorBank, Random>;
extern template class InteractingMultipleModel<VectorBank, Fuzzy>;
extern template class InteractingMultipleModel<TupleBank, Random>;
extern template class InteractingMultipleModel<TupleBank, Fuzzy>;

// Instantiated once, by second_order_multiple_model_test.cpp.
extern template class SecondOrderMultipleModel<VectorBank, Random>;
extern template class SecondOrderMultipleModel<VectorBank, Fuzzy>;
extern template class SecondOrderMultipleModel<TupleBank, Random>;
extern template class SecondOrderMultipleModel<TupleBank, Fuzzy>;

namespace support {

/// The two filters, each with what restates it.
struct Interacting {
  template <class Models, class Kind>
  using Filter = InteractingMultipleModel<Models, Kind>;
  using Restated = restatement::Filter;
};
struct SecondOrder {
  template <class Models, class Kind>
  using Filter = SecondOrderMultipleModel<Models, Kind>;
  using Restated = restatement::SecondOrderFilter;
};

/// One scan: seconds since the last, and what was measured, if anything.
struct Scan {
  double dt;
  std::optional<Gaussian<2>> z;
};

/// A radar at the origin sees a target that flies straight, turns hard and flies straight again. Steps are irregular,
/// and every eleventh scan and three in a row are missed.
inline std::vector<Scan> manoeuvring_target(std::size_t scans = 220) {
  constexpr double sigma_r = 10.0, sigma_a = 0.1 * std::numbers::pi / 180.0;
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  std::vector<Scan> result;
  double x = 12000.0, y = 8000.0, vx = -100.0, vy = -100.0;
  for (std::size_t k = 0; k < scans; ++k) {
    const double dt = std::initializer_list<double>{0.2, 0.2, 0.35, 0.1, 0.0, 0.6}.begin()[k % 6];
    const bool turns = k >= 80 && k < 130;
    const double ax = (turns ? -30.0 : 0.0) + 3.0 * normal(generator);
    const double ay = (turns ? -50.0 : 0.0) + 3.0 * normal(generator);
    x += vx * dt + 0.5 * ax * dt * dt;
    y += vy * dt + 0.5 * ay * dt * dt;
    vx += ax * dt;
    vy += ay * dt;
    const double range = std::hypot(x, y) + sigma_r * normal(generator);
    const double azimuth = std::atan2(y, x) + sigma_a * normal(generator);
    const auto seen = restatement::standard_conversion(range, azimuth, 0.0, sigma_r, sigma_a, 0.0);
    Scan scan{dt, std::nullopt};
    if (k % 11 != 5 && !(k >= 60 && k < 63))
      scan.z = Gaussian<2>{Vector<2>{seen.z[0], seen.z[1]},
                           SquareMatrix<2>{{seen.R(0, 0), seen.R(0, 1)}, {seen.R(1, 0), seen.R(1, 1)}}};
    result.push_back(scan);
  }
  return result;
}

using State = Gaussian<Eigen::Dynamic, 6>;

inline const RandomVariable random_motion{"motion", {"calm", "rough", "turn"}};
inline const FuzzyVariable fuzzy_motion{"motion", {"calm", "rough", "turn"}};
inline const Relation random_transition{
    random_motion, random_motion, {{0.90, 0.07, 0.03}, {0.10, 0.80, 0.10}, {0.02, 0.08, 0.90}}};
inline const Relation fuzzy_transition{fuzzy_motion, fuzzy_motion, {{1.0, 0.5, 0.2}, {0.5, 1.0, 0.5}, {0.1, 0.5, 1.0}}};

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

inline Planar calm(double sigma_w = 1.0) { return Extended<PlanarMotion>{dwna<2>(sigma_w)}; }
inline Planar turning(double sigma_w = 4.0) { return Extended<PlanarMotion>{dwpa<2>(sigma_w)}; }

/// Every start is wrong in its own way.
inline std::vector<State> starts() {
  SquareMatrix<4> small = 50.0 * SquareMatrix<4>::Identity();
  small.topRightCorner<2, 2>().setConstant(5.0);
  small.bottomLeftCorner<2, 2>().setConstant(5.0);
  SquareMatrix<6> large = 80.0 * SquareMatrix<6>::Identity();
  large.topRightCorner<2, 2>().setConstant(3.0);
  large.bottomLeftCorner<2, 2>().setConstant(3.0);
  return {State{Vector<4>{12005, 7990, -95, -103}, small}, State{Vector<4>{11996, 8004, -99, -108}, 2.0 * small},
          State{Vector<6>{12001, 8003, -101, -95, 3, -4}, large}};
}

inline constexpr auto lifts = {Lift::zero, Lift::borrowed_variance, Lift::unbiased};
inline constexpr auto readings = {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred,
                                  MixedCovariance::released};
inline constexpr auto ties = {Tie::stay, Tie::first, Tie::last};

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

inline restatement::Model restate(const Planar& model) {
  const double sigma_w = model.motion().visit([](const auto& motion) { return motion.law().sigma_w(); });
  return model.size() == 4 ? restatement::dwna(2, sigma_w) : restatement::dwpa(2, sigma_w);
}

/// The enumerations are spelled alike and in one order.
template <Uncertainty Kind>
restatement::Options restate(const Interaction<Kind>& interaction) {
  restatement::Options options;
  options.lift = static_cast<restatement::Lift>(interaction.lift);
  options.output_tie = static_cast<restatement::Tie>(interaction.output_tie);
  options.common_start = interaction.mixed_start == MixedStart::common;
  options.possibilistic = interaction.likelihood == LikelihoodForm::possibility;
  if constexpr (std::is_same_v<Kind, Fuzzy>) {
    options.kind = restatement::Kind::himm;
    options.mixed_covariance = static_cast<restatement::MixedCovariance>(interaction.collapse.mixed_covariance);
    options.mixing_tie = static_cast<restatement::Tie>(interaction.collapse.mixing_tie);
    options.envelope = enveloped;
  } else {
    options.kind = restatement::Kind::imm;
    options.mixing_weights = static_cast<restatement::Weights>(interaction.collapse.mixing_weights);
    options.output_spread_omitted = interaction.collapse.output_spread == OutputSpread::omitted;
  }
  return options;
}

template <int N, int MaxN>
restatement::State restate(const Gaussian<N, MaxN>& estimate) {
  return {entries(estimate.mean), dense(estimate.covariance)};
}

template <class Transition>
restatement::Matrix restate(const Transition& transition) {
  restatement::Matrix result(transition.from().size(), transition.to().size());
  for (std::size_t i = 0; i < result.rows; ++i)
    for (std::size_t j = 0; j < result.columns; ++j) result(i, j) = transition(i, j);
  return result;
}

/// Whether all that the filter shows is near all that its restatement shows; `tolerance` is relative from one on.
template <class Filter>
testing::AssertionResult agrees(const Filter& filter, const restatement::Filter& restated, double tolerance = 1e-9) {
  testing::AssertionResult result = testing::AssertionSuccess();
  const auto compare = [&](const char* what, const auto& found, const auto& expected) {
    if (result) result = near(what, "the restatement's", "", found, expected, tolerance);
  };
  const auto compare_states = [&](const char* what, const restatement::State& found,
                                  const restatement::State& expected) {
    compare(what, std::span<const double>(found.mean), std::span<const double>(expected.mean));
    compare(what, std::span<const double>(found.covariance.values),
            std::span<const double>(expected.covariance.values));
  };
  compare("the log weights", filter.belief().logs(), std::span<const double>(restated.log_weights()));
  if (result && filter.most_likely_mode() != restated.winner())
    result = testing::AssertionFailure() << "mode " << filter.most_likely_mode() << " wins, but mode "
                                         << restated.winner() << " in the restatement";
  for_each_mode(filter.estimates(), [&](auto j) {
    compare_states("a model's estimate", restate(mode(filter.estimates(), j)), restated.states()[j]);
  });
  if (result && filter.measured() != restated.nis().has_value())
    result = testing::AssertionFailure() << "whether there was a measurement is in dispute";
  if (result && filter.measured()) {
    compare("the NIS", filter.nis(), *restated.nis());
    compare("the squared norm of the normalized innovation", filter.normalized_innovation().squaredNorm(),
            *restated.nis());
    compare("the distance that gates compare", filter.gate_distance(), restated.gate_distance());
    compare("the evidence", filter.log_evidence(), restated.log_evidence());
    compare("the score", filter.log_score(), restated.log_score());
  }
  if (!result) return result;

  // The union of the components may be ordered differently.
  const restatement::State found = restate(filter.estimate());
  restatement::State expected = found;
  const auto there = restated.estimate();
  const auto at = [&](std::size_t i) { return restatement::position(restated.components(), filter.components()[i]); };
  if (filter.components().size() != restated.components().size())
    return testing::AssertionFailure() << "the output has other components";
  for (std::size_t i = 0; i < filter.components().size(); ++i) {
    if (!at(i)) return testing::AssertionFailure() << "no component " << filter.components()[i];
    expected.mean[i] = there.mean[*at(i)];
    for (std::size_t k = 0; k < filter.components().size(); ++k)
      expected.covariance(i, k) = there.covariance(*at(i), at(k).value());
  }
  compare_states("the output", found, expected);
  return result;
}

/// Takes one scan with any filter of these banks.
template <class Filter>
void step(Filter& filter, const Scan& scan) {
  if (scan.z)
    filter.step(scan.dt, *scan.z);
  else
    filter.step(scan.dt);
}
template <std::derived_from<restatement::Filter> Restated>
void step(Restated& filter, const Scan& scan) {
  if (scan.z)
    filter.step(scan.dt, entries(scan.z->mean), dense(scan.z->covariance));
  else
    filter.step(scan.dt);
}

/// What the scan left in the filter that took it.
template <class Filter, class Sensor = PositionSensor<2>>
auto recorded(const Filter& filter, const Scan& scan, const Sensor& sensor = {}) {
  return scan.z ? filter.recorded(scan.dt, *scan.z, sensor) : filter.recorded(scan.dt);
}

}  // namespace support
}  // namespace sigmax
