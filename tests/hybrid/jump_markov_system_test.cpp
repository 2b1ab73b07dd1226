#include "support/sigmax.hpp"

namespace jump_markov_system_test {

const FuzzyVariable mode_now{"mode", {"straight", "turn"}};
const Relation persistent{mode_now, mode_now, {{1.0, 0.5}, {0.5, 1.0}}};

using System = JumpMarkovSystem<Fuzzy>;
using Models = std::tuple<IndependentAxes<3, DiscreteWhiteNoise<2>>>;

template <class Kind>
concept CanBeAMode = requires {
  typename InteractingMultipleModel<Models, Kind>;
}
|| requires { typename SecondOrderMultipleModel<Models, Kind>; }
|| requires { typename HistoryFilter<Models, Kind>; }
|| requires { typename FilterBank<Models, Kind>; }
|| requires { typename JumpMarkovSystem<Kind>; };
static_assert(CanBeAMode<Random> && CanBeAMode<Fuzzy>);
static_assert(!CanBeAMode<Ordinal>, "weights of modes are divided: refused by the constraint, not inside");

TEST(JumpMarkovSystem, HoldsModelsAndTheTransitionOfTheirMode) {
  const System system{{dwna<3>(1.0), dwpa<3>(2.0)}, persistent};
  EXPECT_EQ(system.mode_variable().name(), "mode");
  EXPECT_EQ(system.transition()(0, 1), 0.5);
  EXPECT_EQ(system.models()[1].name(), "dwpa");
}

TEST(JumpMarkovSystem, NeedsOneOutcomeForEachModel) {
  EXPECT_INVALID(("'mode'", "2 outcomes", "1 models"), System({dwna<3>(1.0)}, persistent));
  EXPECT_INVALID(("'mode'", "2 outcomes", "0 models"), System({}, persistent));
}

TEST(JumpMarkovSystem, NeedsATransitionFromTheModeToItself) {
  const FuzzyVariable weather{"weather", {"fair", "foul"}};
  EXPECT_REFUSED(std::invalid_argument, ("JumpMarkovSystem", "weather", "mode"),
                 System({dwna<3>(1.0), dwpa<3>(1.0)}, Relation{mode_now, weather, {{1.0, 0.5}, {0.5, 1.0}}}));
}

/// Gives the same row whatever it was asked before, and counts how often it is.
struct ByStep {
  using kind = Fuzzy;
  std::shared_ptr<int> asked = std::make_shared<int>(0);

  Relation<Fuzzy, Fuzzy> operator()(double dt) const {
    ++*asked;
    return {mode_now, mode_now, {{1.0, dt / 10.0}, {dt / 10.0, 1.0}}};
  }
};

TEST(ModeTransition, OfAFunctionIsComputedOnlyIfTheStepChanged) {
  const ByStep by_step;
  ModeTransition<Fuzzy> transition(by_step);
  EXPECT_EQ(transition.last()(0, 1), 0.0);
  const int before = *by_step.asked;
  EXPECT_EQ(transition.over(0.0)(0, 1), 0.0);
  EXPECT_EQ(*by_step.asked, before);
  EXPECT_EQ(transition.over(2.0)(0, 1), 0.2);
  EXPECT_EQ(transition.over(2.0)(0, 1), 0.2);
  EXPECT_EQ(transition.last()(0, 1), 0.2);
  EXPECT_EQ(*by_step.asked, before + 1);
  EXPECT_EQ(transition.over(0.0)(0, 1), 0.0) << "back to what it was before the first step";
  EXPECT_EQ(*by_step.asked, before + 2);
}

TEST(ModeTransition, OfARelationServesEveryStep) {
  ModeTransition<Fuzzy> transition(persistent);
  EXPECT_EQ(transition.over(7.0)(0, 1), 0.5);
  EXPECT_EQ(transition.last()(1, 1), 1.0);
}

TEST(Identity, IsTheTransitionOfAModeThatNeverChanges) {
  const auto never = identity(mode_now);
  EXPECT_EQ(never(0, 0), 1.0);
  EXPECT_EQ(never(0, 1), 0.0);
}

}  // namespace jump_markov_system_test
