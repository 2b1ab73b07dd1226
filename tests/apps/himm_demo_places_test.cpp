// Tracks on the Earth: wherever they are and however far they go, places, speeds and climbs are those there.

#include "apps/recordings.hpp"

namespace himm_demo_places_test {

TEST(HimmDemoPlaces, TwoShipsOfOneFileAreOnTheirHemispheres) {
  std::string text = "time_s,ship,latitude_deg,longitude_deg\n";
  for (int k = 0; k < 40; ++k) {
    text += exact(10.0 * k) + ",north," + exact(50.0 + 0.0009 * k) + ",-1\n";
    text += exact(10.0 * k) + ",south," + exact(-36.0 - 0.0009 * k) + ",175\n";
  }
  const auto found = estimates(text, {"sigma_position_m=1", "sigma_w=0.1"}, {"--track-id", "ship"});
  ASSERT_EQ(found.size(), 2U * 2U * 37U);
  for (const auto& row : found) {
    const bool north = row.at("track") == "north";
    const double way = 0.00009 * number(row.at("time_s"));
    EXPECT_NEAR(number(row.at("latitude_deg")), north ? 50.0 + way : -36.0 - way, 5e-5);
    EXPECT_NEAR(number(row.at("longitude_deg")), north ? -1.0 : 175.0, 1e-6);
    EXPECT_NEAR(number(row.at("vy_mps")), north ? 10.01 : -9.985, 0.6);
    EXPECT_NEAR(number(row.at("vx_mps")), 0.0, 0.1);
    EXPECT_NEAR(number(row.at("x_m")), 0.0, 0.5);  // of its own first row
  }
}

TEST(HimmDemoPlaces, AnOriginFarAwayMovesNoShip) {
  const auto text = recording("time_s,latitude_deg,longitude_deg",
                              [](int k) { return exact(10.0 * k) + ",0," + exact(120.0 + 0.0009 * k); });
  for (const auto& row : estimates(text, {"sigma_position_m=1"}, {"--origin", "0,0,0"})) {
    EXPECT_NEAR(number(row.at("longitude_deg")), 120.0 + 0.00009 * number(row.at("time_s")), 5e-5);
    EXPECT_NEAR(number(row.at("latitude_deg")), 0.0, 1e-6);
    EXPECT_NEAR(number(row.at("vx_mps")), 10.02, 0.6);
    EXPECT_GT(number(row.at("x_m")), 1.3e7);
  }
}

}  // namespace himm_demo_places_test
