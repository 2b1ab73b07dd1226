// The code of docs/multiple_models.md.

#include "support/sigmax.hpp"

namespace multiple_models_walk_test {

template <Uncertainty Kind>
auto both(const Relation<Kind, Kind>& transition, const Gaussian<9>& start) {
  const std::tuple models{dwna<3>(3.0), dwpa<3>(3.0)};
  return std::pair{InteractingMultipleModel{models, transition, start},   // IMM or HIMM
                   SecondOrderMultipleModel{models, transition, start}};  // GPB2 or Viterbi
}

TEST(MultipleModelsWalk, SmoothsAndFollowsATarget) {
  const FuzzyVariable mode{"mode", {"dwna", "dwpa"}};
  const Relation transition{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}};
  const Gaussian<9> start{Vector<9>::Zero(), 100.0 * SquareMatrix<9>::Identity()};
  auto filter = both(transition, start).first;
  const Gaussian<3> measured{Vector<3>(1.0, 2.0, 3.0), 25.0 * SquareMatrix<3>::Identity()};
  const std::vector<std::pair<double, Gaussian<3>>> measurements(4, {0.5, measured});

  const Gate gate = Gate::probability(0.999);  // or Gate::squared_distance(13.8)
  std::vector record{filter.recorded(0.0)};
  for (const auto& [dt, z] : measurements) {
    filter.step(dt, z, gate);
    record.push_back(filter.recorded(dt, z, gate));
  }
  const auto smoothed = smooth(filter, record);
  const auto first = filter.estimate(smoothed.front());
  EXPECT_EQ(smoothed.size(), 5U);
  EXPECT_LT(first.covariance(0, 0), 100.0);

  const Gaussian<3>& z = measured;
  const auto one_point_start = [](const Gaussian<3>& seen) {
    Gaussian<9> result{Vector<9>::Zero(), 1e4 * SquareMatrix<9>::Identity()};
    result.mean.head<3>() = seen.mean;
    result.covariance.topLeftCorner<3, 3>() = seen.covariance;
    return result;
  };
  TargetRules rules;
  rules.gate_probability = 0.999;
  rules.rejections = 3;
  rules.longest_gap = 10.0;
  rules.buffer = 5;
  Target target{filter, 0.0, one_point_start, rules};
  const Verdict verdict = target.take(0.2, z);  // accepted, rejected, restarted; take(time) is missed
  EXPECT_EQ(verdict, Verdict::accepted);
}

TEST(MultipleModelsWalk, StepsManyTracksAtOnce) {
  const RandomVariable mode{"mode", {"dwna", "dwpa"}};
  const Relation transition{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}};
  const Gaussian<9> start{Vector<9>::Zero(), 100.0 * SquareMatrix<9>::Identity()};
  const Gaussian<3> z{Vector<3>(1.0, 2.0, 3.0), 25.0 * SquareMatrix<3>::Identity()};
  FilterBank bank{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition};
  const std::size_t track = bank.add(start);  // a number, which `bank.remove(track)` gives back
  auto scan = bank.scan();
  scan.set(track, z);
  bank.step(0.2, scan);  // a track without a measurement misses
  const Gaussian position = bank.estimate(track);
  using Models = std::tuple<IndependentAxes<3, DiscreteWhiteNoise<2>>, IndependentAxes<3, DiscreteWhiteNoise<3>>>;
  FilterBank<Models, Random, float> single{{dwna<3>(3.0), dwpa<3>(3.0)}, transition};
  single.add(start);
  auto same = single.scan();
  same.set(0, z);
  single.step(0.2, same);
  EXPECT_NEAR(single.estimate(0).mean(0), position.mean(0), 1e-5);
}

}  // namespace multiple_models_walk_test
