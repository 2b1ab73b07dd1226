#include "support/sigmax.hpp"

namespace start_test {

restatement::Position position(const Gaussian<2>& z) { return {entries(z.mean), dense(z.covariance)}; }

/// A measurement in the plane whose axes are alike, but for the sign.
TimedMeasurement<2> at(double time, double z, double R) {
  return {time, {Vector<2>{z, -z}, SquareMatrix<2>{{R, 0.0}, {0.0, R}}}};
}

PROPERTY(Start, AllThreeEqualTheRestatement) {
  const auto z1 = generated_gaussian<2>(), z2 = generated_gaussian<2>(), z3 = generated_gaussian<2>();
  const double t = number_between(-100.0, 100.0);
  const double T = number_between(0.1, 3.0);
  const double U = number_between(0.1, 3.0);
  const auto same = [](const auto& found, const restatement::State& expected) {
    require_near(entries(found.mean), expected.mean, 1e-9);
    require_near(found.covariance, expected.covariance, 1e-9);
    RC_ASSERT(found.covariance == found.covariance.transpose());
  };
  same(two_point_start<2>({t, z1}, {t + T, z2}), restatement::two_point_start(position(z1), position(z2), T));
  same(three_point_start<2>({t, z1}, {t + T, z2}, {t + T + U, z3}),
       restatement::three_point_start(position(z1), position(z2), position(z3), T, U));
  same(released_start<2>({t, z1}, {t + T, z2}, {t + 2 * T, z3}),
       restatement::released_start(position(z1), position(z2), position(z3), T));
}

TEST(Start, NeedsIncreasingTimes) {
  const auto seen = [](double t) { return at(t, 1.0, 1.0); };
  EXPECT_INVALID(("increasing times"), two_point_start<2>(seen(1.0), seen(1.0)));
  EXPECT_INVALID(("increasing times"), three_point_start<2>(seen(1.0), seen(0.0), seen(2.0)));
  EXPECT_INVALID(("increasing times"), three_point_start<2>(seen(0.0), seen(1.0), seen(1.0)));
  EXPECT_INVALID(("increasing times"), released_start<2>(seen(0.0), seen(2.0), seen(1.0)));
}

/// What is seen of a target by turns from where `place(k)` says.
struct Crossed {
  std::vector<TimedBearing> bearings;
  std::vector<double> motion;  // at the last of them

  template <class Place>
  Crossed(int count, std::vector<double> target, const Place& place) : motion(std::move(target)) {
    for (int k = 0; k < count; ++k) {
      const Vector<2> at = place(k);
      const double t = 0.7 * (k - count + 1) - 0.1 * ((count - 1 - k) % 3), sigma = (1 + k % 2) * 0.002;
      bearings.push_back({50.0 + t, at, radians(azimuth(motion, t, at)), radians(sigma)});
    }
  }

  static double azimuth(const std::vector<double>& motion, double t, const Vector<2>& from) {
    double d[2];
    for (std::size_t i = 0; i < 2; ++i) {
      d[i] = motion[i] - from(static_cast<int>(i)) + t * motion[i + 2];
      if (motion.size() == 6) d[i] += 0.5 * t * t * motion[i + 4];
    }
    return std::atan2(d[1], d[0]);
  }
};

Vector<2> two_stations(int k) { return {k % 2 == 0 ? -3000.0 : 4000.0, k % 2 == 0 ? 0.0 : 500.0}; }

template <int Derivatives>
void require_most_likely(int count) {
  const int n = 2 * Derivatives;
  std::vector<double> motion = {number_between(-2e3, 2e3), number_between(4e3, 8e3), number_between(-90, 90),
                                number_between(-90, 90)};
  if (Derivatives == 3) motion.insert(motion.end(), {number_between(-3, 3), number_between(-3, 3)});
  Crossed crossed(count, motion, two_stations);
  const auto found = crossed_bearings_start<Derivatives>(crossed.bearings);
  RC_ASSERT(found.has_value());
  for (int i = 0; i < n; ++i) RC_ASSERT(std::abs(found->mean(i) - motion[static_cast<std::size_t>(i)]) <= 1e-3);

  for (auto& bearing : crossed.bearings) bearing.azimuth += number_between(-1.0, 1.0) * bearing.sigma;
  const auto start = crossed_bearings_start<Derivatives>(crossed.bearings);
  RC_ASSERT(start.has_value());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);  // by differences of the azimuths
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(n), scale(n);
  for (int i = 0; i < n; ++i) scale(i) = std::sqrt(start->covariance(i, i));
  for (const auto& bearing : crossed.bearings) {
    const auto seen = [&](int moved, double by) {
      auto other = entries(start->mean);
      if (moved >= 0) other[static_cast<std::size_t>(moved)] += by;
      return Crossed::azimuth(other, bearing.time - crossed.bearings.back().time, bearing.origin);
    };
    Eigen::VectorXd h(n);
    for (int i = 0; i < n; ++i)
      h(i) = (seen(i, 1e-3 * scale(i)) - seen(i, -1e-3 * scale(i))) / 2e-3;  // to a standard deviation
    const double variance = std::pow(bearing.sigma.radians(), 2);
    information += h * h.transpose() / variance;
    slope += h * (bearing.azimuth.radians() - seen(-1, 0.0)) / variance;
  }
  RC_ASSERT(slope.norm() <= 1e-5);  // no motion is more likely
  const Eigen::MatrixXd covariance = information.inverse();
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      RC_ASSERT(std::abs(start->covariance(i, k) / (scale(i) * scale(k)) - covariance(i, k)) <= 1e-4);
}

PROPERTY(Start, FromCrossedBearingsIsTheMostLikelyMotion) {
  require_most_likely<2>(4);
  require_most_likely<3>(16);
}

TEST(Start, BearingsWaitUntilTheyTellWhereTheTargetIs) {
  const auto starts = [](int count, const auto& place) {
    const Crossed crossed(count, {500.0, 6000.0, 40.0, -30.0}, place);
    return crossed_bearings_start<2>(crossed.bearings).has_value();
  };
  EXPECT_TRUE(starts(4, two_stations));
  EXPECT_FALSE(starts(3, two_stations)) << "too few";
  EXPECT_FALSE(starts(16, [](int) { return Vector<2>(300.0, -400.0); })) << "one station";
  EXPECT_FALSE(starts(16, [](int k) { return Vector<2>(10.0 * k, 5.0 * k); })) << "one that moves straight ahead";
  EXPECT_FALSE(starts(16, [](int k) { return Vector<2>(k % 2 * 20.0, 0.0); })) << "nearly parallel";
  EXPECT_TRUE(starts(16, [](int k) { return Vector<2>(k % 2 * 2000.0, 0.0); }));
  std::vector<TimedBearing> behind;  // they cross below, and look up
  for (int k = 0; k < 8; ++k)
    behind.push_back({1.0 * k, two_stations(k), degrees(k % 2 == 0 ? 120.0 : 60.0), radians(1e-3)});
  EXPECT_FALSE(crossed_bearings_start<2>(behind).has_value());
  for (auto& bearing : behind) bearing.azimuth += degrees(180.0);
  EXPECT_TRUE(crossed_bearings_start<2>(behind).has_value());
  for (auto& bearing : behind) bearing.time = 3.0;
  EXPECT_FALSE(crossed_bearings_start<2>(behind).has_value()) << "all at one time";
}

}  // namespace start_test
