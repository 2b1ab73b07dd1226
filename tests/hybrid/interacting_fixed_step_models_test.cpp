// The filter over models that are nothing but matrices: components that are not nested, and states without memory.
#include <gtest/gtest.h>

#include <concepts>
#include <random>

#include <sigmax/estimation/fixed_step_motion.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "hybrid/banks.hpp"
#include "hybrid/named_sensor.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::agrees;
using support::dense;
using support::holds;
using support::Interacting;
using support::near;
using support::number_between;
using support::SecondOrder;
using support::throws;

using Model = FixedStepMotion<3>;
using Measured = Gaussian<1>;
const support::NamedSensor<1> sees_x{{"x"}};

restatement::Model restated(const Model& model) {
  return {model.components(), [model](double dt) { return dense(model.transition(dt)); },
          [model](double dt) { return dense(model.process_covariance(dt)); },
          support::restated_matrix(sees_x.names, model.components())};
}

template <class Filter>
void step(Filter& filter, const std::optional<Measured>& z) {
  if constexpr (std::derived_from<Filter, restatement::Filter>)
    z ? filter.step(1.0, {z->mean(0)}, {1, 1, {z->covariance(0, 0)}}) : filter.step(1.0);
  else
    z ? filter.step(1.0, *z, sees_x) : filter.step(1.0);
}

// Beside {x, vx, ax} stands a model whose third component is another thing, and whose order is another.
const Model accelerating{"accelerating",
                         {"x", "vx", "ax"},
                         1.0,
                         SquareMatrix<3>{{1, 1, 0.5}, {0, 1, 1}, {0, 0, 1}},
                         SquareMatrix<3>{{0.3, 0.1, 0}, {0.1, 0.4, 0.1}, {0, 0.1, 0.2}}};
const Model turning{"turning",
                    {"turn_rate", "x", "vx"},
                    1.0,
                    SquareMatrix<3>{{0.9, 0, 0}, {0.2, 1, 0.8}, {-0.3, 0.1, 0.9}},
                    SquareMatrix<3>{{0.1, 0, 0}, {0, 0.5, 0.2}, {0, 0.2, 0.6}}};

const Gaussian<3> of_accelerating{Vector<3>{1, 2, 0.5}, SquareMatrix<3>{{4, 1, 0.5}, {1, 3, 1}, {0.5, 1, 2}}};
const Gaussian<3> of_turning{Vector<3>{0.1, 1.5, 1.5}, SquareMatrix<3>{{1, 0.2, 0.1}, {0.2, 5, 1}, {0.1, 1, 4}}};

template <class Order, Uncertainty Kind>
void mixes_as_the_restatement(const Interaction<Kind>& interaction) {
  const Variable<Kind> mode{"mode", {"accelerating", "turning"}};
  const double stay = std::is_same_v<Kind, Random> ? 0.8 : 1.0;
  const double move = std::is_same_v<Kind, Random> ? 0.2 : 0.5;
  const Relation<Kind, Kind> transition{mode, mode, {{stay, move}, {move, stay}}};
  typename Order::template Filter<std::tuple<Model, Model>, Kind> filter{
      std::tuple{accelerating, turning}, transition, std::tuple{of_accelerating, of_turning}, interaction};
  typename Order::Restated expected{{restated(accelerating), restated(turning)},
                                    support::restate(transition),
                                    {support::restate(of_accelerating), support::restate(of_turning)},
                                    {1.0, 1.0},
                                    support::restate(interaction)};
  EXPECT_EQ(filter.components(), (std::vector<std::string>{"x", "vx", "ax", "turn_rate"}));
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  std::size_t winners = 0;  // as bits
  for (int k = 0; k < 60; ++k) {
    std::optional<Measured> z;
    if (k % 5 != 3)
      z = Measured{Vector<1>{2.0 * k + 8.0 * std::sin(0.4 * k) + normal(generator)}, SquareMatrix<1>{2.0}};
    step(filter, z);
    step(expected, z);
    ASSERT_TRUE(agrees(filter, expected)) << "at scan " << k;
    winners |= std::size_t{1} << filter.most_likely_mode();
  }
  EXPECT_EQ(winners, 3U) << "both models should win at some time";
}

