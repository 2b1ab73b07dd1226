#include <unsupported/Eigen/MatrixFunctions>

#include "support/sigmax.hpp"

namespace mode_transition_test {

Rates generated_rates(std::size_t n) {
  Rates rates(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j) {
        rates[i][j] = *rc::gen::inRange(0, 4) == 0 ? 0.0 : number_between(0.001, 2.0);
        rates[i][i] -= rates[i][j];
      }
  return rates;
}

/// exp(QΔt) by Padé approximation.
Eigen::MatrixXd exponential(const Rates& rates, double dt) {
  const auto n = static_cast<Eigen::Index>(rates.size());
  Eigen::MatrixXd Q(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) Q(i, j) = dt * rates[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return Q.exp();
}

PROPERTY(TimedTransition, IsTheMatrixExponentialAndOfAFuzzyModeThatOnTheRatioScale) {
  const auto n = *rc::gen::inRange<std::size_t>(2, 7);
  const auto rates = generated_rates(n);
  const double dt = std::pow(10.0, number_between(-3.0, 2.0));
  const auto P = TimedTransition<Random>{{"mode", n}, rates}(dt);
  const auto pi = TimedTransition<Fuzzy>{{"mode", n}, rates}(dt);
  const auto expected = exponential(rates, dt);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto row = expected.row(static_cast<Eigen::Index>(i));
      require_near(P(i, j), row(static_cast<Eigen::Index>(j)), 1e-12);
      require_near(pi(i, j), row(static_cast<Eigen::Index>(j)) / row.maxCoeff(), 1e-11);
    }
}

TEST(TimedTransition, ForgetsTheModeInALongTime) {
  const Rates rates{{-0.3, 0.3}, {0.1, -0.1}};
  for (const double dt : {1e3, 1e300}) {
    const auto P = TimedTransition<Random>{{"mode", 2}, rates}(dt);
    EXPECT_CLOSE(P(0, 0), 0.25, 1e-12);
    EXPECT_CLOSE(P(1, 1), 0.75, 1e-12);
    const auto pi = TimedTransition<Fuzzy>{{"mode", 2}, rates}(dt);
    EXPECT_CLOSE(pi(0, 0), 1.0 / 3.0, 1e-12);
    EXPECT_EQ(pi(1, 1), 1.0);
  }
}

/// Only from i to i + 1: p(0 → k) is Poisson, however unlikely; its logarithm is compared, hence all its digits.
TEST(TimedTransition, KnowsHowUnlikelyALongChainOfJumpsIs) {
  constexpr std::size_t n = 25;
  Rates rates(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    rates[i][i] = -2.0;
    rates[i][i + 1] = 2.0;
  }
  for (const double dt : {1e-6, 0.01, 3.0}) {
    const auto P = TimedTransition<Random>{{"mode", n}, rates}(dt);
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const double count = static_cast<double>(k);
      EXPECT_CLOSE(std::log(P(0, k)), count * std::log(2.0 * dt) - 2.0 * dt - std::lgamma(count + 1.0), 1e-12);
    }
    for (std::size_t k = 1; k < n; ++k) EXPECT_EQ(P(k, k - 1), 0.0);
  }
}

/// Two fuzzy modes that leave at the rate λ: π(t) = tanh λt, and max of two hyperbolic tangents is not that of the sum.
TEST(TimedTransition, OfARandomModeComposesOverTimeAndOfAFuzzyModeDoesNot) {
  holds([] {
    const auto n = *rc::gen::inRange<std::size_t>(2, 6);
    const TimedTransition<Random> transition{{"mode", n}, generated_rates(n)};
    const double s = number_between(0.0, 3.0), t = number_between(0.0, 3.0);
    const auto in_two = compose(transition(t), transition(s)), in_one = transition(s + t);
    require_near(in_two.table().values(), in_one.table().values(), 1e-12);
  });
  const TimedTransition<Fuzzy> transition{{"mode", 2}, {{-0.4, 0.4}, {0.4, -0.4}}};
  EXPECT_CLOSE(compose(transition(2.0), transition(1.0))(0, 1), std::tanh(0.8), 1e-15);
  EXPECT_CLOSE(transition(3.0)(0, 1), std::tanh(1.2), 1e-15);
}

TEST(TimedTransition, OverNoTimeIsTheIdentity) {
  const auto check = [](const auto& relation) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(relation(i, j), i == j ? 1.0 : 0.0);
  };
  const Rates rates = rates_of_sojourns({20.0, 5.0, 1e-3});
  check(TimedTransition<Random>{{"mode", 3}, rates}(0.0));
  check(TimedTransition<Fuzzy>{{"mode", 3}, rates}(0.0));
  check(TimedTransition<Random>{{"mode", 3}, rates_of_sojourns({infinity, infinity, infinity})}(7.0));
}

