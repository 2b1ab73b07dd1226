// The snippet that says what using the filter should feel like compiles, for both kinds, and tracks.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include <sigmax/sigmax.hpp>

namespace sigmax {
namespace {

struct Scan {
  double dt;
  Gaussian<3> z;
};
using Measurements = std::vector<Scan>;

constexpr double sigma_w = 3.0;
const Gaussian<9> start{Vector<9>::Zero(), 100.0 * SquareMatrix<9>::Identity()};

template <Uncertainty Kind>  // the transition's kind is the only difference between IMM and HIMM
auto track(const Relation<Kind, Kind>& transition, const Measurements& measurements) {
  InteractingMultipleModel filter{std::tuple{dwna<3>(sigma_w), dwpa<3>(sigma_w)}, transition, start};
  for (const auto& [dt, z] : measurements) filter.step(dt, z);  // z carries its R; step(dt) is a missed measurement
  return filter.estimate();
}

/// A target that accelerates by 4 m/s² along x, measured without an error.
Measurements accelerating() {
  Measurements measurements;
  for (int k = 1; k <= 50; ++k)
    measurements.push_back({1.0, {Vector<3>{2.0 * k * k, 0.0, 0.0}, SquareMatrix<3>::Identity()}});
  return measurements;
}

TEST(Snippet, OneFunctionIsImmOrHimmByTheKindOfItsTransition) {
  const RandomVariable random_motion{"motion", {"straight", "manoeuvring"}};
  const FuzzyVariable fuzzy_motion{"motion", {"straight", "manoeuvring"}};
  const auto imm = track(Relation{random_motion, random_motion, {{0.95, 0.05}, {0.05, 0.95}}}, accelerating());
  const auto himm = track(Relation{fuzzy_motion, fuzzy_motion, {{1.0, 0.5}, {0.5, 1.0}}}, accelerating());
  for (const auto& estimate : {imm, himm}) {
    ASSERT_EQ(estimate.size(), 9);
    for (Eigen::Index i = 0; i < 9; ++i) {
      const double truth = i == 0 ? 5000.0 : i == 3 ? 200.0 : i == 6 ? 4.0 : 0.0;
      EXPECT_NEAR(estimate.mean(i), truth, 3.0 * std::sqrt(estimate.covariance(i, i))) << "component " << i;
    }
  }
  EXPECT_NE(imm.mean, himm.mean);
}

}  // namespace
}  // namespace sigmax
