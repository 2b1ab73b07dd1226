#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <numeric>

#include "hybrid/instruction_sets.hpp"
#include "hybrid/laws.hpp"

namespace sigmax {

template class InteractingMultipleModel<VectorBank, Random>;
template class InteractingMultipleModel<VectorBank, Fuzzy>;
template class InteractingMultipleModel<TupleBank, Random>;
template class InteractingMultipleModel<TupleBank, Fuzzy>;

namespace {

using namespace support;
using support::ties;  // not those of a logarithm

TEST(InteractingMultipleModel, ImmEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Interacting, Random>({lift, {}, Tie::stay});
}

TEST(InteractingMultipleModel, ImmWithReleasedWeightsEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts)
    equals_the_restatement<Interacting, Random>({lift, {MixingWeights::released}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithTheSelectedCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts)
    equals_the_restatement<Interacting, Fuzzy>({lift, {MixedCovariance::selected}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithItsOwnCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<Interacting, Fuzzy>({lift, {MixedCovariance::own}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithItsOwnRecentredCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts)
    equals_the_restatement<Interacting, Fuzzy>({lift, {MixedCovariance::own_recentred}, Tie::stay});
}

TEST(InteractingMultipleModel, HimmWithTheReleasedCovarianceEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts)
    equals_the_restatement<Interacting, Fuzzy>({lift, {MixedCovariance::released}, Tie::stay});
}

TEST(InteractingMultipleModel, EqualsTheRestatementByEachInstructionSet) {
  under_each_instruction_set([] {
    for (const Lift lift : lifts) equals_the_restatement<Interacting, Random>({lift, {}, Tie::stay}, 60);
    for (const auto covariance : {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred})
      for (const Tie tie : ties) equals_the_restatement<Interacting, Fuzzy>({Lift::zero, {covariance, tie}, tie}, 60);
  });
}

TEST(InteractingMultipleModel, HimmByTheEnvelopeEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts)
    equals_the_restatement<Interacting, Fuzzy>({lift, {MixedCovariance::envelope}, Tie::stay}, 60);
}

TEST(InteractingMultipleModel, HimmEqualsTheRestatementUnderEachTieRule) {
  for (const Tie mixing : ties)
    for (const Tie output : ties)
      equals_the_restatement<Interacting, Fuzzy>({Lift::zero, {MixedCovariance::selected, mixing}, output}, 120);
}

/// The paper's own pair: equal σ_w and ε = ½, where a reset DWPA predicts what DWNA predicts, and so ties with it.
template <Uncertainty Kind>
Filter<Interacting, Kind> paper_pair(const Interaction<Kind>& interaction) {
  const auto all = starts();
  return {VectorBank{calm(3.0), turning(3.0)},
          transition_by<Kind>({{std::is_same_v<Kind, Random> ? 0.95 : 1.0, std::is_same_v<Kind, Random> ? 0.05 : 0.5},
                               {std::is_same_v<Kind, Random> ? 0.05 : 0.5, std::is_same_v<Kind, Random> ? 0.95 : 1.0}}),
          std::vector<State>{all[0], all[2]}, interaction};
}

TEST(InteractingMultipleModel, TheExactTiesOfThePapersPairAreBrokenAsTheRestatementBreaksThem) {
  const auto all = starts();
  for (const Tie mixing : ties)
    for (const Tie output : ties) {
      const Interaction<Fuzzy> interaction{Lift::zero, {MixedCovariance::selected, mixing}, output};
      auto filter = paper_pair(interaction);
      auto expected = restated<Interacting, Fuzzy>({calm(3.0), turning(3.0)}, filter.system().transition(),
                                                   {all[0], all[2]}, interaction);
      std::size_t tied = 0;
      for (const Scan& scan : manoeuvring_target(120)) {
        step(filter, scan);
        step(expected, scan);
        ASSERT_TRUE(agrees(filter, expected));
        // DWPA next comes as likely from DWNA, at ½ · 1, as from itself, at 1 · ½.
        if (std::abs(filter.belief().log(0) - std::log(2.0) - filter.belief().log(1)) <= tie_tolerance) ++tied;
      }
      EXPECT_GT(tied, 20U);
    }
}

TEST(InteractingMultipleModel, AnyImmEqualsTheRestatement) {
  holds([] {
    generated_filters<Interacting, Random>({*rc::gen::elementOf(std::vector(lifts)),
                                            {*rc::gen::element(MixingWeights::correct, MixingWeights::released)},
                                            *rc::gen::elementOf(std::vector(ties))});
  });
}

TEST(InteractingMultipleModel, AnyHimmEqualsTheRestatement) {
  holds([] {
    generated_filters<Interacting, Fuzzy>(
        {*rc::gen::elementOf(std::vector(lifts)),
         {*rc::gen::elementOf(std::vector(readings)), *rc::gen::elementOf(std::vector(ties))},
         *rc::gen::elementOf(std::vector(ties))});
  });
}

TEST(InteractingMultipleModel, Gpb1AndTheGlobalArgMaxEqualTheRestatement) {
  for (const Lift lift : lifts) {
    equals_the_restatement<Interacting, Random>({lift, {}, Tie::stay, MixedStart::common}, 110);
    for (const MixedCovariance reading : readings)
      equals_the_restatement<Interacting, Fuzzy>({lift, {reading}, Tie::stay, MixedStart::common}, 110);
  }
  holds([] {
    generated_filters<Interacting, Random>({*rc::gen::elementOf(std::vector(lifts)),
                                            {},
                                            *rc::gen::elementOf(std::vector(ties)),
                                            MixedStart::common,
                                            *rc::gen::element(LikelihoodForm::density, LikelihoodForm::possibility)});
    generated_filters<Interacting, Fuzzy>(
        {*rc::gen::elementOf(std::vector(lifts)),
         {*rc::gen::elementOf(std::vector(readings)), *rc::gen::elementOf(std::vector(ties))},
         *rc::gen::elementOf(std::vector(ties)),
         MixedStart::common});
  });
}

TEST(InteractingMultipleModel, Gpb1RestartsEveryModelFromTheOneCollapsedEstimate) {
  const VectorBank models{calm(1.0), calm(5.0), calm(20.0)};
  Filter<Interacting, Random> filter{models, random_transition, starts()[0],
                                     Interaction<Random>{Lift::zero, {}, Tie::stay, MixedStart::common}};
  for (const Scan& scan : manoeuvring_target(60)) {
    const State one{filter.estimate().mean, filter.estimate().covariance};
    auto probe = filter;
    probe.step(scan.dt);
    for (std::size_t j = 0; j < 3; ++j) {
      State expected;
      predict(models[j], one, scan.dt, expected);
      ASSERT_PRED_FORMAT3(near_matrix, probe.estimates()[j].mean, expected.mean, 1e-12);
      ASSERT_PRED_FORMAT3(near_matrix, probe.estimates()[j].covariance, expected.covariance, 1e-9);
    }
    step(filter, scan);
  }
}

TEST(InteractingMultipleModel, APossibilisticLikelihoodEqualsTheRestatement) {
  const auto form = LikelihoodForm::possibility;
  equals_the_restatement<Interacting, Random>({Lift::zero, {}, Tie::stay, MixedStart::of_each_mode, form}, 110);
  equals_the_restatement<Interacting, Fuzzy>({Lift::zero, {}, Tie::stay, MixedStart::of_each_mode, form}, 110);
}

TEST(InteractingMultipleModel, WithoutTheSpreadOfTheMeansTheOutputIsThePrintedOne) {
  equals_the_restatement<Interacting, Random>({Lift::zero, {MixingWeights::correct, OutputSpread::omitted}, Tie::stay});
}

TEST(InteractingMultipleModel, AGateMakesAMissOfAMeasurementOutsideIt) {
  misses_what_is_outside_the_gate<Interacting, Random>();
  misses_what_is_outside_the_gate<Interacting, Fuzzy>();
}

TEST(InteractingMultipleModel, AFailedStepSaysWhichAndOfWhichModelAndLeavesTheStateAsItWas) {
  names_the_failed_step<Interacting, Random>();
  names_the_failed_step<Interacting, Fuzzy>();
}

TEST(InteractingMultipleModel, GoesOnFromARestoredStateToTheBit) {
  goes_on_from_a_restored_state<Interacting, Random>();
  goes_on_from_a_restored_state<Interacting, Fuzzy>();
}

TEST(InteractingMultipleModel, AFunctionOfTheStepGivesTheTransition) {
  takes_a_function_of_the_step<Interacting, Random>();
  takes_a_function_of_the_step<Interacting, Fuzzy>();
}

TEST(InteractingMultipleModel, OneModelOrEqualModelsAreTheKalmanFilterUnderEveryReading) {
  for (const std::size_t modes : {1U, 3U})
    for (const Lift lift : lifts) {
      is_the_kalman_filter<Interacting, Random>({lift, {MixingWeights::correct}, Tie::stay}, modes);
      is_the_kalman_filter<Interacting, Random>({lift, {MixingWeights::released}, Tie::stay}, modes);
      is_the_kalman_filter<Interacting, Random>({lift, {}, Tie::stay, MixedStart::common}, modes);
      for (const MixedCovariance reading : readings) {
        is_the_kalman_filter<Interacting, Fuzzy>({lift, {reading}, Tie::stay}, modes);
        is_the_kalman_filter<Interacting, Fuzzy>({lift, {reading}, Tie::stay, MixedStart::common}, modes);
      }
    }
}

TEST(InteractingMultipleModel, ATransitionThatIsTheIdentityNeverMixes) {
  never_mixes<Interacting, Random>({});
  for (const MixedCovariance reading :
       {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred})
    never_mixes<Interacting, Fuzzy>({Lift::zero, {reading}, Tie::stay});
}

TEST(InteractingMultipleModel, AnAllOnesTransitionRestartsAllFromTheWinner) {
  Filter<Interacting, Fuzzy> filter{VectorBank{calm(1.0), calm(5.0), calm(20.0)},
                                    transition_by<Fuzzy>({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), starts()[0],
                                    Interaction<Fuzzy>{Lift::zero, {MixedCovariance::selected}, Tie::stay}};
  std::size_t winners = 0;  // as bits
  for (const Scan& scan : manoeuvring_target()) {
    if (!scan.z) continue;
    const std::size_t winner = filter.most_likely_mode();
    const auto logs = filter.belief().logs();
    const bool alone = std::count_if(logs.begin(), logs.end(), [](double log) { return log > -1e-6; }) == 1;
    std::vector<State> expected;
    for (const Planar& model : filter.system().models()) {
      expected.emplace_back();
      predict(model, filter.estimates()[winner], scan.dt, expected.back());
    }
    Filter<Interacting, Fuzzy> probe = filter;
    probe.step(scan.dt);
    if (alone) {  // With a tie, each of the tied ones stays with itself.
      winners |= std::size_t{1} << winner;
      for (std::size_t j = 0; j < 3; ++j) {
        ASSERT_PRED_FORMAT3(near_matrix, probe.estimates()[j].mean, expected[j].mean, 1e-12);
        ASSERT_PRED_FORMAT3(near_matrix, probe.estimates()[j].covariance, expected[j].covariance, 1e-12);
        ASSERT_EQ(probe.belief().log(j), 0.0);
      }
    }
    step(filter, scan);
  }
  EXPECT_GT(std::popcount(winners), 1) << "not always the same model should win";
}

TEST(InteractingMultipleModel, PossibilitiesHaveTheMaximumOneAndProbabilitiesTheSumOneAtEveryStep) {
  stays_normalized<Interacting>();
}

TEST(InteractingMultipleModel, ScalingEveryLikelihoodChangesNoWeight) {
  holds([] {
    const double shift = number_between(-1e5, 1e5);
    const auto same = [shift](const auto& variable) {
      const Belief prior =
          compose(transition_by<typename std::decay_t<decltype(variable)>::kind>({{1.0}}),
                  Belief{uninformative(Variable<typename std::decay_t<decltype(variable)>::kind>{"motion", 1})});
      RC_ASSERT(prior.log(0) == 0.0);
      Likelihood likelihood{variable}, scaled{variable};
      for (std::size_t j = 0; j < variable.size(); ++j) {
        const double log = number_between(-50.0, 50.0);
        likelihood.set_log(j, log);
        scaled.set_log(j, log + shift);
      }
      const Belief before{uninformative(variable)};
      const auto plain = update(before, likelihood), shifted = update(before, scaled);
      require_near(shifted.logs(), plain.logs(), 1e-9);
    };
    same(random_motion);
    same(fuzzy_motion);
  });
}

TEST(InteractingMultipleModel, RelabellingTheModelsChangesNothing) {
  for (const Lift lift : {Lift::borrowed_variance, Lift::unbiased}) {
    relabelling<Interacting, Random>({lift, {}, Tie::stay});
    for (const MixedCovariance reading :
         {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred})
      relabelling<Interacting, Fuzzy>({lift, {reading}, Tie::stay});
  }
}

/// A step of no duration shows the mixed starts: nothing moves, and DWNA adds no noise.
TEST(InteractingMultipleModel, MixingPreservesTheMixturesFirstTwoMoments) {
  holds([] {
    std::vector<State> start;
    for (int j = 0; j < 3; ++j) {
      const auto state = support::generated_gaussian<4>();
      start.push_back({state.mean, state.covariance});
    }
    Filter<Interacting, Random> filter{VectorBank{calm(1.0), calm(2.0), calm(3.0)}, random_transition, start};
    for (int k = 0; k < 3; ++k) {
      const auto before = filter.estimate();
      filter.step(0.0);
      require_near_matrix(filter.estimate().mean, before.mean, 1e-11);
      require_near_matrix(filter.estimate().covariance, before.covariance, 1e-11);
    }
  });
}

TEST(InteractingMultipleModel, WhatHimmPutsOutIsExactlyOneFiltersEstimate) {
  for (const MixedCovariance reading : readings) {
    auto filter = vector_filter<Interacting, Fuzzy>({Lift::zero, {reading}, Tie::stay});
    for (const Scan& scan : manoeuvring_target()) {
      step(filter, scan);
      const State& winner = filter.estimates()[filter.most_likely_mode()];
      const auto n = winner.size();
      const auto output = filter.estimate();
      ASSERT_EQ(output.mean.head(n), winner.mean);
      ASSERT_EQ(output.covariance.topLeftCorner(n, n), winner.covariance);
      ASSERT_EQ(output.mean, filter.most_likely_estimate().mean);
    }
  }
}

TEST(InteractingMultipleModel, TheMostLikelyEstimateOfAnImmIsOneFiltersToo) {
  auto filter = vector_filter<Interacting, Random>();
  for (const Scan& scan : manoeuvring_target(100)) {
    step(filter, scan);
    const State& winner = filter.estimates()[filter.most_likely_mode()];
    const auto output = filter.most_likely_estimate();
    ASSERT_EQ(output.mean.head(winner.size()), winner.mean);
    ASSERT_EQ(output.covariance.topLeftCorner(winner.size(), winner.size()), winner.covariance);
  }
}

TEST(InteractingMultipleModel, CovariancesStaySymmetricAndPositive) {
  for (const Lift lift : lifts) {
    stays_positive<Interacting, Random>({lift, {MixingWeights::correct}, Tie::stay});
    stays_positive<Interacting, Random>({lift, {MixingWeights::released}, Tie::stay});
    for (const MixedCovariance reading : readings) stays_positive<Interacting, Fuzzy>({lift, {reading}, Tie::stay});
  }
}

TEST(InteractingMultipleModel, ImmSurvivesAnOutlierAMillionDeviationsAway) {
  survives_an_outlier<Interacting, Random>();
}
TEST(InteractingMultipleModel, HimmSurvivesAnOutlierAMillionDeviationsAway) {
  survives_an_outlier<Interacting, Fuzzy>();
}

TEST(InteractingMultipleModel, AnUnreachableModeKeepsItsOwnStateWithTheWeightZero) {
  for (const Lift lift : lifts) {
    survives_an_unreachable_mode<Interacting, Random>({lift, {}, Tie::stay});
    for (const MixedCovariance reading : readings)
      survives_an_unreachable_mode<Interacting, Fuzzy>({lift, {reading}, Tie::stay});
  }
}

TEST(InteractingMultipleModel, RefusesWhatIsNotFiniteAndStepsBackAndIsThenUnchanged) {
  refusals<Interacting, Random>();
  refusals<Interacting, Fuzzy>();
}

TEST(InteractingMultipleModel, RefusesAStartThatDoesNotFit) {
  const VectorBank models{calm(), calm(), turning()};
  const auto build = [&](const std::vector<State>& start) {
    Filter<Interacting, Fuzzy>{models, fuzzy_transition, start};
  };
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build({starts()[0], starts()[1]}); }, {"3 models", "2 starts"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        build({starts()[0], starts()[1], starts()[0]});
      },
      {"start of model 'dwpa'", "4", "expected 6"}));
  auto bad = starts();
  bad[1].covariance(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(throws<std::invalid_argument>([&] { build(bad); }, {"start of model 'dwna'", "not finite"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { Filter<Interacting, Fuzzy>(models, fuzzy_transition, starts()[0]); },
                                            {"start has 4", "6"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        Filter<Interacting, Fuzzy>(VectorBank{calm(), turning()}, fuzzy_transition, starts()[2]);
      },
      {"3 outcomes", "2 models"}));
}

TEST(InteractingMultipleModel, OneStartServesAllModels) {
  const State start = starts()[2];
  const InteractingMultipleModel filter{VectorBank{calm(), calm(), turning()}, fuzzy_transition, start};
  EXPECT_EQ(filter.components(), (std::vector<std::string>{"x", "y", "vx", "vy", "ax", "ay"}));
  EXPECT_EQ(filter.estimates()[0].mean, start.mean.head(4));
  EXPECT_EQ(filter.estimates()[0].covariance, start.covariance.topLeftCorner(4, 4));
  EXPECT_EQ(filter.estimates()[2].mean, start.mean);
  EXPECT_EQ(filter.estimates()[2].covariance, start.covariance);
  EXPECT_EQ(filter.modes(), 3U);
  EXPECT_EQ(filter.most_likely_mode(), 0U);
  EXPECT_FALSE(filter.measured());
}

TEST(InteractingMultipleModel, ThereIsNoNisWithoutAMeasurement) {
  auto filter = vector_filter<Interacting, Random>();
  EXPECT_TRUE(throws<std::logic_error>([&] { filter.nis(); }, {"without a measurement"}));
  filter.step(0.2, *manoeuvring_target(1)[0].z);
  EXPECT_TRUE(filter.measured());
  EXPECT_TRUE(std::isfinite(filter.nis()));
  filter.step(0.2);
  EXPECT_FALSE(filter.measured());
  EXPECT_TRUE(throws<std::logic_error>([&] { filter.nis(); }, {"without a measurement"}));
}

}  // namespace
}  // namespace sigmax
