#include "support/sigmax.hpp"

namespace {

TEST(MotionNumbers, ComponentsAreOrderedByDerivative) {
  EXPECT_EQ(detail::motion_components(1, 1), (std::vector<std::string>{"x"}));
  EXPECT_EQ(detail::motion_components(2, 2), (std::vector<std::string>{"x", "y", "vx", "vy"}));
  EXPECT_EQ(detail::motion_components(3, 3),
            (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"}));
}

TEST(MotionNumbers, AParameterIsFiniteWithItsSquareAndNotNegative) {
  EXPECT_EQ(detail::motion_parameter(0.0, "q", "cwna"), 0.0);
  EXPECT_EQ(detail::motion_parameter(1e150, "q", "cwna"), 1e150);
  for (const double bad : {-1.0, 1.1e150, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_INVALID(("q of model 'cwna'", std::to_string(bad), "at least", "0"),
                   detail::motion_parameter(bad, "q", "cwna"));
}

TEST(MotionNumbers, ARateIsFinite) {
  EXPECT_EQ(detail::finite_rate(-2.0), -2.0);
  EXPECT_INVALID(("rate", "known_turn", "nan"), detail::finite_rate(std::nan("")));
}

}  // namespace