TEST(TimedTransition, WritesIntoARelationHoweverItIsStored) {
  const RandomVariable mode{"mode", {"steady", "manoeuvring"}};
  const TimedTransition transition{mode, rates_of_sojourns({20.0, 5.0})};
  Relation<Random, Random> result{mode, mode, SparseRows{{{0, 1.0}}, {{1, 1.0}}}};
  transition(0.5, result);
  const auto expected = transition(0.5);
  EXPECT_CLOSE(result.table().values(), expected.table().values(), 0.0);
}

TEST(TimedTransition, RefusesWhatAreNoRatesAndNoTime) {
  const RandomVariable mode{"mode", {"steady", "manoeuvring"}};
  const auto make = [&](const Rates& rates) { return TimedTransition<Random>{mode, rates}; };
  const auto good = make({{-1.0, 1.0}, {2.0, -2.0}});
  using Bad = std::invalid_argument;
  EXPECT_REFUSED(Bad, ("mode"), make({{-1.0, 1.0}}));
  EXPECT_REFUSED(Bad, ("mode"), make({{-1.0}, {2.0}}));
  EXPECT_REFUSED(Bad, ("mode", "steady", "manoeuvring", "-1.0"), make({{1.0, -1.0}, {2.0, -2.0}}));
  EXPECT_REFUSED(Bad, ("mode", "manoeuvring", "-1.0"), make({{-1.0, 1.0}, {2.0, -1.0}}));
  EXPECT_REFUSED(Bad, ("mode", "manoeuvring", "nan"), make({{-1.0, NAN}, {2.0, -2.0}}));
  EXPECT_REFUSED(Bad, ("-0.5"), good(-0.5));
  EXPECT_REFUSED(Bad, ("nan"), good(NAN));
  Relation<Random, Random> other{{"weather", 2}, {"weather", 2}, {{1.0, 0.0}, {0.0, 1.0}}};
  EXPECT_REFUSED(Bad, ("mode", "weather"), good(1.0, other));
}

TEST(RatesOfSojourns, LeaveForEveryOtherModeAlike) {
  EXPECT_EQ(rates_of_sojourns({4.0, 2.0, 0.5}), (Rates{{-0.25, 0.125, 0.125}, {0.25, -0.5, 0.25}, {1.0, 1.0, -2.0}}));
  EXPECT_INVALID(("two modes"), rates_of_sojourns({4.0}));
  EXPECT_INVALID(("mode 1", "0.0"), rates_of_sojourns({4.0, 0.0}));
}

Relation<Fuzzy, Fuzzy> generated_possibilities(std::size_t n) {
  std::vector<std::vector<double>> rows(n, std::vector<double>(n, 1.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j) rows[i][j] = number_between(0.0, 1.0);
  return {FuzzyVariable{"mode", n}, FuzzyVariable{"mode", n}, rows};
}

/// The best of all ways from one mode to another in at most `jumps` jumps.
double best_way(const Relation<Fuzzy, Fuzzy>& transition, std::size_t from, std::size_t to, std::size_t jumps) {
  double best = from == to ? 1.0 : 0.0;
  if (jumps == 0) return best;
  for (std::size_t k = 0; k < transition.to().size(); ++k)
    best = std::max(best, transition(from, k) * best_way(transition, k, to, jumps - 1));
  return best;
}

PROPERTY(Closure, IsTheBestChainOfJumpsAndStaysUnderComposition) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 6);
  const auto once = generated_possibilities(n);
  const auto all = closure(once);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) require_near(all(i, j), best_way(once, i, j, n), 1e-15);
  const auto again = compose(all, all);
  require_near(again.table().values(), all.table().values(), 1e-15);
}

TEST(Closure, NeedsThatStayingIsPossibleAndOfTwoModesIsThenTheTransitionItself) {
  const FuzzyVariable mode{"mode", {"steady", "manoeuvring"}};
  const Relation<Fuzzy, Fuzzy> transition{mode, mode, {{1.0, 0.5}, {0.2, 1.0}}};
  EXPECT_CLOSE(closure(transition).table().values(), transition.table().values(), 0.0);
  const Relation<Fuzzy, Fuzzy> restless{mode, mode, {{0.5, 1.0}, {0.2, 1.0}}};
  EXPECT_INVALID(("mode", "steady", "0.5"), closure(restless));
}

}  // namespace mode_transition_test
