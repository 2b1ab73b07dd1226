#include "support/sigmax.hpp"

namespace radar_numbers_test {

TEST(RadarNumbers, AnAngleIsWrapped) {
  constexpr double pi = std::numbers::pi;
  EXPECT_CLOSE(wrapped(3.5), 3.5 - 2.0 * pi, 1e-15);
  EXPECT_CLOSE(wrapped(-3.5), 2.0 * pi - 3.5, 1e-15);
  EXPECT_EQ(wrapped(-1.0), -1.0);
  EXPECT_EQ(wrapped(pi), pi);
  EXPECT_CLOSE(wrapped(1.0 + 20.0 * pi), 1.0, 1e-13);
}

/// Either result may be left out.
TEST(RadarNumbers, OnlyWhatIsAskedForIsWritten) {
  const double origin[3] = {1.0, 2.0, 3.0}, x[6] = {4.0, 6.0, 3.0, 1.0, 1.0, 1.0};
  double z[4], H[24];
  detail::polar(2, origin, x, z, nullptr);
  EXPECT_EQ(z[0], 5.0);
  detail::polar(3, origin, x, nullptr, H);
  EXPECT_EQ(H[0], 0.6);
  detail::bearing(origin, x, nullptr, H);
  EXPECT_EQ(H[1], 0.12);
  detail::doppler(3, origin, x, z, nullptr);
  EXPECT_EQ(z[3], 1.4);
}

}  // namespace radar_numbers_test
