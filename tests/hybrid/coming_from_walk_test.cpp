// The code of docs/coming_from.md. The expected numbers are those of a plain Python restatement of what the other
// libraries compute.

#include "support/sigmax.hpp"

namespace coming_from_walk_test {

TEST(ComingFrom, FilterPy) {
  const RandomVariable mode{"mode", {"quiet", "lively"}};
  const Relation M{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}};
  const Gaussian<2> start{Vector<2>(0.0, 10.0), 100.0 * SquareMatrix<2>::Identity()};
  InteractingMultipleModel imm{std::tuple{dwna<1>(0.1), dwna<1>(5.0)}, M, start};
  for (const double z : {11.0, 19.0, 32.0, 47.0, 70.0}) imm.step(1.0, {Vector<1>(z), SquareMatrix<1>(25.0)});
  const auto estimate = imm.estimate();   // imm.x is estimate.mean, imm.P is estimate.covariance
  const double lively = imm.belief()[1];  // imm.mu[1]

  EXPECT_CLOSE(estimate.mean(0), 66.06985757636292, 1e-9);
  EXPECT_CLOSE(estimate.mean(1), 16.878838001983162, 1e-9);
  EXPECT_CLOSE(estimate.covariance(0, 0), 18.54416175174824, 1e-9);
  EXPECT_CLOSE(estimate.covariance(1, 1), 19.8059510995619, 1e-9);
  EXPECT_CLOSE(lively, 0.5758700783268191, 1e-9);
}

TEST(ComingFrom, StoneSoup) {
  const auto motion = cwna<2>(std::sqrt(0.05));     // q of ConstantVelocity on both axes
  Gaussian<4> track{Vector<4>(0.0, 0.0, 1.0, 1.0),  // x, y, vx, vy; theirs is x, vx, y, vy
                    Vector<4>(1.5, 1.5, 0.5, 0.5).asDiagonal().toDenseMatrix()};
  const Gaussian<2> detection{Vector<2>(1.2, 0.9), 5.0 * SquareMatrix<2>::Identity()};
  predict(motion, track, 1.0, track);                               // predictor.predict(prior, timestamp)
  const auto innovation = update(motion, track, detection, track);  // updater.update(hypothesis)

  EXPECT_CLOSE(track.mean(0), 1.057482185273159, 1e-9);
  EXPECT_CLOSE(track.mean(1), 0.9712589073634205, 1e-9);
  EXPECT_CLOSE(track.mean(2), 1.0149643705463183, 1e-9);
  EXPECT_CLOSE(track.mean(3), 0.9925178147268409, 1e-9);
  EXPECT_CLOSE(track.covariance(0, 0), 1.4370546318289785, 1e-9);
  EXPECT_CLOSE(track.covariance(0, 2), 0.37410926365795727, 1e-9);
  EXPECT_CLOSE(track.covariance(2, 2), 0.5107185273159145, 1e-9);
  EXPECT_CLOSE(std::exp(innovation.log_likelihood), 0.150178149655791 * 0.1504995389868124, 1e-9);
}

TEST(ComingFrom, Matlab) {
  const RandomVariable mode{"mode", {"constvel", "constacc"}};  // FuzzyVariable, and rows of maximum 1: the HIMM
  const Relation transition{mode, mode, {{0.9, 0.1}, {0.1, 0.9}}};
  const Gaussian<3> start{Vector<3>(0.0, 10.0, 0.0), 100.0 * SquareMatrix<3>::Identity()};
  Interaction<Random> interaction;
  interaction.augmentation = StateAugmentation::zero;
  InteractingMultipleModel imm{std::tuple{dwna<1>(1.0), dwpa<1>(1.0)}, transition, start, interaction};
  for (const double z : {11.0, 19.0, 32.0, 47.0, 70.0}) imm.step(1.0, {Vector<1>(z), SquareMatrix<1>(25.0)});
  const auto estimate = imm.estimate();      // State and StateCovariance, always in the components of all models
  const auto constvel = imm.estimates()[0];  // TrackingFilters{1}.State has two components

  EXPECT_EQ(constvel.size(), 2);
  EXPECT_CLOSE(estimate.mean(0), 66.5647979770865, 1e-9);
  EXPECT_CLOSE(estimate.mean(1), 17.655919252778695, 1e-9);
  EXPECT_CLOSE(estimate.mean(2), 1.366032270246131, 1e-9);
  EXPECT_CLOSE(estimate.covariance(2, 2), 3.965376629289377, 1e-9);
  EXPECT_CLOSE(imm.belief()[1], 0.49937164364545467, 1e-9);
}

}  // namespace coming_from_walk_test
