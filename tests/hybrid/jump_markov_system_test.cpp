#include <sigmax/hybrid/jump_markov_system.hpp>

#include <gtest/gtest.h>

#include <tuple>

#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/hybrid/filter_bank.hpp>
#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/history_filter.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

const FuzzyVariable mode_now{"mode", {"straight", "turn"}};
const Relation persistent{mode_now, mode_now, {{1.0, 0.5}, {0.5, 1.0}}};

using Models = std::tuple<IndependentAxes<3, DiscreteWhiteNoise<2>>>;

template <class Kind>
concept CanBeAMode = requires {
  typename InteractingMultipleModel<Models, Kind>;
}
|| requires { typename SecondOrderMultipleModel<Models, Kind>; }
|| requires { typename HistoryFilter<Models, Kind>; }
|| requires { typename FilterBank<Models, Kind>; }
|| requires { typename FixedIntervalSmoother<Models, Kind>; }
|| requires { typename JumpMarkovSystem<Models, Kind>; };
static_assert(CanBeAMode<Random> && CanBeAMode<Fuzzy>);
static_assert(!CanBeAMode<Ordinal>, "weights of modes are divided: refused by the constraint, not inside");

TEST(JumpMarkovSystem, HoldsModelsAndTheTransitionOfTheirMode) {
  const JumpMarkovSystem system{std::tuple{dwna<3>(1.0), dwpa<3>(2.0)}, persistent};
  EXPECT_EQ(system.mode_variable().name(), "mode");
  EXPECT_EQ(system.transition()(0, 1), 0.5);
  EXPECT_EQ(std::get<1>(system.models()).law().sigma_w(), 2.0);
}

TEST(JumpMarkovSystem, NeedsOneOutcomeForEachModel) {
  EXPECT_TRUE(throws<std::invalid_argument>([] { JumpMarkovSystem(std::tuple{dwna<3>(1.0)}, persistent); },
                                            {"'mode'", "2 outcomes", "1 models"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] { JumpMarkovSystem(std::vector<IndependentAxes<3, DiscreteWhiteNoise<2>>>{}, persistent); },
      {"'mode'", "2 outcomes", "0 models"}));
}

TEST(JumpMarkovSystem, NeedsATransitionFromTheModeToItself) {
  const FuzzyVariable weather{"weather", {"fair", "foul"}};
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        JumpMarkovSystem(std::tuple{dwna<3>(1.0), dwpa<3>(1.0)}, Relation{mode_now, weather, {{1.0, 0.5}, {0.5, 1.0}}});
      },
      {"JumpMarkovSystem", "weather", "mode"}));
}

TEST(JumpMarkovSystem, ARowThatIsNoDistributionIsRefusedByTheRelation) {
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] {
        Relation(mode_now, mode_now, {{1.0, 0.5}, {0.5, 0.9}});
      },
      {"mode", "turn"}));
  const RandomVariable random_mode{"mode", {"straight", "turn"}};
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        Relation(random_mode, random_mode, {{0.9, 0.2}, {0.5, 0.5}});
      },
      {"mode", "straight"}));
}

}  // namespace
}  // namespace sigmax