TEST(InteractingFixedStepModels, ComponentsThatAreNotNestedMixAsInTheRestatement) {
  for (const Lift lift : {Lift::zero, Lift::borrowed_variance, Lift::unbiased}) {
    mixes_as_the_restatement<Interacting, Random>({lift, {MixingWeights::correct}, Tie::stay});
    mixes_as_the_restatement<Interacting, Random>({lift, {MixingWeights::released}, Tie::stay});
    mixes_as_the_restatement<SecondOrder, Random>({lift, {}, Tie::stay});
    mixes_as_the_restatement<SecondOrder, Fuzzy>({lift, {}, Tie::stay});
    for (const auto reading :
         {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred, MixedCovariance::released})
      mixes_as_the_restatement<Interacting, Fuzzy>({lift, {reading}, Tie::stay});
  }
}

/// A model that forgets its state, F = 0: it predicts N(mean, variance) whatever came before.
Model forgetful(double mean, double variance) {
  return {"forgetful",
          {"x", "y", "z"},
          1.0,
          SquareMatrix<3>::Zero(),
          variance * SquareMatrix<3>::Identity(),
          Vector<3>{mean, 0.0, 0.0}};
}

/// log N(z; mean, variance).
double log_normal(double z, double mean, double variance) {
  return -0.5 * ((z - mean) * (z - mean) / variance + std::log(2.0 * std::numbers::pi * variance));
}

/// The weights of the modes by brute force over all paths: each path is scored whole, and of the paths to one mode the
/// sum or the maximum counts.
template <class Order, Uncertainty Kind>
void weighs_as_all_paths_together() {
  constexpr std::size_t modes = 3, scans = 6;
  const std::vector<double> means{-1.0, 0.5, 2.0}, variances{1.0, 4.0, 0.5};
  const double R = 0.3;
  const std::vector<double> measurements{-0.7, 0.2, 2.2, 1.9, 5.0, -1.5};
  const Variable<Kind> mode{"mode", modes};
  const Relation<Kind, Kind> transition =
      std::is_same_v<Kind, Random>
          ? Relation<Kind, Kind>{mode, mode, {{0.7, 0.2, 0.1}, {0.0, 0.6, 0.4}, {0.3, 0.3, 0.4}}}
          : Relation<Kind, Kind>{mode, mode, {{1.0, 0.3, 0.1}, {0.0, 1.0, 0.4}, {0.6, 1.0, 0.8}}};

  std::vector<Model> models;
  for (std::size_t j = 0; j < modes; ++j) models.push_back(forgetful(means[j], variances[j]));
  const Gaussian<3> anywhere{Vector<3>{3, 1, 4}, 9.0 * SquareMatrix<3>::Identity()};
  typename Order::template Filter<std::vector<Model>, Kind> filter{models, transition,
                                                                   std::vector<Gaussian<3>>(modes, anywhere)};

  for (std::size_t k = 1; k <= scans; ++k) {
    filter.step(1.0, Measured{Vector<1>{measurements[k - 1]}, SquareMatrix<1>{R}}, sees_x);

    std::vector<double> weights(modes, 0.0);
    std::size_t paths = modes;
    for (std::size_t i = 0; i < k; ++i) paths *= modes;
    for (std::size_t path = 0; path < paths; ++path) {  // its digits in base 3 are r_0 … r_k
      std::size_t rest = path;
      std::size_t mode_before = rest % modes;
      double weight = 1.0;
      for (std::size_t i = 0; i < k; ++i) {
        rest /= modes;
        const std::size_t mode_now = rest % modes;
        weight *= transition(mode_before, mode_now) *
                  std::exp(log_normal(measurements[i], means[mode_now], variances[mode_now] + R));
        mode_before = mode_now;
      }
      weights[mode_before] =
          std::is_same_v<Kind, Random> ? weights[mode_before] + weight : std::max(weights[mode_before], weight);
    }
    double total = 0.0;
    for (const double weight : weights) total = std::is_same_v<Kind, Random> ? total + weight : std::max(total, weight);
    for (std::size_t j = 0; j < modes; ++j)
      EXPECT_PRED_FORMAT3(near, filter.belief()[j], weights[j] / total, 1e-12) << "mode " << j << ", scan " << k;
  }
}

TEST(InteractingFixedStepModels, WithoutMemoryWeightsOfARandomModeAreTheForwardPassOverAllPaths) {
  weighs_as_all_paths_together<Interacting, Random>();
  weighs_as_all_paths_together<SecondOrder, Random>();
}
TEST(InteractingFixedStepModels, WithoutMemoryWeightsOfAFuzzyModeAreViterbisOverAllPaths) {
  weighs_as_all_paths_together<Interacting, Fuzzy>();
  weighs_as_all_paths_together<SecondOrder, Fuzzy>();
}

