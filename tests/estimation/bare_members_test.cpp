// What member_bench compares the library with does the same work: the bare filters are the library's members.
#include "estimation/bare_members.hpp"

#include "support/sigmax.hpp"

namespace bare_members_test {

/// Flies straight from east to west, past the cut of the azimuth, then in circles of 300 m.
template <class Bare, class Member>
void expect_the_same(const Member& member, double T, double q, double q_omega) {
  Gaussian<7> x{Vector<7>::Zero(), SquareMatrix<7>::Identity()};
  x.mean.head<6>() << -12e3, 1e3, 1e3, 0.0, -100.0, 0.0;
  x.covariance.diagonal().head<6>().setConstant(100.0);
  x.covariance(6, 6) = 0.01;
  Bare bare(T, q, q_omega, x.mean, x.covariance);
  for (int k = 1; k <= 300; ++k) {
    const double t = T * k, turning = std::max(t - 30.0, 0.0) / 3.0;
    Polar seen = to_polar(
        {-12e3 + 300.0 * (1.0 - std::cos(turning)), 1e3 - 100.0 * std::min(t, 30.0) - 300.0 * std::sin(turning), 1e3});
    seen.range += 10.0 * std::sin(7.0 * k);
    seen.azimuth = radians(wrapped(seen.azimuth.radians() + 0.002 * std::cos(11.0 * k)));
    seen.elevation += radians(0.002 * std::sin(13.0 * k));
    const auto measured = PolarSensor<3>{}.measurement(seen, {10.0, radians(0.002), radians(0.002)});
    predict(member, x, T, x);
    const auto innovation = update(member, x, measured, x);
    bare.step(measured.z.mean, measured.z.covariance);
    ASSERT_CLOSE(bare.x, x.mean, 1e-9);
    ASSERT_CLOSE(bare.P, x.covariance, 1e-9);
    ASSERT_CLOSE(bare.log_likelihood, innovation.log_likelihood, 1e-9);
  }
}

TEST(BareMembers, AreTheLibrarysMembers) {
  constexpr double T = 0.2, q = 9.0, q_omega = 0.01;
  const CoordinatedTurn<3> turn(std::sqrt(q), std::sqrt(q_omega));
  expect_the_same<bench::BareExtended>(Extended{turn}, T, q, q_omega);
  expect_the_same<bench::BareUnscented>(Unscented{turn}, T, q, q_omega);
  expect_the_same<bench::BareCubature>(Cubature{turn}, T, q, q_omega);
}

}  // namespace bare_members_test
