// A bank of typed models does the same as one of run-time models and as a target with its choices in plain data, and
// what does not fit its types does not compile.

#include "hybrid/banks.hpp"

namespace bank_filter_test {

using Dwna = IndependentAxes<2, DiscreteWhiteNoise<2>>;
using Dwpa = IndependentAxes<2, DiscreteWhiteNoise<3>>;
using Turn = Extended<CoordinatedTurn<2>>;
using Typed = std::tuple<Dwna, Dwpa, Turn>;

template <Uncertainty Kind>
void is_one_filter(Scheme scheme) {
  TargetChoice choice = with(chosen(std::is_same_v<Kind, Fuzzy>, scheme), {calm(1.0), turning(4.0), motion("ct", 2.0)},
                             chosen(std::is_same_v<Kind, Fuzzy>).transition);
  choice.motions[2][MotionParameter::turn_drift] = 0.5;
  choice.start = StartRule::given;
  choice.start_time_s = 0.0;
  choice.start_mean = {12000, 8000, 0, -100, -100, 0, 0, 0, 0};
  choice.start_covariance_diagonal = {100, 100, 100, 25, 25, 25, 4, 4, 4};
  choice.rules = {.gate_probability = 1.0, .rejections = 0};
  AnyTarget target(choice);

  const Typed typed{dwna<2>(1.0), dwpa<2>(4.0), Turn{CoordinatedTurn<2>{2.0, 0.5 * degree}}};
  Gaussian<7> start{Vector<7>(12000, 8000, -100, -100, 0, 0, 0),
                    SquareMatrix<7>(Vector<7>(100, 100, 25, 25, 4, 4, 9.0 * degree * degree).asDiagonal())};
  const auto interaction = interaction_of<Kind>(choice);
  const auto follow = [&](auto tuple) {
    AnyFilter vector(choice, start);
    EXPECT_EQ(vector.components, (std::vector<std::string>{"x", "y", "vx", "vy", "ax", "ay", "omega"}));
    double time = 0.0;
    for (Scan scan : manoeuvring_target(140)) {
      const double before = time;
      time += scan.dt;
      scan.dt = time - before;  // which is what a target sees
      vector.step(scan);
      scan.z ? tuple.step(scan.dt, *scan.z) : tuple.step(scan.dt);
      target.take(scan.z ? AnyDetection::position(time, {scan.z->mean.data(), 2}, {scan.z->covariance.data(), 4})
                         : AnyDetection::missed(time));
      ASSERT_PRED_FORMAT3(same_state, shown(tuple), vector, 1e-9);
      ASSERT_CLOSE(tuple.estimate().mean, vector.estimate.mean, 1e-9);
      ASSERT_CLOSE(tuple.estimates()[2].covariance, vector.estimates[2].covariance, 1e-9);
      const TargetPoint point = target.output();
      ASSERT_CLOSE(point.mean, entries(vector.estimate.mean), 1e-9);
      ASSERT_CLOSE(point.covariance, entries(vector.estimate.covariance), 1e-9);
      ASSERT_EQ(point.most_likely_mode, vector.winner);
      for (std::size_t j = 0; j < 3; ++j) ASSERT_CLOSE(point.weights[j], std::exp(vector.logs[j]), 1e-9);
      ASSERT_EQ(point.nis.has_value(), vector.measured);
      if (point.nis) ASSERT_CLOSE(*point.nis, vector.nis, 1e-9);
      if (point.nis) ASSERT_CLOSE(*point.log_score, vector.log_score, 1e-9);
    }
  };
  const auto transition = transition_of<Kind>(choice);
  if (scheme == Scheme::interacting) follow(InteractingMultipleModel{typed, transition, start, interaction});
  if (scheme == Scheme::second_order) follow(SecondOrderMultipleModel{typed, transition, start, interaction});
  if (scheme == Scheme::histories)
    follow(HistoryFilter{typed, transition, start, HistoryRules<Kind>{.cut = choice.cut}, interaction});
}

TEST(BankFilter, OfATupleAVectorOrATargetIsTheSameFilter) {
  for (const Scheme scheme : {Scheme::interacting, Scheme::second_order}) {
    is_one_filter<Random>(scheme);
    is_one_filter<Fuzzy>(scheme);
  }
  is_one_filter<Fuzzy>(Scheme::histories);
}

TEST(BankFilter, OfAVectorOfOneTypeIsTheSameFilterToo) {
  TargetChoice choice = with(chosen(true), {calm(1.0), calm(5.0)}, {{1.0, 0.5}, {0.5, 1.0}});
  AnyFilter expected(choice);
  InteractingMultipleModel filter{std::vector{dwna<2>(1.0), dwna<2>(5.0)}, transition_of<Fuzzy>(choice),
                                  std::vector<Gaussian<4>>{Estimates(starts(choice))[0], Estimates(starts(choice))[1]},
                                  interaction_of<Fuzzy>(choice)};
  for (const Scan& scan : manoeuvring_target(60)) {
    scan.z ? filter.step(scan.dt, *scan.z) : filter.step(scan.dt);
    expected.step(scan);
    ASSERT_PRED_FORMAT3(same_state, shown(filter), expected, 1e-12);
  }
}

template <class Filter>
concept StepsByPosition = requires(Filter& filter, const typename Filter::Measurement& z) {
  filter.step(0.2, z);
};
template <class Filter, class Sensor, int M>
concept Steps = requires(Filter& filter, const Gaussian<M>& z, const Sensor& sensor) {
  filter.step(0.2, z, sensor);
};
using Imm = InteractingMultipleModel<Typed, Random>;
static_assert(std::is_same_v<Imm::Measurement, Gaussian<2>> && StepsByPosition<Imm>);
static_assert(!StepsByPosition<InteractingMultipleModel<std::tuple<FixedStepMotion<4>>, Random>>, "it has no position");
static_assert(Steps<Imm, PolarSensor<2>, 2> && !Steps<Imm, PolarSensor<2>, 1> && !Steps<Imm, PolarSensor<2>, 3>);
static_assert(!Steps<Imm, PolarSensor<3>, 3> && !Steps<Imm, PositionSensor<3>, 3>, "of another number of axes");
static_assert(Steps<Imm, LinearSensor<1, 4>, 1> && !Steps<Imm, LinearSensor<1, 5>, 1>, "DWNA has four components");
static_assert(Steps<Imm, LinearSensor<6, 4>, 6> && !Steps<Imm, LinearSensor<7, 4>, 7>, "of more than a filter keeps");
using Transition = Relation<Random, Random>;
static_assert(std::constructible_from<Imm, Typed, Transition, std::tuple<Gaussian<4>, Gaussian<6>, Gaussian<5>>>);
static_assert(!std::constructible_from<Imm, Typed, Transition, std::tuple<Gaussian<4>, Gaussian<4>, Gaussian<5>>>);
static_assert(!std::constructible_from<Imm, Typed, Relation<Fuzzy, Fuzzy>, Gaussian<7>>, "of another kind");
static_assert(!std::constructible_from<AnyModel, CoordinatedTurn<2>>, "not linear, and in no member");

TEST(BankFilter, OfAVectorMayNotHaveMoreComponentsThanItsTypeAllows) {
  const auto with_third = [](const char* name) {
    return FixedStepMotion<3>{"any", {"x", "vx", name}, 1.0, SquareMatrix<3>::Identity(), SquareMatrix<3>::Identity()};
  };
  const FuzzyVariable mode{"mode", 2};
  const Gaussian<3> start{Vector<3>::Zero(), SquareMatrix<3>::Identity()};
  EXPECT_INVALID(("4 different components", "3"),
                 InteractingMultipleModel(std::vector{with_third("ax"), with_third("omega")},
                                          Relation{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}}, std::vector{start, start}));
}

}  // namespace bank_filter_test
