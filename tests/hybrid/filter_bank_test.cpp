#include <sigmax/hybrid/filter_bank.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>

#include "hybrid/instruction_sets.hpp"
#include "support/matrices.hpp"
#include "support/near.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::near;
using support::near_matrix;
using support::throws;
using support::under_each_instruction_set;

template <Uncertainty Kind>
Relation<Kind, Kind> transition() {
  const Variable<Kind> mode{"mode", 3};
  if constexpr (std::same_as<Kind, Random>)
    return {mode, mode, {{0.9, 0.05, 0.05}, {0.1, 0.8, 0.1}, {0.05, 0.05, 0.9}}};
  else
    return {mode, mode, {{1.0, 0.5, 0.2}, {0.5, 1.0, 0.5}, {0.2, 0.5, 1.0}}};
}

using Models = std::tuple<IndependentAxes<2, DiscreteWhiteNoise<2>>, IndependentAxes<2, DiscreteWhiteNoise<3>>,
                          IndependentAxes<2, OrnsteinUhlenbeck<2>>>;
Models models() { return {dwna<2>(3.0), dwpa<2>(1.0), ou_velocity<2>(0.1, 20.0)}; }

Gaussian<6> start(double t) {
  Gaussian<6> result{Vector<6>::Zero(), 100.0 * SquareMatrix<6>::Identity()};
  result.mean << 1e3 * t, -500.0 * t, 30.0, -20.0, 0.0, 0.0;
  return result;
}

Vector<2> true_position(std::size_t t, std::size_t k) {
  const double time = 0.5 * static_cast<double>(k);
  const double turn = k > 20 ? 2.0 * (time - 10.0) * (time - 10.0) : 0.0;
  return {1e3 * static_cast<double>(t) + 30.0 * time, -500.0 * static_cast<double>(t) - 20.0 * time + turn};
}

/// Of track `t` at step `k`; some are missing, and some lie far off or are more exact than the others.
std::optional<Gaussian<2>> measured(std::size_t t, std::size_t k) {
  if ((3 * t + k) % 7 == 0) return std::nullopt;
  const double phase = static_cast<double>(17 * t + 5 * k);
  const double error = (t + 11 * k) % 31 == 0 ? 300.0 : 10.0, sigma = (5 * t + k) % 23 == 0 ? 1.0 : 10.0;
  SquareMatrix<2> R = sigma * sigma * SquareMatrix<2>::Identity();
  R(0, 1) = R(1, 0) = 0.3 * sigma * sigma;
  return Gaussian<2>{true_position(t, k) + error * Vector<2>(std::sin(phase), std::cos(3.0 * phase)), R};
}

template <Uncertainty Kind>
using Bank = FilterBank<Models, Kind>;
template <Uncertainty Kind>
using Single = InteractingMultipleModel<Models, Kind>;

template <Uncertainty Kind>
void expect_as_single(const Bank<Kind>& bank, std::size_t track, const Single<Kind>& single) {
  const auto state = bank.state(track);
  EXPECT_EQ(state.most_likely_mode, single.most_likely_mode());
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_PRED_FORMAT3(near_matrix, state.estimates[j].mean, single.estimates()[j].mean, 1e-9);
    const SquareMatrix<Eigen::Dynamic, 6> P = single.estimates()[j].covariance, found = state.estimates[j].covariance;
    const auto units =
        P.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();  // those of each covariance: an outlier's is great
    EXPECT_PRED_FORMAT3(near_matrix, (units * found * units).eval(), (units * P * units).eval(), 1e-9);
    EXPECT_PRED_FORMAT3(near, state.belief[j], single.belief()[j], 1e-9);
  }
  EXPECT_PRED_FORMAT3(near_matrix, bank.estimate(track).mean, single.estimate().mean, 1e-9);
}

template <Uncertainty Kind>
void is_as_many_single_filters() {
  constexpr std::size_t tracks = 11, steps = 60;
  Bank<Kind> bank{models(), transition<Kind>()};
  std::vector<Single<Kind>> singles;
  for (std::size_t t = 0; t < tracks; ++t) {
    EXPECT_EQ(bank.add(start(static_cast<double>(t))), t);
    singles.emplace_back(models(), transition<Kind>(), start(static_cast<double>(t)));
  }
  EXPECT_EQ(bank.size(), tracks);
  auto scan = bank.scan();
  for (std::size_t k = 0; k < steps; ++k) {
    scan.clear();
    for (std::size_t t = 0; t < tracks; ++t) {
      const auto z = measured(t, k);
      if (z && bank.lives(t)) scan.set(t, *z);
      z ? singles[t].step(0.5, *z) : singles[t].step(0.5);
    }
    bank.step(0.5, scan);
    if (k == 30) bank.remove(4);
    if (k == 40) {
      EXPECT_EQ(bank.add(start(7.0)), 4U) << "the place is taken again";
      singles[4].restart(start(7.0));
    }
    for (std::size_t t = 0; t < tracks; ++t)
      if (bank.lives(t)) expect_as_single<Kind>(bank, t, singles[t]);
    if (testing::Test::HasFailure()) FAIL() << "step " << k;
  }
}

TEST(FilterBank, IsAsManySingleFiltersOfARandomMode) {
  under_each_instruction_set([] { is_as_many_single_filters<Random>(); });
}
TEST(FilterBank, IsAsManySingleFiltersOfAFuzzyMode) {
  under_each_instruction_set([] { is_as_many_single_filters<Fuzzy>(); });
}

