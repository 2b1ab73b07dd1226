// A motion by its name is that of its class.

#include "support/sigmax.hpp"

namespace known_model_test {

MotionChoice choice(const char* name) { return {name, {3.0, 8.0, 5.0, 0.25}}; }

/// Both predict and see a radar's measurement alike.
template <int Axes, class Moves>
void is(const char* name, const Moves& motion) {
  SCOPED_TRACE(testing::Message() << name << " along " << Axes << " axes");
  const auto same = [&](const AnyModel& found, const AnyModel& expected) {
    EXPECT_EQ(found.name(), motion.name());
    EXPECT_EQ(found.components(), motion.components());
    EXPECT_EQ(found.axes(), Axes);
    const auto n = motion.size();
    EstimateOf<AnyModel> a{Eigen::VectorXd::LinSpaced(n, 100.0, 40.0), 9.0 * Eigen::MatrixXd::Identity(n, n)};
    a.mean(n - 1) = 0.2;
    a.covariance(n - 1, n - 1) = 0.01;
    auto b = a;
    predict(found, a, 0.5, a);
    predict(expected, b, 0.5, b);
    EXPECT_CLOSE(a, b, 1e-12);
    if constexpr (Axes > 1) {
      const PolarSensor<Axes> radar;
      const Gaussian<Axes> z{radar.measure(Vector<Axes>::Constant(100.0)), 1e-3 * SquareMatrix<Axes>::Identity()};
      update(found, a, z, radar, a);
      update(expected, b, z, radar, b);
      EXPECT_CLOSE(a.mean, b.mean, 1e-12);
    }
  };
  same(known_model(choice(name), Axes), Extended{motion});
  same(known_model(choice(name), Axes, MemberType::kf), Extended{motion});
  same(known_model(choice(name), Axes, MemberType::ukf), Unscented{motion});
  same(known_model(choice(name), Axes, MemberType::ckf), Cubature{motion});
}

template <int Axes>
void are_those_of_their_classes() {
  is<Axes>("dwna", dwna<Axes>(3.0));
  is<Axes>("dwpa", dwpa<Axes>(3.0));
  is<Axes>("cwna", cwna<Axes>(3.0));
  is<Axes>("cwpa", cwpa<Axes>(3.0));
  is<Axes>("singer", singer<Axes>(1.0 / 8.0, 3.0));
  is<Axes>("ou_position", ou_position<Axes>(1.0 / 8.0, 3.0));
  is<Axes>("ou_velocity", ou_velocity<Axes>(1.0 / 8.0, 3.0));
  if constexpr (Axes > 1) {
    is<Axes>("known_turn", KnownTurn<Axes>{5.0 * degree, 3.0});
    is<Axes>("ct", CoordinatedTurn<Axes>{3.0, 0.25 * degree});
  }
}

TEST(KnownModel, IsThatOfItsClass) {
  are_those_of_their_classes<1>();
  are_those_of_their_classes<2>();
  are_those_of_their_classes<3>();
}

TEST(KnownModel, OfAnotherNameOfBadParametersOrATurnAlongOneAxisIsRefused) {
  EXPECT_INVALID(("no motion", "'warp'"), known_model(choice("warp"), 2));
  EXPECT_INVALID(("'ct'", "one axis"), known_model(choice("ct"), 1));
  EXPECT_INVALID(("'known_turn'", "one axis"), known_model(choice("known_turn"), 1));
  for (const KnownMotion& motion : known_motions())
    for (std::size_t p = 0; p < motion_parameters().size(); ++p) {
      MotionChoice bad = choice(std::string(motion.name).c_str());
      bad.parameters[p] = not_a_number;
      if (motion.has[p])
        EXPECT_THROW(known_model(bad, 2), std::invalid_argument) << motion.name << ", " << motion_parameters()[p].key;
      else
        EXPECT_NO_THROW(known_model(bad, 2)) << motion.name;
    }
}

}  // namespace known_model_test
