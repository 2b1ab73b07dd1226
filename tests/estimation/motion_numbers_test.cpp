#include "support/sigmax.hpp"

namespace motion_numbers_test {

TEST(MotionNumbers, AParameterIsFiniteWithItsSquareAndNotNegative) {
  EXPECT_EQ(detail::motion_parameter(0.0, "q", "cwna"), 0.0);
  EXPECT_EQ(detail::motion_parameter(1e150, "q", "cwna"), 1e150);
  for (const double bad : {-1.0, 1.1e150, infinity, not_a_number})
    EXPECT_INVALID(("q of model 'cwna'", std::to_string(bad), "at least", "0"),
                   detail::motion_parameter(bad, "q", "cwna"));
}

TEST(MotionNumbers, ARateIsFinite) {
  EXPECT_EQ(detail::finite_rate(-2.0), -2.0);
  EXPECT_INVALID(("rate", "known_turn", "nan"), detail::finite_rate(not_a_number));
}

TEST(Motions, ShowTheirParameters) {
  EXPECT_EQ(dwna<3>(2.5).law().sigma_w(), 2.5);
  EXPECT_EQ(cwpa<2>(1.5).law().sigma_w(), 1.5);
  EXPECT_EQ(singer<2>(0.25, 1.5).law().theta(), 0.25);
  EXPECT_EQ(singer<2>(0.25, 1.5).law().sigma(), 1.5);
  EXPECT_EQ((KnownTurn<2>{0.1, 2.0}.omega()), 0.1);
  EXPECT_EQ((KnownTurn<2>{0.1, 2.0}.sigma_w()), 2.0);
  EXPECT_EQ((CoordinatedTurn<3>{3.0, 0.5}.sigma_w()), 3.0);
  EXPECT_EQ((CoordinatedTurn<3>{3.0, 0.5}.sigma_omega()), 0.5);
}

TEST(Motions, RefuseParametersThatAreNone) {
  EXPECT_INVALID(("sigma_w", "dwna", "-1"), dwna<3>(-1.0));
  EXPECT_INVALID(("sigma_w", "dwpa", "inf"), dwpa<3>(infinity));
  EXPECT_INVALID(("sigma_w", "dwpa", "nan"), dwpa<3>(not_a_number));
  EXPECT_INVALID(("sigma_w", "cwna", "-1"), cwna<3>(-1.0));
  EXPECT_INVALID(("sigma_w", "cwpa", "nan"), cwpa<3>(not_a_number));
  EXPECT_INVALID(("rate", "singer", "-1"), singer<3>(-1.0, 1.0));
  EXPECT_INVALID(("the rate", "ou_position", "-1"), ou_position<1>(-1.0, 1.0));
  EXPECT_INVALID(("sigma", "ou_velocity", "-2"), ou_velocity<3>(1.0, -2.0));
  EXPECT_INVALID(("rate", "known_turn", "nan"), KnownTurn<2>(not_a_number, 1.0));
  EXPECT_INVALID(("sigma_w", "known_turn", "-1"), KnownTurn<2>(0.1, -1.0));
  EXPECT_INVALID(("sigma_w", "coordinated_turn", "-1"), CoordinatedTurn<2>(-1.0, 1.0));
  EXPECT_INVALID(("sigma_omega", "coordinated_turn", "-2"), CoordinatedTurn<2>(1.0, -2.0));
}

}  // namespace motion_numbers_test
