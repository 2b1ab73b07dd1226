#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include <gtest/gtest.h>

#include "hybrid/laws.hpp"

namespace sigmax {

template class SecondOrderMultipleModel<VectorBank, Random>;
template class SecondOrderMultipleModel<VectorBank, Fuzzy>;
template class SecondOrderMultipleModel<TupleBank, Random>;
template class SecondOrderMultipleModel<TupleBank, Fuzzy>;

namespace {

using namespace support;
using support::ties;  // not those of a logarithm

TEST(SecondOrderMultipleModel, Gpb2EqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<SecondOrder, Random>({lift, {}, Tie::stay});
}

TEST(SecondOrderMultipleModel, TheViterbiFilterEqualsTheRestatementUnderEachLift) {
  for (const Lift lift : lifts) equals_the_restatement<SecondOrder, Fuzzy>({lift, {}, Tie::stay});
}

TEST(SecondOrderMultipleModel, TheViterbiFilterEqualsTheRestatementUnderEachTieRule) {
  for (const Tie mixing : ties)
    for (const Tie output : ties)
      equals_the_restatement<SecondOrder, Fuzzy>({Lift::zero, {MixedCovariance::selected, mixing}, output}, 120);
}

TEST(SecondOrderMultipleModel, AnyGpb2EqualsTheRestatement) {
  holds([] {
    generated_filters<SecondOrder, Random>(
        {*rc::gen::elementOf(std::vector(lifts)),
         {MixingWeights::correct, *rc::gen::element(OutputSpread::included, OutputSpread::omitted)},
         *rc::gen::elementOf(std::vector(ties)),
         MixedStart::of_each_mode,
         *rc::gen::element(LikelihoodForm::density, LikelihoodForm::possibility)});
  });
}

TEST(SecondOrderMultipleModel, AnyViterbiFilterEqualsTheRestatement) {
  holds([] {
    generated_filters<SecondOrder, Fuzzy>({*rc::gen::elementOf(std::vector(lifts)),
                                           {MixedCovariance::selected, *rc::gen::elementOf(std::vector(ties))},
                                           *rc::gen::elementOf(std::vector(ties)),
                                           MixedStart::of_each_mode,
                                           *rc::gen::element(LikelihoodForm::density, LikelihoodForm::possibility)});
  });
}

TEST(SecondOrderMultipleModel, OneModelOrEqualModelsAreTheKalmanFilter) {
  for (const std::size_t modes : {1U, 3U}) {
    is_the_kalman_filter<SecondOrder, Random>({}, modes);
    is_the_kalman_filter<SecondOrder, Fuzzy>({}, modes);
  }
}

TEST(SecondOrderMultipleModel, ATransitionThatIsTheIdentityNeverMixes) {
  never_mixes<SecondOrder, Random>({});
  never_mixes<SecondOrder, Fuzzy>({});
}

TEST(SecondOrderMultipleModel, PossibilitiesHaveTheMaximumOneAndProbabilitiesTheSumOneAtEveryStep) {
  stays_normalized<SecondOrder>();
}

TEST(SecondOrderMultipleModel, RelabellingTheModelsChangesNothing) {
  for (const Lift lift : {Lift::borrowed_variance, Lift::unbiased}) {
    relabelling<SecondOrder, Random>({lift, {}, Tie::stay});
    relabelling<SecondOrder, Fuzzy>({lift, {}, Tie::stay});
  }
}

TEST(SecondOrderMultipleModel, CovariancesStaySymmetricAndPositive) {
  for (const Lift lift : lifts) {
    stays_positive<SecondOrder, Random>({lift, {}, Tie::stay});
    stays_positive<SecondOrder, Fuzzy>({lift, {}, Tie::stay});
  }
}

TEST(SecondOrderMultipleModel, SurvivesAnOutlierAMillionDeviationsAway) {
  survives_an_outlier<SecondOrder, Random>();
  survives_an_outlier<SecondOrder, Fuzzy>();
}

TEST(SecondOrderMultipleModel, AnUnreachableModeKeepsItsOwnStateWithTheWeightZero) {
  for (const Lift lift : lifts) {
    survives_an_unreachable_mode<SecondOrder, Random>({lift, {}, Tie::stay});
    survives_an_unreachable_mode<SecondOrder, Fuzzy>({lift, {}, Tie::stay});
  }
}

TEST(SecondOrderMultipleModel, RefusesWhatIsNotFiniteAndStepsBackAndIsThenUnchanged) {
  refusals<SecondOrder, Random>();
  refusals<SecondOrder, Fuzzy>();
}

TEST(SecondOrderMultipleModel, AGateMakesAMissOfAMeasurementOutsideIt) {
  misses_what_is_outside_the_gate<SecondOrder, Random>();
  misses_what_is_outside_the_gate<SecondOrder, Fuzzy>();
}

TEST(SecondOrderMultipleModel, AFailedStepSaysWhichAndOfWhichModelAndLeavesTheStateAsItWas) {
  names_the_failed_step<SecondOrder, Random>();
  names_the_failed_step<SecondOrder, Fuzzy>();
}

TEST(SecondOrderMultipleModel, GoesOnFromARestoredStateToTheBit) {
  goes_on_from_a_restored_state<SecondOrder, Random>();
  goes_on_from_a_restored_state<SecondOrder, Fuzzy>();
}

TEST(SecondOrderMultipleModel, AFunctionOfTheStepGivesTheTransition) {
  takes_a_function_of_the_step<SecondOrder, Random>();
  takes_a_function_of_the_step<SecondOrder, Fuzzy>();
}

/// What HIMM does before the measurement, the Viterbi filter does after it.
TEST(SecondOrderMultipleModel, WithoutMeasurementsTheViterbiFilterIsHimmWithTheSelectedCovariance) {
  const Interaction<Fuzzy> interaction{Lift::borrowed_variance, {MixedCovariance::selected}, Tie::stay};
  auto himm = vector_filter<Interacting, Fuzzy>(interaction);
  auto viterbi = vector_filter<SecondOrder, Fuzzy>(interaction);
  for (int k = 0; k < 10; ++k) {
    himm.step(0.2);
    viterbi.step(0.2);
    for (std::size_t j = 0; j < 3; ++j) {
      ASSERT_EQ(himm.belief().log(j), viterbi.belief().log(j));
      require_near_matrix(himm.estimates()[j].mean, viterbi.estimates()[j].mean, 1e-12);
      require_near_matrix(himm.estimates()[j].covariance, viterbi.estimates()[j].covariance, 1e-12);
    }
  }
}

}  // namespace
}  // namespace sigmax
