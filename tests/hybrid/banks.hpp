#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "support/matrices.hpp"
#include "support/restatement.hpp"

namespace sigmax {

/// The banks of these tests: planar motion, as a vector of one run-time type and as a tuple.
using Planar = KinematicModel<2, Eigen::Dynamic>;
using VectorBank = std::vector<Planar>;
using TupleBank = std::tuple<KinematicModel<2, 2>, KinematicModel<2, 2>, KinematicModel<2, 3>>;

// Instantiated once, by interacting_multiple_model_test.cpp.
extern template class InteractingMultipleModel<VectorBank, Random>;
extern template class InteractingMultipleModel<VectorBank, Fuzzy>;
extern template class InteractingMultipleModel<TupleBank, Random>;
extern template class InteractingMultipleModel<TupleBank, Fuzzy>;

namespace support {

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

inline restatement::Model restate(const Planar& model) {
  return model.order() == 2 ? restatement::dwna(2, model.sigma_w()) : restatement::dwpa(2, model.sigma_w());
}

/// The enumerations are spelled alike and in one order.
template <Uncertainty Kind>
restatement::Options restate(const Interaction<Kind>& interaction) {
  restatement::Options options;
  options.lift = static_cast<restatement::Lift>(interaction.lift);
  options.output_tie = static_cast<restatement::Tie>(interaction.output_tie);
  if constexpr (std::is_same_v<Kind, Fuzzy>) {
    options.kind = restatement::Kind::himm;
    options.mixed_covariance = static_cast<restatement::MixedCovariance>(interaction.collapse.mixed_covariance);
    options.mixing_tie = static_cast<restatement::Tie>(interaction.collapse.mixing_tie);
  } else {
    options.kind = restatement::Kind::imm;
    options.mixing_weights = static_cast<restatement::Weights>(interaction.collapse.mixing_weights);
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
  if (result && filter.measured()) compare("the NIS", filter.nis(), *restated.nis());
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
inline void step(restatement::Filter& filter, const Scan& scan) {
  if (scan.z)
    filter.step(scan.dt, entries(scan.z->mean), dense(scan.z->covariance));
  else
    filter.step(scan.dt);
}

}  // namespace support
}  // namespace sigmax
