#include <sigmax/estimation/named_motion.hpp>

#include <gtest/gtest.h>

#include <vector>

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/known_turn.hpp>
#include <sigmax/estimation/linearised.hpp>
#include <sigmax/estimation/ornstein_uhlenbeck.hpp>
#include <sigmax/estimation/unscented.hpp>
#include <sigmax/estimation/white_noise.hpp>

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

/// All that a filter or smoother asks of them is the same to the bit.
void expect_the_same(const AnyModel& named, const AnyModel& typed) {
  SCOPED_TRACE(testing::Message() << named.name() << ", " << named.size() << " states");
  ASSERT_EQ(named.size(), typed.size());
  EXPECT_EQ(named.name(), typed.name());
  EXPECT_EQ(named.components(), typed.components());
  EXPECT_EQ(named.axes(), typed.axes());
  const auto n = named.size();
  EstimateOf<AnyModel> start{StateOf<AnyModel>::LinSpaced(n, 1.0, 1.5), StateMatrixOf<AnyModel>::Constant(n, n, 0.5)};
  start.covariance.diagonal().setLinSpaced(n, 1.0, 2.0);
  const auto found = predict(named, start, 0.7), expected = predict(typed, start, 0.7);
  EXPECT_EQ(found.mean, expected.mean);
  EXPECT_EQ(found.covariance, expected.covariance);
  EXPECT_EQ(prediction_covariance(named, start, 0.7), prediction_covariance(typed, start, 0.7));
  const auto step = linearised_step(named, start, 0.7), of_typed = linearised_step(typed, start, 0.7);
  EXPECT_EQ(step.mean, of_typed.mean);
  EXPECT_EQ(step.F, of_typed.F);
  EXPECT_EQ(step.Q, of_typed.Q);
}

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
    expect_the_same(Extended{turn}, Extended{typed});
    expect_the_same(Unscented{turn}, Unscented{typed});
    expect_the_same(Cubature{turn}, Cubature{typed});
  }
  for (const auto& [name, named, typed] : all) {
    EXPECT_EQ(typed.name(), name);
    expect_the_same(named, typed);
    expect_the_same(Cubature{named}, typed);
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