/// Of models with memory the filters keep one Gaussian a mode. As long as that is exact, from one start for all models
/// over two scans, they must know what all histories together know.
template <Uncertainty Kind>
void knows_what_all_histories_know(bool selects) {
  const auto scalar = [](const std::string& name, double F, double Q, double u) {
    return FixedStepMotion<1>{name, {"x"}, 1.0, SquareMatrix<1>{F}, SquareMatrix<1>{Q}, Vector<1>{u}};
  };
  holds([&] {
    constexpr std::size_t modes = 3;
    std::vector<FixedStepMotion<1>> models;
    std::vector<double> F, Q, u;
    std::vector<std::vector<double>> rows(modes);
    for (std::size_t j = 0; j < modes; ++j) {
      F.push_back(number_between(-1.5, 1.5));
      Q.push_back(number_between(0.1, 4.0));
      u.push_back(number_between(-3.0, 3.0));
      models.push_back(scalar("any", F[j], Q[j], u[j]));
      for (std::size_t i = 0; i < modes; ++i) rows[j].push_back(i == j ? 1.0 : number_between(0.0, 1.0));
      if (!selects) {
        const double sum = rows[j][0] + rows[j][1] + rows[j][2];
        for (double& value : rows[j]) value /= sum;
      }
    }
    const Variable<Kind> mode{"mode", modes};
    SecondOrderMultipleModel filter{models, Relation<Kind, Kind>{mode, mode, rows},
                                    std::vector<Gaussian<1>>(modes, {Vector<1>{1.0}, SquareMatrix<1>{2.0}})};
    const double R = 0.5;
    const std::vector<double> z{number_between(-5.0, 5.0), number_between(-5.0, 5.0)};
    for (const double measured : z)
      filter.step(1.0, Measured{Vector<1>{measured}, SquareMatrix<1>{R}}, PositionSensor<1>{});

    double best = -1.0, total = 0.0, mean = 0.0, square = 0.0, best_mean = 0.0, best_variance = 0.0;
    for (std::size_t before = 0; before < modes; ++before)  // r_0: of no account for the state
      for (std::size_t first = 0; first < modes; ++first)
        for (std::size_t second = 0; second < modes; ++second) {
          double weight = rows[before][first] * rows[first][second], x = 1.0, P = 2.0;
          for (const auto& [j, seen] : {std::pair{first, z[0]}, std::pair{second, z[1]}}) {
            x = F[j] * x + u[j];
            P = F[j] * P * F[j] + Q[j];
            weight *= std::exp(log_normal(seen, x, P + R));
            const double W = P / (P + R);
            x += W * (seen - x);
            P *= 1.0 - W;
          }
          total += weight;
          mean += weight * x;
          square += weight * (P + x * x);
          if (weight > best * (1.0 + 1e-12)) {
            best = weight;
            best_mean = x;
            best_variance = P;
          }
        }
    mean /= total;
    const auto found = filter.estimate();
    support::require_near(found.mean(0), selects ? best_mean : mean, 1e-9);
    support::require_near(found.covariance(0, 0), selects ? best_variance : square / total - mean * mean, 1e-9);
  });
}

TEST(InteractingFixedStepModels, Gpb2KnowsTheMomentsOfAllHistoriesOfTwoScans) {
  knows_what_all_histories_know<Random>(false);
}
TEST(InteractingFixedStepModels, TheViterbiFilterFindsTheBestOfAllHistoriesOfTwoScans) {
  knows_what_all_histories_know<Fuzzy>(true);
}

TEST(InteractingFixedStepModels, AVectorOfThemMayNotHaveMoreComponentsThanItsTypeAllows) {
  const FuzzyVariable mode{"mode", 2};
  const Relation transition{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}};
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        InteractingMultipleModel(std::vector{accelerating, turning}, transition,
                                 std::vector{of_accelerating, of_turning});
      },
      {"4 different components", "3"}));
}

TEST(InteractingFixedStepModels, AStepForWhichAModelIsNotGivenIsRefused) {
  const FuzzyVariable mode{"mode", 2};
  const Relation transition{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}};
  InteractingMultipleModel filter{std::tuple{accelerating, turning}, transition,
                                  std::tuple{of_accelerating, of_turning}};
  EXPECT_TRUE(throws<std::invalid_argument>([&] { filter.step(0.5); }, {"accelerating", "1.0", "0.5"}));
}

}  // namespace
}  // namespace sigmax
