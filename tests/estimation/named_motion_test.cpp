#include <sigmax/estimation/named_motion.hpp>

#include <gtest/gtest.h>

#include <vector>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/known_turn.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/white_noise.hpp>

#include "estimation/restated.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using detail::NamedMotion;
using namespace support;
using Type = NamedMotion::Type;

/// A motion's name, its numbers, and the class that has the axes in its type.
struct Row {
  const char* name;
  NamedMotion named;
  AnyModel typed;
};

template <int Axes>
void expect_along_axes() {
  std::vector<Row> all{{"dwna", {Type::discrete_white_noise, 2, Axes, 3.0, 0.0}, dwna<Axes>(3.0)},
                       {"dwpa", {Type::discrete_white_noise, 3, Axes, 2.0, 0.0}, dwpa<Axes>(2.0)},
                       {"cwna", {Type::white_noise, 2, Axes, 1.5, 0.0}, cwna<Axes>(1.5)},
                       {"cwpa", {Type::white_noise, 3, Axes, 0.5, 0.0}, cwpa<Axes>(0.5)},
                       {"ou_position", {Type::ornstein_uhlenbeck, 1, Axes, 0.3, 2.0}, ou_position<Axes>(0.3, 2.0)},
                       {"ou_velocity", {Type::ornstein_uhlenbeck, 2, Axes, 0.2, 3.0}, ou_velocity<Axes>(0.2, 3.0)},
                       {"singer", {Type::ornstein_uhlenbeck, 3, Axes, 0.1, 4.0}, singer<Axes>(0.1, 4.0)}};
  if constexpr (Axes > 1) {
    const NamedMotion turn{Type::coordinated_turn, 2, Axes, 2.0, 0.1};
    const CoordinatedTurn<Axes> typed{2.0, 0.1};
    all.push_back({"known_turn", {Type::known_turn, 2, Axes, 0.2, 1.5}, KnownTurn<Axes>{0.2, 1.5}});
    EXPECT_EQ(typed.name(), "coordinated_turn");
    EXPECT_EQ(typed.components().back(), "omega");
    expect_the_same(AnyModel{Extended{turn}}, AnyModel{Extended{typed}});
    expect_the_same(AnyModel{Unscented{turn}}, AnyModel{Unscented{typed}});
    expect_the_same(AnyModel{Cubature{turn}}, AnyModel{Cubature{typed}});
  }
  for (const auto& [name, named, typed] : all) {
    EXPECT_EQ(typed.name(), name);
    EXPECT_EQ(AnyModel{named}.axes(), Axes);
    expect_the_same(AnyModel{named}, typed);
    expect_the_same(AnyModel{Cubature{named}}, typed);
  }
}

TEST(NamedMotion, HasTheNumbersOfItsClass) {
  expect_along_axes<1>();
  expect_along_axes<2>();
  expect_along_axes<3>();
}

TEST(NamedMotion, RefusesWhatItsClassRefuses) {
  const auto refuses = [](Type type, int order, double first, double second,
                          std::initializer_list<std::string_view> words) {
    EXPECT_TRUE(throws<std::invalid_argument>([&] { NamedMotion{type, order, 2, first, second}.require(); }, words));
    EXPECT_NO_THROW((NamedMotion{type, order, 2, 0.0, 0.0}.require()));
  };
  refuses(Type::discrete_white_noise, 2, -1.0, 0.0, {"sigma_w", "'dwna'", "-1"});
  refuses(Type::white_noise, 3, -1.0, 0.0, {"q of", "'cwpa'", "-1"});
  refuses(Type::ornstein_uhlenbeck, 1, -1.0, 0.0, {"the rate", "'ou_position'", "-1"});
  refuses(Type::ornstein_uhlenbeck, 3, 0.0, -2.0, {"sigma", "'singer'", "-2"});
  refuses(Type::known_turn, 2, NAN, 1.0, {"the rate", "'known_turn'", "nan"});
  refuses(Type::known_turn, 2, -1.0, -2.0, {"q of", "'known_turn'", "-2"});
  refuses(Type::coordinated_turn, 2, -1.0, 0.0, {"q of", "'coordinated_turn'", "-1"});
  refuses(Type::coordinated_turn, 2, 0.0, -2.0, {"q_omega", "'coordinated_turn'", "-2"});
}

}  // namespace
}  // namespace sigmax
