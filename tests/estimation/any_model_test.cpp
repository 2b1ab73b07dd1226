#include "estimation/restated.hpp"

namespace any_model_test {

static_assert(FilterModel<AnyModel> && StateModel<AnyModel> && axes_of<AnyModel> == 0);
static_assert(!LinearMotion<AnyModel>, "nobody asks for its matrices");
static_assert(!std::is_convertible_v<CoordinatedTurn<2>, AnyModel>, "it needs a member");
static_assert(std::is_convertible_v<Extended<CoordinatedTurn<2>>, AnyModel>);

/// As any it does what it does by itself, also by a sensor that is linear and by one that is not.
template <class Model>
void expect_as(const Model& model) {
  const AnyModel any = model;
  expect_the_same(any, model);
  EXPECT_EQ(any.axes(), axes_of<Model>);
  const auto n = model.size();
  const EstimateOf<AnyModel> x{StateOf<AnyModel>::LinSpaced(n, 40.0, 1.0), StateMatrixOf<AnyModel>::Identity(n, n)};
  const EstimateOf<Model> same{x.mean, x.covariance};
  const Gaussian<2> z{Vector<2>(42.0, 0.8), SquareMatrix<2>{{1.0, 0.2}, {0.2, 0.5}}};
  const PolarSensor<2> radar{Vector<2>(-30.0, 20.0)};
  EXPECT_CLOSE(update(any, x, z, radar), update(model, same, z, radar), 0.0);
  EstimateOf<Model> expected;
  update(model, same, z, PositionSensor<2>{}, expected);
  EXPECT_CLOSE(update(any, x, z, PositionSensor<2>{}), expected, 0.0);
}

TEST(AnyModel, DoesWhatTheModelDoesThatItWasMadeOf) {
  expect_as(dwpa<2>(2.0));
  expect_as(Extended{dwna<2>(3.0, Vector<2>(1.0, -2.0))});
  expect_as(Unscented{CoordinatedTurn<2>{1.0, 0.01}, {0.5, 2.0, 1.0}});
}

TEST(AnyModel, MayBeAUsersOwn) {
  Draws draws(1);
  const OwnMotion motion{drawn_model(draws, 3, 1, 3, 0.3), 3};
  expect_as(OwnLinearMotion{motion});
  expect_as(Extended{motion});
}

TEST(AnyModel, RefusesAnEstimateOfAnotherSize) {
  const EstimateOf<AnyModel> wrong{Vector<4>::Ones(), SquareMatrix<4>::Identity()};
  const Gaussian<2> z{Vector<2>::Ones(), SquareMatrix<2>::Identity()};
  EstimateOf<AnyModel> x;
  for (const AnyModel& turn : every_member(CoordinatedTurn<2>{1.0, 0.01})) {
    const std::initializer_list<std::string_view> words{"coordinated_turn", "4 components", "5"};
    EXPECT_TRUE(throws<std::invalid_argument>([&] { predict(turn, wrong, 1.0, x); }, words));
    EXPECT_TRUE(throws<std::invalid_argument>([&] { prediction_covariance(turn, wrong, 1.0); }, words));
    EXPECT_TRUE(throws<std::invalid_argument>([&] { update(turn, wrong, z, PositionSensor<2>{}, x); }, words));
    const EstimateOf<AnyModel> right{Vector<5>::Ones(), SquareMatrix<5>::Identity()};
    EXPECT_TRUE(throws<std::invalid_argument>([&] { smooth_step(turn, right, 1.0, wrong, x); }, words));
    EXPECT_TRUE(throws<std::invalid_argument>([&] { smooth_step(turn, wrong, 1.0, right, x); }, words));
  }
}

TEST(AnyModel, HasAtMost32States) {
  Draws draws(2);
  const auto of_size = [&](std::size_t n) { return OwnMotion{drawn_model(draws, n, 1, n, 0.3), n}; };
  EXPECT_EQ(AnyModel{Extended{of_size(32)}}.size(), 32);
  EXPECT_INVALID(("'own'", "33 states", "32"), AnyModel{Extended{of_size(33)}});
}

}  // namespace any_model_test
