#include "estimation/motion_laws.hpp"

namespace known_turn_test {

static_assert(LinearMotion<KnownTurn<2>> && axes_of<KnownTurn<2>> == 2);
static_assert(LinearMotion<KnownTurn<3>> && axes_of<KnownTurn<3>> == 3);

PROPERTY(KnownTurn, IsTheIntegral) {
  const double w = number_between(-2.0, 2.0), sigma = number_between(0.1, 5.0), dt = number_between(0.1, 3.0);
  restatement::Matrix A(6, 6), D(6, 6);
  for (std::size_t i = 0; i < 3; ++i) A(i, 3 + i) = 1.0;
  for (std::size_t i = 3; i < 6; ++i) D(i, i) = sigma * sigma;
  A(3, 4) = -w;
  A(4, 3) = w;
  require_integral(A, D, KnownTurn<3>{w, sigma}, dt);
}

PROPERTY(KnownTurn, StepsAddUpForAnyRate) {
  const double w = std::pow(10.0, number_between(-9.0, 0.5));
  require_steps_to_add_up(KnownTurn<2>{w, 2.0}, generated_step(), generated_step());
  require_steps_to_add_up(KnownTurn<3>{-w, 2.0}, generated_step(), generated_step());
}

PROPERTY(KnownTurn, WithoutARateItIsWhiteNoiseAcceleration) {
  const double sigma = number_between(0.1, 5.0), dt = number_between(0.0, 3.0);
  for (const double w : {0.0, 1e-14}) {
    require_near(KnownTurn<3>(w, sigma).transition(dt), cwna<3>(sigma).transition(dt), 1e-12);
    require_near(KnownTurn<3>(w, sigma).process_covariance(dt), cwna<3>(sigma).process_covariance(dt), 1e-12);
  }
}

}  // namespace known_turn_test
