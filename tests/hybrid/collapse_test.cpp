#include <sigmax/hybrid/collapse.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>
#include <vector>

#include <sigmax/core/logarithm.hpp>

#include "support/matrices.hpp"

namespace sigmax {
namespace {

using support::entries;
using support::generated_gaussian;
using support::holds;
using support::number_between;
using support::require_near;

static_assert(std::is_same_v<Collapse<Random>, MomentMatching>);
static_assert(std::is_same_v<Collapse<Fuzzy>, Selection>);

/// A mixture of Gaussians of one size.
template <int N>
struct Mixture {
  struct Part {
    const Gaussian<N>& gaussian;
    const Vector<N>& mean() const { return gaussian.mean; }
    void add_covariance(double weight, SquareMatrix<N>& covariance) const {
      covariance += weight * gaussian.covariance;
    }
  };
  std::vector<Gaussian<N>> parts;

  template <class Visit>
  void visit_all(const Visit& visit) const {
    for (std::size_t l = 0; l < parts.size(); ++l) visit(l, Part{parts[l]});
  }
  template <class Visit>
  void visit(std::size_t l, const Visit& visit) const {
    visit(Part{parts[l]});
  }
};

Gaussian<1> scalar(double mean, double variance) { return {Vector<1>{mean}, SquareMatrix<1>{variance}}; }

std::size_t selected(const std::vector<double>& logs, std::size_t current, Tie tie) {
  return detail::select(
      logs.size(), [&](std::size_t i) { return logs[i]; }, current, tie);
}

TEST(Select, TheGreatestWeightWinsUnderEveryRule) {
  for (const Tie tie : {Tie::stay, Tie::first, Tie::last})
    for (const std::size_t current : {0U, 1U, 2U}) {
      EXPECT_EQ(selected({-1.0, 0.0, -2.0}, current, tie), 1U);
      EXPECT_EQ(selected({log_zero, -3.0, -1e300}, current, tie), 1U);
    }
}

TEST(Select, ATieIsBrokenAsTheRuleSays) {
  const std::vector<double> logs{-1.0, 0.0, 0.0, -5.0, 0.0};
  EXPECT_EQ(selected(logs, 2, Tie::first), 1U);
  EXPECT_EQ(selected(logs, 2, Tie::last), 4U);
  EXPECT_EQ(selected(logs, 2, Tie::stay), 2U);
  EXPECT_EQ(selected(logs, 3, Tie::stay), 1U) << "who is not among the winners cannot stay";
}

TEST(Select, WeightsWithinTheToleranceOfTheGreatestAreEqual) {
  EXPECT_EQ(selected({-0.9e-9, 0.0}, 0, Tie::stay), 0U);
  EXPECT_EQ(selected({-0.9e-9, 0.0}, 1, Tie::first), 0U);
  EXPECT_EQ(selected({0.0, -0.9e-9}, 0, Tie::last), 1U);
  EXPECT_EQ(selected({-1.1e-9, 0.0}, 0, Tie::stay), 1U);
  EXPECT_EQ(selected({-1.1e-9, 0.0}, 0, Tie::first), 1U);
  // Equality is with the greatest, not from neighbour to neighbour.
  EXPECT_EQ(selected({-1.6e-9, -0.8e-9, 0.0}, 0, Tie::stay), 1U);
}

TEST(Collapse, MatchesTheFirstTwoMomentsByHand) {
  const Mixture<1> mixture{{scalar(0.0, 1.0), scalar(4.0, 3.0)}};
  Gaussian<1> result;
  const std::vector<double> weights{0.75, 0.25};
  collapse(
      MomentMatching{}, mixture, [&](std::size_t l) { return weights[l]; }, 0, result);
  EXPECT_EQ(result.mean(0), 1.0);
  EXPECT_EQ(result.covariance(0, 0), 0.75 * (1.0 + 1.0) + 0.25 * (3.0 + 9.0));
}

TEST(Collapse, MatchesTheFirstTwoMoments) {
  holds([] {
    Mixture<2> mixture;
    std::vector<double> weights;
    double sum = 0.0;
    for (int l = 0; l < 4; ++l) {
      mixture.parts.push_back(generated_gaussian<2>());
      weights.push_back(number_between(0.01, 1.0));
      sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
    Gaussian<2> result;
    collapse(
        MomentMatching{}, mixture, [&](std::size_t l) { return weights[l]; }, 0, result);

    // E x and E xxᵀ, element by element.
    for (Eigen::Index i = 0; i < 2; ++i) {
      double mean = 0.0;
      for (std::size_t l = 0; l < 4; ++l) mean += weights[l] * mixture.parts[l].mean(i);
      require_near(result.mean(i), mean, 1e-12);
      for (Eigen::Index j = 0; j < 2; ++j) {
        double square = 0.0;
        for (std::size_t l = 0; l < 4; ++l)
          square +=
              weights[l] * (mixture.parts[l].covariance(i, j) + mixture.parts[l].mean(i) * mixture.parts[l].mean(j));
        require_near(result.covariance(i, j) + result.mean(i) * result.mean(j), square, 1e-12);
      }
    }
    RC_ASSERT(result.covariance == result.covariance.transpose());
  });
}

TEST(Collapse, APartWithoutWeightDoesNotCountWhateverItIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Mixture<1> mixture{{scalar(nan, nan), scalar(2.0, 3.0)}};
  Gaussian<1> result;
  collapse(
      MomentMatching{}, mixture, [](std::size_t l) { return l == 1 ? 1.0 : 0.0; }, 1, result);
  EXPECT_EQ(result.mean(0), 2.0);
  EXPECT_EQ(result.covariance(0, 0), 3.0);
}

TEST(Collapse, SelectionTakesTheWinnerAsItIs) {
  const Mixture<1> mixture{{scalar(0.1, 1.7), scalar(4.3, 3.9)}};
  Gaussian<1> result;
  collapse(
      Selection{}, mixture, [](std::size_t) { return 0.5; }, 1, result);
  EXPECT_EQ(result.mean, mixture.parts[1].mean);
  EXPECT_EQ(result.covariance, mixture.parts[1].covariance);
}

// Three modes: the first at 1, the selected one at 5 with variance 2, the receiving one at 3 with variance 7.
const Mixture<1> three{{scalar(1.0, 4.0), scalar(5.0, 2.0), scalar(3.0, 7.0)}};

Gaussian<1> mixed(MixedCovariance reading, Tie tie = Tie::stay, const std::vector<double>& move_in = {0.5, 1.0, 0.2}) {
  Gaussian<1> result;
  const auto weight = [&](std::size_t l) { return move_in[l]; };
  mix(Selection{reading, tie}, three, weight, weight, 3, 2, three.parts[2], result);
  return result;
}

TEST(Mix, TheMeanIsTheSelectedOneUnderEveryReading) {
  for (const auto reading :
       {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred, MixedCovariance::released})
    EXPECT_EQ(mixed(reading).mean(0), 5.0);
}

TEST(Mix, TheCovarianceIsWhatTheReadingSays) {
  EXPECT_EQ(mixed(MixedCovariance::selected).covariance(0, 0), 2.0);
  EXPECT_EQ(mixed(MixedCovariance::own).covariance(0, 0), 7.0);
  EXPECT_EQ(mixed(MixedCovariance::own_recentred).covariance(0, 0), 7.0 + (5.0 - 3.0) * (5.0 - 3.0));
  EXPECT_EQ(mixed(MixedCovariance::released).covariance(0, 0), 7.0 + (5.0 - 1.0) * (5.0 - 1.0));
}

TEST(Mix, ATieIsBrokenInFavourOfTheReceivingMode) {
  const std::vector<double> tied{1.0, 0.3, 1.0};
  EXPECT_EQ(mixed(MixedCovariance::selected, Tie::stay, tied).mean(0), 3.0);
  EXPECT_EQ(mixed(MixedCovariance::selected, Tie::first, tied).mean(0), 1.0);
  EXPECT_EQ(mixed(MixedCovariance::selected, Tie::last, tied).mean(0), 3.0);
}

TEST(Mix, MomentsAreMatchedWithTheRightOrWithTransposedWeights) {
  // Rows: now in mode j; columns: before in mode l.
  const double given[2][2] = {{0.75, 0.25}, {0.5, 0.5}};
  const auto weight = [&](std::size_t l) { return given[0][l]; };
  const auto transposed = [&](std::size_t l) { return given[l][0]; };
  const Mixture<1> two{{scalar(0.0, 1.0), scalar(4.0, 3.0)}};
  Gaussian<1> result;
  mix(MomentMatching{MixingWeights::correct}, two, weight, transposed, 2, 0, two.parts[0], result);
  EXPECT_EQ(result.mean(0), 1.0);
  EXPECT_EQ(result.covariance(0, 0), 0.75 * (1.0 + 1.0) + 0.25 * (3.0 + 9.0));
  mix(MomentMatching{MixingWeights::released}, two, weight, transposed, 2, 0, two.parts[0], result);
  EXPECT_EQ(result.mean(0), 1.0);
  EXPECT_EQ(result.covariance(0, 0), 0.75 * (1.0 + 1.0) + 0.5 * (3.0 + 9.0)) << "they sum to 1.25";
}

}  // namespace
}  // namespace sigmax
