// What every member of the family has in common: Extended, Unscented, Cubature.

#include "estimation/restated.hpp"

namespace member_test {

/// A member is of a motion: an AnyModel has its member already.
template <class Model>
concept HasMembers = requires(const Model& model) {
  Extended{model};
};
static_assert(HasMembers<CoordinatedTurn<2>> && !HasMembers<AnyModel>);

TEST(Member, OfALinearMotionPredictsAsTheKalmanFilterExactly) {
  const EstimateOf<AnyModel> prior{Vector<9>::LinSpaced(1.0, 9.0), SquareMatrix<9>::Identity()};
  const auto expected = predict(AnyModel{dwpa<3>(2.0)}, prior, 0.3);
  for (const AnyModel& member : every_member(dwpa<3>(2.0))) {
    EXPECT_EQ(predict(member, prior, 0.3).mean, expected.mean);
    EXPECT_EQ(predict(member, prior, 0.3).covariance, expected.covariance);
  }
}

/// The same scene, turned by half a turn about the radar, so that the azimuth jumps among the points, or not. Those of
/// a wide estimate lie on both sides of the radar.
TEST(Member, AnAzimuthAcrossHalfATurnIsAnAzimuthLikeAnother) {
  const SquareMatrix<2> R{{1.0, 0.0}, {0.0, 0.0025}};
  for (const auto& [wide, off] : {std::pair{2.0, -0.001}, {2.0, 0.0}, {2.0, 0.001}, {60.0, 0.02}, {120.0, -0.5}})
    for (const double seen : {-0.05, 0.001, 0.05})
      for (const AnyModel& member : every_member(dwna<2>(1.0))) {
        const auto posterior_at = [&, sigma = wide, truth = off](double turn, Innovation<2>& innovation) {
          EstimateOf<AnyModel> x{Vector<4>(100.0 * std::cos(turn + truth), 100.0 * std::sin(turn + truth), 0.0, 0.0),
                                 SquareMatrix<4>::Identity() * sigma * sigma};
          const double azimuth = std::remainder(turn + seen, 2.0 * std::numbers::pi);
          innovation = update(member, x, Gaussian<2>{Vector<2>(101.0, azimuth), R}, PolarSensor<2>{}, x);
          return x;
        };
        Innovation<2> ahead, behind;
        const auto here = posterior_at(0.0, ahead), there = posterior_at(std::numbers::pi, behind);
        EXPECT_CLOSE(there.mean, -here.mean, 1e-12);
        EXPECT_CLOSE(there.covariance, here.covariance, 1e-12);
        EXPECT_CLOSE(behind.residual, ahead.residual, 1e-12);
        EXPECT_CLOSE(behind.log_likelihood, ahead.log_likelihood, 1e-12);
      }
}

TEST(Member, ShowsItsMotion) {
  const Cubature member{dwna<3>(2.0)};
  EXPECT_EQ(member.name(), "dwna");
  EXPECT_EQ(member.size(), 6);
  EXPECT_EQ(member.components(), dwna<3>(2.0).components());
  EXPECT_EQ(member.motion().law().sigma_w(), 2.0);
  EXPECT_EQ(axes_of<Cubature<CoordinatedTurn<3>>>, 3);
}

}  // namespace member_test
