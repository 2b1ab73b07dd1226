#include <sigmax/estimation/motion_numbers.hpp>

#include <gtest/gtest.h>

#include <limits>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

TEST(MotionNumbers, ComponentsAreOrderedByDerivative) {
  EXPECT_EQ(detail::motion_components(1, 1), (std::vector<std::string>{"x"}));
  EXPECT_EQ(detail::motion_components(2, 2), (std::vector<std::string>{"x", "y", "vx", "vy"}));
  EXPECT_EQ(detail::motion_components(3, 3),
            (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "ax", "ay", "az"}));
}

TEST(MotionNumbers, AParameterIsFiniteAndNotTooSmall) {
  EXPECT_EQ(detail::motion_parameter(0.0, "q", "cwna"), 0.0);
  EXPECT_EQ(detail::motion_parameter(3.0, "q", "cwna", 3.0), 3.0);
  EXPECT_TRUE(throws<std::invalid_argument>([] { detail::motion_parameter(-1.0, "q", "cwna"); }, {"q", "cwna", "-1"}));
  EXPECT_TRUE(
      throws<std::invalid_argument>([] { detail::motion_parameter(2.0, "q", "cwna", 3.0); }, {"at least", "3"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] { detail::motion_parameter(std::numeric_limits<double>::infinity(), "q", "cwna"); }, {"inf"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [] { detail::motion_parameter(std::numeric_limits<double>::quiet_NaN(), "q", "cwna"); }, {"nan"}));
}

}  // namespace
}  // namespace sigmax
