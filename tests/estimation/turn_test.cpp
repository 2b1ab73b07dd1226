#include <sigmax/estimation/turn.hpp>

#include <gtest/gtest.h>

#include <numbers>

#include <sigmax/estimation/jacobian.hpp>

#include "support/matrices.hpp"

namespace sigmax {
namespace {

using support::holds;
using support::near;
using support::near_matrix;
using support::number_between;
using support::require_near;

TEST(Turn, TheSincIsSmoothAtZero) {
  EXPECT_EQ(detail::sinc(0.0), 1.0);
  EXPECT_PRED_FORMAT3(near, detail::sinc(std::numbers::pi / 2.0), 2.0 / std::numbers::pi, 1e-15);
  for (const double x : {1e-9, 1e-4, 0.0099999, 0.0100001, 0.1, 1.0})
    for (const double signed_x : {x, -x}) {
      const auto exact = std::sin(static_cast<long double>(signed_x)) / static_cast<long double>(signed_x);
      EXPECT_PRED_FORMAT3(near, detail::sinc(signed_x), static_cast<double>(exact), 1e-15);
    }
}

TEST(Turn, DerivativesAreThoseOfAutomaticDifferentiation) {
  holds([] {
    const double x = std::pow(10.0, number_between(-6.0, 1.0)) * (number_between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0);
    const auto derivative = jacobian<1, 1, 1, 1>(
        [](const DifferentiableVector<1>& v) { return DifferentiableVector<1>(detail::sinc(v(0))); }, Vector<1>(x));
    require_near(detail::sinc_derivative(x), derivative(0), 1e-11);
    require_near(detail::sinc_derivative(x),
                 static_cast<double>((std::cos(static_cast<long double>(x)) -
                                      std::sin(static_cast<long double>(x)) / static_cast<long double>(x)) /
                                     static_cast<long double>(x)),
                 1e-11);
  });
}

TEST(Turn, TheCubicRemainderDoesNotCancel) {
  EXPECT_EQ(detail::cubic_remainder_of_sine(0.0), 1.0 / 6.0);
  for (const double x : {0.01, 0.3, 0.999, 1.001, 3.0, -2.0, -0.5}) {
    const long double exact_x = x;
    EXPECT_PRED_FORMAT3(near, detail::cubic_remainder_of_sine(x),
                        static_cast<double>((exact_x - std::sin(exact_x)) / (exact_x * exact_x * exact_x)), 1e-14);
  }
}

TEST(Turn, AQuarterTurnMovesAlongTheQuarterOfACircle) {
  const double omega = std::numbers::pi / 2.0, radius = 200.0, speed = radius * omega;
  const Vector<6> start(0.0, 0.0, 10.0, speed, 0.0, 5.0);  // the centre is at (0, 200)
  const Vector<6> there = detail::turn_transition<3>(omega, 1.0) * start;
  EXPECT_PRED_FORMAT3(near_matrix, there, (Vector<6>{radius, radius, 15.0, 0.0, speed, 5.0}), 1e-12);
}

TEST(Turn, WithoutARateItIsStraight) {
  EXPECT_EQ(detail::turn_transition<2>(0.0, 2.0),
            (SquareMatrix<4>{{1, 0, 2, 0}, {0, 1, 0, 2}, {0, 0, 1, 0}, {0, 0, 0, 1}}));
}

}  // namespace
}  // namespace sigmax
