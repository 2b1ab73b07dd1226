// The code of docs/extending.md, "A kind of variable": a kind that the library does not have works in all of core.

#include "support/core.hpp"

namespace kind_walk_test {

/// Between Sigma (p = 1) and Max (p = ∞): alternatives add up as the sides of a right angle.
struct Euclid {
  static constexpr bool selective = false;
  static constexpr double zero() { return 0.0; }
  static constexpr double one() { return 1.0; }
  static double plus(double a, double b) { return std::hypot(a, b); }
  static constexpr double times(double a, double b) { return a * b; }
  static constexpr double divide(double a, double b) { return a / b; }
};

struct Amplitude {
  using Algebra = Euclid;
  static constexpr std::string_view name = "amplitude";
  static constexpr std::string_view measure = "amplitude";
  static constexpr std::string_view total = "length";
};

static_assert(Uncertainty<Amplitude> && ScalingAlgebra<Euclid> && !SelectiveAlgebra<Euclid>);
static_assert(!std::is_constructible_v<Relation<Amplitude, Amplitude>, FuzzyVariable, Variable<Amplitude>, Table>);

TEST(KindWalk, ANewKindIsTwoStructs) {
  const Variable<Amplitude> x{"x", 2};
  const Relation turn{x, x, {{0.6, 0.8}, {0.8, 0.6}}};  // each row of length one
  const Distribution p = update(compose(turn, Distribution{x, {0.6, 0.8}}), Likelihood{x, {1.0, 0.5}});
  EXPECT_NEAR(std::hypot(p[0], p[1]), 1.0, 1e-15);
  EXPECT_NEAR(p[1] / p[0], 0.5 * std::hypot(0.8 * 0.6, 0.6 * 0.8) / std::hypot(0.6 * 0.6, 0.8 * 0.8), 1e-15);
  Belief belief{p};
  update(belief, Likelihood{x, {0.5, 1.0}}, belief);
  EXPECT_NEAR(std::hypot(belief[0], belief[1]), 1.0, 1e-15);
  EXPECT_NEAR(compose(turn, Chain{uninformative(x)}).log_total(), 0.0, 1e-14);
  EXPECT_NEAR(uninformative(x)[0], std::sqrt(0.5), 1e-15);
}

}  // namespace kind_walk_test