TEST(FilterBank, StepsInOneCallAndThreadsChangeNothing) {
  Bank<Fuzzy> one{models(), transition<Fuzzy>()}, two = one, single_steps = one;
  for (std::size_t t = 0; t < 40; ++t) {
    const auto at = start(static_cast<double>(t));
    one.add(at);
    two.add(at);
    single_steps.add(at);
  }
  std::vector<Bank<Fuzzy>::Scan> scans(20, one.scan());
  for (std::size_t k = 0; k < scans.size(); ++k)
    for (std::size_t t = 0; t < 40; ++t)
      if (const auto z = measured(t, k)) scans[k].set(t, *z);
  one.run(0.5, scans);
  two.run(0.5, scans, 2);
  for (const auto& scan : scans) single_steps.step(0.5, scan);
  for (std::size_t t = 0; t < 40; ++t) {
    EXPECT_EQ(one.estimate(t).mean, two.estimate(t).mean);
    EXPECT_EQ(one.estimate(t).mean, single_steps.estimate(t).mean);
    EXPECT_EQ(one.estimate(t).covariance, two.estimate(t).covariance);
  }
}

/// The greatest deviation of a bank of single precision, in σ of the other, and the RMSE in position of both.
struct Precision {
  double deviation = 0.0, of_float = 0.0, of_double = 0.0;
};
template <Uncertainty Kind>
Precision precision(std::size_t steps) {
  constexpr std::size_t tracks = 40;
  FilterBank<Models, Kind, float> single{models(), transition<Kind>()};
  Bank<Kind> exact{models(), transition<Kind>()};
  for (std::size_t t = 0; t < tracks; ++t) {
    single.add(start(static_cast<double>(t)));
    exact.add(start(static_cast<double>(t)));
  }
  Precision result;
  for (std::size_t k = 0; k < steps; ++k) {
    auto few_bits = single.scan();
    auto scan = exact.scan();
    for (std::size_t t = 0; t < tracks; ++t)
      if (const auto z = measured(t, k)) {
        few_bits.set(t, *z);
        scan.set(t, *z);
      }
    single.step(0.5, few_bits);
    exact.step(0.5, scan);
    for (std::size_t t = 0; t < tracks; ++t) {
      const auto a = single.estimate(t), b = exact.estimate(t);
      const Vector<6> sigma = b.covariance.diagonal().cwiseSqrt();
      result.deviation = std::max(result.deviation, (a.mean - b.mean).cwiseQuotient(sigma).cwiseAbs().maxCoeff());
      const Vector<2> truth = true_position(t, k);
      result.of_float += (a.mean.template head<2>() - truth).squaredNorm();
      result.of_double += (b.mean.template head<2>() - truth).squaredNorm();
    }
  }
  result.of_float = std::sqrt(result.of_float / static_cast<double>(tracks * steps));
  result.of_double = std::sqrt(result.of_double / static_cast<double>(tracks * steps));
  return result;
}

TEST(FilterBank, OfSinglePrecisionIsTheSameToItsPrecision) {
  under_each_instruction_set([] {
    const Precision of = precision<Random>(80);
    EXPECT_LT(of.deviation, 0.1) << "σ, where an outlier is 300 σ off";
    EXPECT_NEAR(of.of_float, of.of_double, 1e-3 * of.of_double);
  });
}
TEST(FilterBank, OfSinglePrecisionIsAsGoodWhereModesAreDecided) {
  under_each_instruction_set([] {
    const Precision of = precision<Fuzzy>(80);
    EXPECT_NEAR(of.of_float, of.of_double, 0.01 * of.of_double);
  });
}

TEST(FilterBank, WhatSinglePrecisionCannotHoldIsRefused) {
  FilterBank<Models, Random, float> bank{models(), transition<Random>()};
  Gaussian<6> far = start(0.0);
  far.mean(0) = 1e39;
  EXPECT_TRUE(throws<std::domain_error>([&] { bank.add(far); }, {"track 0", "too far or too uncertain"}));
  EXPECT_EQ(bank.size(), 0U);
  EXPECT_EQ(bank.add(start(0.0)), 0U);
  Gaussian<2> z = *measured(0, 1);
  z.mean(1) = -1e39;
  auto scan = bank.scan();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { scan.set(0, z); }, {"track 0", "too great"}));
}

TEST(FilterBank, WrongTracksAndScansAreNamed) {
  FilterBank bank{models(), transition<Random>()};
  static_assert(std::same_as<decltype(bank), Bank<Random>>);
  bank.add(start(0.0));
  auto scan = bank.scan();
  const Gaussian<2> z = *measured(1, 1);
  EXPECT_TRUE(throws<std::invalid_argument>([&] { scan.set(999, z); }, {"no number 999"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { bank.remove(1); }, {"no track 1"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { bank.estimate(77); }, {"no track 77"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { bank.step(-1.0, scan); }, {"-1", "not negative"}));
  for (int t = 0; t < 64; ++t) bank.add(start(1.0));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { bank.step(1.0, scan); }, {"has room for", "new one"}));
  scan = bank.scan();
  Gaussian<2> impossible = z;
  impossible.covariance = -1e9 * SquareMatrix<2>::Identity();
  scan.set(5, impossible);
  EXPECT_TRUE(throws<std::domain_error>([&] { bank.step(1.0, scan); }, {"track 5", "not positive definite"}));
  EXPECT_TRUE(throws<std::domain_error>([&] { bank.run(1.0, std::span(&scan, 1), 2); }, {"track 5"}));
}

}  // namespace
}  // namespace sigmax
