#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include "hybrid/banks.hpp"

namespace {

/// What HIMM does before the measurement, the Viterbi filter does after it.
TEST(SecondOrderMultipleModel, WithoutMeasurementsTheViterbiFilterIsHimmWithTheSelectedCovariance) {
  TargetChoice choice = chosen(true);
  choice.mixed_covariance = MixedCovariance::selected;
  AnyFilter himm(choice), viterbi(chosen(true, Scheme::second_order));
  for (int k = 0; k < 10; ++k) {
    himm.step(0.2);
    viterbi.step(0.2);
    ASSERT_PRED_FORMAT3(same_state, himm, viterbi, 1e-12);
  }
}

}  // namespace
