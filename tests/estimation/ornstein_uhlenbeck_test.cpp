#include "estimation/motion_laws.hpp"

namespace ornstein_uhlenbeck_test {

/// A θ that makes u = θT anything between 10⁻⁹ and 100, for steps up to 10 s.
double generated_rate() { return std::pow(10.0, number_between(-6.0, 1.0)); }

PROPERTY(OrnsteinUhlenbeck, IsTheIntegral) {
  const double theta = number_between(0.01, 2.0), sigma = number_between(0.5, 3.0), dt = number_between(0.1, 2.0);
  const double q = 2.0 * theta * sigma * sigma;
  require_integral({1, 1, {-theta}}, {1, 1, {q}}, ou_position<1>(theta, sigma), dt);
  require_integral({2, 2, {0, 1, 0, -theta}}, {2, 2, {0, 0, 0, q}}, ou_velocity<1>(theta, sigma), dt);
  require_integral({3, 3, {0, 1, 0, 0, 0, 1, 0, 0, -theta}}, {3, 3, {0, 0, 0, 0, 0, 0, 0, 0, q}},
                   singer<1>(theta, sigma), dt);
}

PROPERTY(OrnsteinUhlenbeck, StepsAddUpForAnyRate) {
  const double theta = generated_rate(), sigma = number_between(0.5, 3.0);
  const double s = generated_step(), t = generated_step();
  const Vector<2> level(2.0, -1.0);
  require_steps_to_add_up(ou_position<2>(theta, sigma, level), s, t);
  require_steps_to_add_up(ou_velocity<2>(theta, sigma, level), s, t);
  require_steps_to_add_up(IndependentAxes<2, OrnsteinUhlenbeck<3>>{OrnsteinUhlenbeck<3>{theta, sigma}, level}, s, t);
}

PROPERTY(OrnsteinUhlenbeck, ASlowOneIsAWienerProcess) {
  const double theta = 1e-14, q = number_between(0.1, 5.0), dt = number_between(0.1, 3.0);
  const double sigma = std::sqrt(0.5 * q / theta);
  require_near(singer<2>(theta, sigma).transition(dt), cwpa<2>(std::sqrt(q)).transition(dt), 1e-12);
  require_near_covariance(singer<2>(theta, sigma).process_covariance(dt), cwpa<2>(std::sqrt(q)).process_covariance(dt),
                          1e-12);
  require_near_covariance(ou_velocity<2>(theta, sigma).process_covariance(dt),
                          cwna<2>(std::sqrt(q)).process_covariance(dt), 1e-12);
}

TEST(OrnsteinUhlenbeck, InTheLongRunItForgetsAndKeepsItsDeviation) {
  const Gaussian<4> start{Vector<4>(0.0, 0.0, 100.0, 100.0), 50.0 * SquareMatrix<4>::Identity()};
  const auto late = predict(ou_velocity<2>(2.0, 3.0, Vector<2>(5.0, -7.0)), start, 1000.0);
  EXPECT_CLOSE(late.mean.tail<2>(), (Vector<2>(5.0, -7.0)), 1e-14);
  EXPECT_CLOSE((late.covariance.bottomRightCorner<2, 2>()), (SquareMatrix<2>{{9, 0}, {0, 9}}), 1e-14);
}

TEST(OrnsteinUhlenbeck, AStepOfNoTimeIsNone) {
  EXPECT_EQ(singer<3>(0.5, 2.0).transition(0.0), SquareMatrix<9>::Identity());
  EXPECT_EQ(singer<3>(0.5, 2.0).process_covariance(0.0), SquareMatrix<9>::Zero());
}

}  // namespace ornstein_uhlenbeck_test
