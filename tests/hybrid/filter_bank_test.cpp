#include "hybrid/instruction_sets.hpp"

namespace filter_bank_test {

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

Gaussian<6> start(std::size_t track) {
  const auto t = static_cast<double>(track);
  return {Vector<6>(1e3 * t, -500.0 * t, 30.0, -20.0, 0.0, 0.0), 100.0 * SquareMatrix<6>::Identity()};
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

template <Uncertainty Kind, class Number = double>
using Bank = FilterBank<Models, Kind, Number>;
template <Uncertainty Kind>
using Single = InteractingMultipleModel<Models, Kind>;

template <Uncertainty Kind, class Number = double>
Bank<Kind, Number> bank_of(std::size_t tracks, const Interaction<Kind>& interaction = {}) {
  Bank<Kind, Number> bank{models(), transition<Kind>(), interaction};
  for (std::size_t t = 0; t < tracks; ++t) EXPECT_EQ(bank.add(start(t)), t);
  EXPECT_EQ(bank.size(), tracks);
  return bank;
}
/// What all tracks measure at step k.
template <class AnyBank>
auto scan_of(const AnyBank& bank, std::size_t k) {
  auto scan = bank.scan();
  for (std::size_t t = 0; t < bank.capacity(); ++t)
    if (const auto z = measured(t, k); z && bank.lives(t)) scan.set(t, *z);
  return scan;
}

template <Uncertainty Kind>
void expect_as_single(const Bank<Kind>& bank, std::size_t track, const Single<Kind>& single) {
  const auto state = bank.state(track);
  EXPECT_EQ(state.most_likely_mode, single.most_likely_mode());
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_CLOSE(state.estimates[j].mean, single.estimates()[j].mean, 1e-9);
    const SquareMatrix<Eigen::Dynamic, 6> P = single.estimates()[j].covariance, found = state.estimates[j].covariance;
    const auto units =
        P.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();  // those of each covariance: an outlier's is great
    EXPECT_CLOSE((units * found * units).eval(), (units * P * units).eval(), 1e-9);
    EXPECT_CLOSE(state.belief[j], single.belief()[j], 1e-9);
  }
  EXPECT_CLOSE(bank.estimate(track).mean, single.estimate().mean, 1e-9);
}

template <Uncertainty Kind>
void is_as_many_single_filters(const Interaction<Kind>& interaction = {}) {
  constexpr std::size_t tracks = 11;
  auto bank = bank_of<Kind>(tracks, interaction);
  std::vector<Single<Kind>> singles;
  for (std::size_t t = 0; t < tracks; ++t) singles.emplace_back(models(), transition<Kind>(), start(t), interaction);
  for (std::size_t k = 0; k < 60; ++k) {
    bank.step(0.5, scan_of(bank, k));
    for (std::size_t t = 0; t < tracks; ++t) {
      const auto z = measured(t, k);
      z ? singles[t].step(0.5, *z) : singles[t].step(0.5);
    }
    if (k == 30) bank.remove(4);
    if (k == 40) {
      EXPECT_EQ(bank.add(start(7)), 4U) << "the place is taken again";
      singles[4].restart(start(7));
    }
    for (std::size_t t = 0; t < tracks; ++t)
      if (bank.lives(t)) expect_as_single<Kind>(bank, t, singles[t]);
    if (testing::Test::HasFailure()) FAIL() << "step " << k;
  }
}

TEST(FilterBank, IsAsManySingleFilters) {
  under_each_instruction_set([] {
    is_as_many_single_filters<Random>();
    is_as_many_single_filters<Fuzzy>();
  });
}

TEST(FilterBank, TakesTheGeneralStepWhereThereIsNoShortOne) {
  Interaction<Random> released;
  released.collapse.mixing_weights = MixingWeights::released;
  is_as_many_single_filters<Random>(released);
  Interaction<Fuzzy> common;
  common.mixed_start = MixedStart::common;
  is_as_many_single_filters<Fuzzy>(common);
}

TEST(FilterBank, StepsInOneCallAndThreadsChangeNothing) {
  auto one = bank_of<Fuzzy>(40), two = one, single_steps = one;
  std::vector<Bank<Fuzzy>::Scan> scans;
  for (std::size_t k = 0; k < 20; ++k) scans.push_back(scan_of(one, k));
  one.run(0.5, scans);
  two.run(0.5, scans, 2);
  for (const auto& scan : scans) single_steps.step(0.5, scan);
  for (std::size_t t = 0; t < 40; ++t) {
    EXPECT_EQ(one.estimate(t).mean, two.estimate(t).mean);
    EXPECT_EQ(one.estimate(t).mean, single_steps.estimate(t).mean);
    EXPECT_EQ(one.estimate(t).covariance, two.estimate(t).covariance);
  }
}

TEST(FilterBank, AScanCanBeTakenBack) {
  auto missing = bank_of<Random>(3), taken_back = missing;
  auto scan = scan_of(taken_back, 1);
  scan.miss(0);
  scan.miss(1);
  scan.miss(2);
  taken_back.step(0.5, scan);
  missing.step(0.5, missing.scan());
  EXPECT_EQ(taken_back.estimate(1).mean, missing.estimate(1).mean);
  scan = scan_of(missing, 2);
  scan.clear();
  taken_back.step(0.5, scan);
  missing.step(0.5, missing.scan());
  EXPECT_EQ(taken_back.estimate(2).covariance, missing.estimate(2).covariance);
}

/// The greatest deviation of a bank of single precision, in σ of the other, and its RMSE in position beside the
/// other's.
template <Uncertainty Kind>
std::pair<double, double> of_floats() {
  auto single = bank_of<Kind, float>(40);
  auto exact = bank_of<Kind>(40);
  double deviation = 0.0, of_float = 0.0, of_double = 0.0;
  for (std::size_t k = 0; k < 80; ++k) {
    single.step(0.5, scan_of(single, k));
    exact.step(0.5, scan_of(exact, k));
    for (std::size_t t = 0; t < 40; ++t) {
      const auto a = single.estimate(t), b = exact.estimate(t);
      const Vector<6> sigma = b.covariance.diagonal().cwiseSqrt();
      deviation = std::max(deviation, (a.mean - b.mean).cwiseQuotient(sigma).cwiseAbs().maxCoeff());
      of_float += (a.mean.template head<2>() - true_position(t, k)).squaredNorm();
      of_double += (b.mean.template head<2>() - true_position(t, k)).squaredNorm();
    }
  }
  return {deviation, std::sqrt(of_float / of_double)};
}

TEST(FilterBank, OfSinglePrecisionIsTheSameToItsPrecisionAndAsGoodWhereModesAreDecided) {
  under_each_instruction_set([] {
    const auto [deviation, ratio] = of_floats<Random>();
    EXPECT_LT(deviation, 0.1) << "σ, where an outlier is 300 σ off";
    EXPECT_NEAR(ratio, 1.0, 1e-3);
    EXPECT_NEAR(of_floats<Fuzzy>().second, 1.0, 0.01);
  });
}

TEST(FilterBank, WhatSinglePrecisionCannotHoldIsRefused) {
  Bank<Random, float> bank{models(), transition<Random>()};
  Gaussian<6> far = start(0);
  far.mean(0) = 1e39;
  EXPECT_REFUSED(std::domain_error, ("track 0", "too far or too uncertain"), bank.add(far));
  EXPECT_EQ(bank.size(), 0U);
  EXPECT_EQ(bank.add(start(0)), 0U);
  Gaussian<2> z = *measured(0, 1);
  z.mean(1) = -1e39;
  auto scan = bank.scan();
  EXPECT_INVALID(("track 0", "too great"), scan.set(0, z));
}

TEST(FilterBank, WrongTracksAndScansAreNamed) {
  FilterBank bank{models(), transition<Random>()};
  static_assert(std::same_as<decltype(bank), Bank<Random>>);
  bank.add(start(0));
  auto scan = bank.scan();
  const Gaussian<2> z = *measured(1, 1);
  EXPECT_INVALID(("no number 999"), scan.set(999, z));
  EXPECT_INVALID(("no track 1"), bank.remove(1));
  EXPECT_INVALID(("no track 77"), bank.estimate(77));
  EXPECT_INVALID(("-1", "not negative"), bank.step(-1.0, scan));
  for (int t = 0; t < 64; ++t) bank.add(start(1));
  EXPECT_INVALID(("has room for", "new one"), bank.step(1.0, scan));
  scan = bank.scan();
  Gaussian<2> impossible = z;
  impossible.covariance = -1e9 * SquareMatrix<2>::Identity();
  scan.set(5, impossible);
  EXPECT_REFUSED(std::domain_error, ("track 5", "not positive definite"), bank.step(1.0, scan));
  EXPECT_REFUSED(std::domain_error, ("track 5"), bank.run(1.0, std::span(&scan, 1), 2));
}

}  // namespace filter_bank_test
