#include "support/sigmax.hpp"

namespace mixture_test {

using detail::Mixture;

Gaussian<1> scalar(double mean, double variance) { return {Vector<1>{mean}, SquareMatrix<1>{variance}}; }

/// Acts with the mixture of Gaussians of one size; the result.
template <int N, class Act>
Gaussian<N> of(const std::vector<Gaussian<N>>& gaussians, const Act& act) {
  std::vector<Mixture::Part> parts;
  for (const Gaussian<N>& each : gaussians) parts.push_back({detail::view(each)});
  Gaussian<N> result;
  act(Mixture{detail::view(gaussians[0]), parts}, detail::view(result));
  return result;
}
template <class Rule, int N>
Gaussian<N> collapsed(const Rule& rule, const std::vector<Gaussian<N>>& parts, const std::vector<double>& weights,
                      std::size_t winner = 0) {
  return of(parts, [&](const Mixture& mixture, detail::View result) {
    detail::collapse(rule, mixture, weights.data(), winner, result);
  });
}

PROPERTY(Collapse, MatchesTheFirstTwoMoments) {
  std::vector<Gaussian<2>> parts;
  std::vector<double> weights{0.1, 0.2, 0.3, 0.4};
  Vector<2> mean = Vector<2>::Zero();
  SquareMatrix<2> square = SquareMatrix<2>::Zero(), printed = square;
  for (const double weight : weights) {
    parts.push_back(generated_gaussian<2>());
    const auto& [m, P] = parts.back();
    mean += weight * m;
    square += weight * (P + m * m.transpose());
    printed += weight * P;
  }
  const auto found = collapsed(MomentMatching{}, parts, weights);
  require_near(found.mean, mean, 1e-12);
  require_near(found.covariance + found.mean * found.mean.transpose(), square, 1e-12);
  RC_ASSERT(found.covariance == found.covariance.transpose());
  const auto without = collapsed(MomentMatching{{}, OutputSpread::omitted}, parts, weights);
  require_near(without.mean, mean, 1e-12);
  require_near(without.covariance, printed, 1e-12);
}

TEST(Collapse, APartWithoutWeightDoesNotCountWhateverItIs) {
  const auto found =
      collapsed(MomentMatching{}, std::vector{scalar(not_a_number, not_a_number), scalar(2.0, 3.0)}, {0.0, 1.0}, 1);
  EXPECT_EQ(found.mean(0), 2.0);
  EXPECT_EQ(found.covariance(0, 0), 3.0);
}

TEST(Collapse, SelectionTakesTheWinnerAsItIs) {
  const std::vector parts{scalar(0.1, 1.7), scalar(4.3, 3.9)};
  const auto found = collapsed(Selection{}, parts, {0.5, 0.5}, 1);
  EXPECT_EQ(found.mean, parts[1].mean);
  EXPECT_EQ(found.covariance, parts[1].covariance);
}

// Three modes: the first at 1, the selected one at 5 with variance 2, the receiving one at 3 with variance 7.
Gaussian<1> mixed(MixedCovariance reading, Tie tie = Tie::stay, const std::vector<double>& move_in = {0.5, 1.0, 0.2}) {
  const std::vector three{scalar(1.0, 4.0), scalar(5.0, 2.0), scalar(3.0, 7.0)};
  return of(three, [&](const Mixture& mixture, detail::View result) {
    detail::mix(Selection{reading, tie}, mixture, move_in.data(), move_in.data(), 2, detail::view(three[2]), result);
  });
}

TEST(Mix, TheCovarianceIsWhatTheReadingSaysAndTheMeanTheSelectedOne) {
  struct Reading {
    MixedCovariance reading;
    double variance;
  };
  for (const auto& [reading, variance] : {Reading{MixedCovariance::selected, 2.0}, Reading{MixedCovariance::own, 7.0},
                                          Reading{MixedCovariance::own_recentred, 7.0 + (5.0 - 3.0) * (5.0 - 3.0)},
                                          Reading{MixedCovariance::released, 7.0 + (5.0 - 1.0) * (5.0 - 1.0)}}) {
    EXPECT_EQ(mixed(reading).mean(0), 5.0);
    EXPECT_EQ(mixed(reading).covariance(0, 0), variance);
  }
}

TEST(Mix, ATieIsBrokenInFavourOfTheReceivingMode) {
  const std::vector<double> tied{1.0, 0.3, 1.0};
  EXPECT_EQ(mixed(MixedCovariance::selected, Tie::stay, tied).mean(0), 3.0);
  EXPECT_EQ(mixed(MixedCovariance::selected, Tie::first, tied).mean(0), 1.0);
  EXPECT_EQ(mixed(MixedCovariance::selected, Tie::last, tied).mean(0), 3.0);
}

TEST(Mix, MomentsAreMatchedWithTheRightOrWithTransposedWeights) {
  const std::vector two{scalar(0.0, 1.0), scalar(4.0, 3.0)};
  const double weights[] = {0.75, 0.25}, transposed[] = {0.75, 0.5};
  const auto by = [&](MixingWeights rule) {
    return of(two, [&](const Mixture& mixture, detail::View result) {
      detail::mix(MomentMatching{rule}, mixture, weights, transposed, 0, detail::view(two[0]), result);
    });
  };
  EXPECT_EQ(by(MixingWeights::correct).mean(0), 1.0);
  EXPECT_EQ(by(MixingWeights::correct).covariance(0, 0), 0.75 * (1.0 + 1.0) + 0.25 * (3.0 + 9.0));
  EXPECT_EQ(by(MixingWeights::released).mean(0), 1.0);
  EXPECT_EQ(by(MixingWeights::released).covariance(0, 0), 0.75 * (1.0 + 1.0) + 0.5 * (3.0 + 9.0)) << "sum is 1.25";
}

TEST(Mixture, OfDifferentModelsIsReadInTheComponentsOfTheReceiver) {
  const Gaussian<2> narrow{Vector<2>(1, 2), SquareMatrix<2>{{1, 0.5}, {0.5, 2}}};
  const Gaussian<3> wide{Vector<3>(3, 4, 5), SquareMatrix<3>{{3, 0, 0}, {0, 4, 0}, {0, 0, 5}}};
  const std::vector<std::string> few{"x", "vx"}, many{"x", "vx", "ax"};
  const detail::Correspondence up{many, few};
  const Mixture::Part parts[] = {{detail::view(narrow), &up}, {detail::view(wide)}};
  const Mixture mixture{detail::view(wide), parts, StateAugmentation::zero};
  Gaussian<3> result;
  const double weights[] = {0.25, 0.75};
  detail::collapse(Selection{}, mixture, weights, 0, detail::view(result));
  EXPECT_EQ(result.mean, (Vector<3>(1, 2, 0)));
  EXPECT_EQ(result.covariance, (SquareMatrix<3>{{1, 0.5, 0}, {0.5, 2, 0}, {0, 0, 0}}));
  detail::collapse(MomentMatching{}, mixture, weights, 0, detail::view(result));
  EXPECT_CLOSE(result.mean, (Vector<3>(2.5, 3.5, 3.75)), 1e-15);
}

}  // namespace mixture_test
