#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>

#include "hybrid/banks.hpp"

namespace sigmax {
namespace {

using support::near_matrix;

using Turn = CoordinatedTurn<2>;
using Moves = AnyMotion<7, IndependentAxes<2, DiscreteWhiteNoise<2>>, IndependentAxes<2, DiscreteWhiteNoise<3>>, Turn>;
using Any = AnyMember<Moves>;

/// A bank whose models are named at run time against the same bank known to the compiler; the models differ in their
/// components, and no one has all of them.
template <Uncertainty Kind>
void expect_the_tuple_bank(const Relation<Kind, Kind>& transition) {
  const Turn turn(1.0, 1e-4);
  const std::tuple models{dwna<2>(1.0), dwpa<2>(4.0), Unscented{turn}};
  const Gaussian<7> start{Vector<7>(12000.0, 8000.0, -100.0, -100.0, 0.0, 0.0, 0.01),
                          SquareMatrix<7>(Vector<7>(100, 100, 100, 100, 25, 25, 1e-3).asDiagonal())};
  InteractingMultipleModel fixed{models, transition, start};
  InteractingMultipleModel any{
      std::vector<Any>{Extended<Moves>{dwna<2>(1.0)}, Cubature<Moves>{dwpa<2>(4.0)}, Unscented<Moves>{turn}},
      transition, start};
  ASSERT_EQ(any.components(), fixed.components());
  ASSERT_EQ(any.components().size(), 7U);
  for (const auto& scan : support::manoeuvring_target(120)) {
    if (scan.z) {
      fixed.step(scan.dt, *scan.z);
      any.step(scan.dt, *scan.z);
    } else {
      fixed.step(scan.dt);
      any.step(scan.dt);
    }
    ASSERT_PRED_FORMAT3(near_matrix, any.estimate().mean, fixed.estimate().mean, 1e-9);
    ASSERT_PRED_FORMAT3(near_matrix, any.estimate().covariance, fixed.estimate().covariance, 1e-9);
    for (std::size_t j = 0; j < 3; ++j) ASSERT_NEAR(any.belief()[j], fixed.belief()[j], 1e-9);
  }
}

TEST(AnyMemberBank, IsTheBankThatTheCompilerKnows) {
  const RandomVariable random{"mode", 3};
  expect_the_tuple_bank(Relation{random, random, {{0.9, 0.05, 0.05}, {0.1, 0.8, 0.1}, {0.05, 0.05, 0.9}}});
  const FuzzyVariable fuzzy{"mode", 3};
  expect_the_tuple_bank(Relation{fuzzy, fuzzy, {{1.0, 0.5, 0.3}, {0.5, 1.0, 0.5}, {0.2, 0.5, 1.0}}});
}

}  // namespace
}  // namespace sigmax
