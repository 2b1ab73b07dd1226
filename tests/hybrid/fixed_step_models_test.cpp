// The filters over models that are nothing but matrices: components that are not nested, states without memory, and
// what is known of all histories of the mode together.

#include "hybrid/banks.hpp"
#include "hybrid/named_sensor.hpp"
#include "support/history_restatement.hpp"

namespace fixed_step_models_test {

template <int N>
using Fixed = FixedStepMotion<N>;

/// Follows measurements by both filters of this kind.
template <Uncertainty Kind, int N, class Follow>
void by_both_orders(const std::vector<Fixed<N>>& models, const Rows& rows, const Estimates& start,
                    StateAugmentation augmentation, const Follow& follow) {
  const Variable<Kind> mode{"mode", rows.size()};
  const Relation<Kind, Kind> transition{mode, mode, rows};
  const Interaction<Kind> interaction{.augmentation = augmentation};
  const Models any(models.begin(), models.end());
  follow(InteractingMultipleModel{any, transition, start, interaction}, Scheme::interacting);
  follow(SecondOrderMultipleModel{any, transition, start, interaction}, Scheme::second_order);
}

template <int N>
restatement::Model restated_model(const Fixed<N>& model, const restatement::Matrix& H) {
  return {model.components(), [model](double dt) { return dense(model.transition(dt)); },
          [model](double dt) { return dense(model.process_covariance(dt)); }, H};
}

const NamedSensor<1> sees_x{{"x"}};

// Beside {x, vx, ax} stands a model whose third component is another thing, and whose order is another.
const Fixed<3> accelerating{"accelerating",
                            {"x", "vx", "ax"},
                            1.0,
                            SquareMatrix<3>{{1, 1, 0.5}, {0, 1, 1}, {0, 0, 1}},
                            SquareMatrix<3>{{0.3, 0.1, 0}, {0.1, 0.4, 0.1}, {0, 0.1, 0.2}}};
const Fixed<3> turning_x{"turning",
                         {"turn_rate", "x", "vx"},
                         1.0,
                         SquareMatrix<3>{{0.9, 0, 0}, {0.2, 1, 0.8}, {-0.3, 0.1, 0.9}},
                         SquareMatrix<3>{{0.1, 0, 0}, {0, 0.5, 0.2}, {0, 0.2, 0.6}}};

template <Uncertainty Kind>
void mixes_as_the_restatement(StateAugmentation augmentation) {
  constexpr bool fuzzy = std::is_same_v<Kind, Fuzzy>;
  const Rows rows = fuzzy ? Rows{{1.0, 0.5}, {0.5, 1.0}} : Rows{{0.8, 0.2}, {0.2, 0.8}};
  const Estimates start(
      std::vector{Gaussian<3>{Vector<3>{1, 2, 0.5}, SquareMatrix<3>{{4, 1, 0.5}, {1, 3, 1}, {0.5, 1, 2}}},
                  Gaussian<3>{Vector<3>{0.1, 1.5, 1.5}, SquareMatrix<3>{{1, 0.2, 0.1}, {0.2, 5, 1}, {0.1, 1, 4}}}});
  std::vector<restatement::Model> models;
  for (const auto& model : {accelerating, turning_x})
    models.push_back(restated_model(model, restated_matrix(sees_x.names, model.components())));
  by_both_orders<Kind, 3>({accelerating, turning_x}, rows, start, augmentation, [&](auto filter, Scheme scheme) {
    restatement::Filter expected{
        models, restate(rows), restate(start), {1.0, 1.0}, restate(with(chosen(fuzzy, scheme), augmentation))};
    EXPECT_EQ(filter.components(), (std::vector<std::string>{"x", "vx", "ax", "turn_rate"}));
    std::mt19937_64 generator(5);
    std::normal_distribution<double> normal;
    std::size_t winners = 0;  // as bits
    for (int k = 0; k < 60; ++k) {
      if (k % 5 == 3) {
        filter.step(1.0);
        expected.step(1.0);
      } else {
        const double z = 2.0 * k + 8.0 * std::sin(0.4 * k) + normal(generator);
        filter.step(1.0, {Vector<1>{z}, SquareMatrix<1>{2.0}}, sees_x);
        expected.step(1.0, {z}, {1, 1, {2.0}});
      }
      ASSERT_TRUE(agrees(shown(filter), expected)) << "at scan " << k;
      winners |= std::size_t{1} << filter.most_likely_mode();
    }
    EXPECT_EQ(winners, 3U) << "both models should win at some time";
  });
}

TEST(FixedStepModels, OfComponentsThatAreNotNestedMixAsInTheRestatement) {
  for (const StateAugmentation augmentation : augmentations) {
    mixes_as_the_restatement<Random>(augmentation);
    mixes_as_the_restatement<Fuzzy>(augmentation);
  }
}

/// Generated models of one component, and rows of a transition.
struct Generated {
  std::vector<Fixed<1>> models;
  std::vector<restatement::Model> restated;
  Rows rows;
};
Generated generated_models(bool fuzzy, std::size_t modes, bool forget) {
  Generated result;
  for (std::size_t j = 0; j < modes; ++j) {
    const double F = forget ? 0.0 : number_between(-1.5, 1.5);
    result.models.push_back({"any", {"x"}, 1.0, SquareMatrix<1>{F}, SquareMatrix<1>{number_between(0.1, 4.0)}});
    result.restated.push_back(restated_model(result.models.back(), restatement::identity(1)));
    std::vector<double> row;
    for (std::size_t i = 0; i < modes; ++i) row.push_back(i == j ? 1.0 : *rc::gen::element(0.0, 0.25, 0.5, 1.0));
    double sum = 0.0;
    for (const double value : row) sum += value;
    for (double& value : row) value /= fuzzy ? 1.0 : sum;
    result.rows.push_back(row);
  }
  return result;
}
const Gaussian<1> somewhere{Vector<1>{1.0}, SquareMatrix<1>{2.0}};

/// All histories of the mode, each with a Kalman filter of its own, and each scored whole.
restatement::HistoryFilter all_histories(bool fuzzy, const Generated& generated) {
  return {generated.restated,
          restate(generated.rows),
          restate(Estimates(std::vector(generated.models.size(), somewhere))),
          {.kind = fuzzy ? restatement::Kind::himm : restatement::Kind::imm, .cut = 0.0}};
}

TYPED_SUITE(FixedStepModelsOf, Random, Fuzzy);

/// Without memory a measurement is of the mode alone: weights of a random mode are the forward–backward pass over all
/// histories, of a fuzzy one Viterbi's and the max-marginals, and the smoothed states are the filtered ones.
TYPED_PROPERTY(FixedStepModelsOf, WithoutMemoryWeighTheirModesAsAllHistoriesTogether) {
  constexpr bool fuzzy = std::is_same_v<TypeParam, Fuzzy>;
  const auto generated = generated_models(fuzzy, 3, true);
  auto all = all_histories(fuzzy, generated);
  std::vector<double> z;
  std::vector<restatement::Vector> forward{all.log_weights()};
  for (int k = 0; k < 3; ++k) {
    z.push_back(number_between(-4.0, 4.0));
    all.step(1.0, {z.back()}, {1, 1, {0.5}});
    forward.push_back(all.log_weights());
  }
  by_both_orders<TypeParam, 1>(
      generated.models, generated.rows, std::vector(3, somewhere), {}, [&](auto filter, Scheme) {
        const PositionSensor<1> sensor;
        std::vector record{filter.recorded(0.0)};
        for (const double measured : z) {
          const Gaussian<1> seen{Vector<1>{measured}, SquareMatrix<1>{0.5}};
          filter.step(1.0, seen, sensor);
          record.push_back(filter.recorded(1.0, seen, sensor));
        }
        const auto smoothed = smooth(filter, record);
        for (std::size_t k = 0; k <= z.size(); ++k) {
          const auto backward = all.log_weights(k);
          for (std::size_t j = 0; j < 3; ++j) {
            require_near(record[k].state.belief[j], std::exp(forward[k][j]), 1e-9);
            require_near(smoothed[k].belief[j], std::exp(backward[j]), 1e-9);
            require_near(smoothed[k].estimates[j].mean, record[k].state.estimates[j].mean, 1e-9);
            require_near(smoothed[k].estimates[j].covariance, record[k].state.estimates[j].covariance, 1e-9);
          }
        }
      });
}

TEST(FixedStepModels, AStepForWhichAModelIsNotGivenIsRefused) {
  const FuzzyVariable mode{"mode", 1};
  InteractingMultipleModel filter{std::tuple{accelerating}, Relation{mode, mode, {{1.0}}},
                                  Gaussian<3>{Vector<3>::Zero(), SquareMatrix<3>::Identity()}};
  EXPECT_INVALID(("accelerating", "1.0", "0.5"), filter.step(0.5));
}

}  // namespace fixed_step_models_test
