// What `track` takes beside positions: velocities, speeds with a course, range rates, bearings; against an extended
// Kalman filter of one model, restated, with a numerical Jacobian.

#include "apps/recordings.hpp"

namespace himm_demo_velocity_test {

using support::degree;

constexpr double knot = 1852.0 / 3600.0;

/// One measured quantity of the state x, y, vx, vy.
struct Quantity {
  double value;
  double sigma;
  std::function<double(const Numbers&)> of;
  bool angle = false;
};

/// A step of a target of nearly constant velocity (σ_w = 2 m/s²) on two axes, whose measurements are linearised at the
/// prediction.
restatement::State stepped(const restatement::State& state, double T, const std::vector<Quantity>& row) {
  const auto prior = restatement::predicted(restatement::dwna(2, 2.0), state, T);
  if (row.empty()) return prior;
  restatement::Seen seen{Numbers(row.size()), restatement::Matrix(row.size(), 4)};
  restatement::Matrix R(row.size(), row.size());
  for (std::size_t q = 0; q < row.size(); ++q) {
    const Quantity& quantity = row[q];
    seen.nu[q] = quantity.value - quantity.of(prior.mean);
    if (quantity.angle) seen.nu[q] = std::remainder(seen.nu[q], 2.0 * std::numbers::pi);
    R(q, q) = quantity.sigma * quantity.sigma;
    for (std::size_t i = 0; i < 4; ++i) {
      Numbers up = prior.mean, down = prior.mean;
      up[i] += 1e-3;
      down[i] -= 1e-3;
      seen.H(q, i) = (quantity.of(up) - quantity.of(down)) / 2e-3;
    }
  }
  return restatement::sighted(prior, seen, R).posterior;
}

/// Rows of a target at constant velocity: their text, and what each measures.
struct Recording {
  std::string text;
  std::vector<std::vector<Quantity>> rows;
};

Quantity component(std::size_t i, double value, double sigma) {
  return {value, sigma, [i](const auto& x) { return x[i]; }};
}

void expect_filtered(const Recording& recording, const Arguments& more, double tolerance,
                     const Arguments& options = {}) {
  const Arguments known = {"filters=[imm]",
                           "models=[dwna]",
                           "sigma_w=2",
                           "start=given",
                           "start_mean=[5000,-3000,0,-60,80,0,0,0,0]",
                           "start_covariance_diagonal=[400,400,1,25,25,1,1,1,1]",
                           "start_time_s=0",
                           "sigma_position_m=12"};
  const auto found = estimates(recording.text, known + more, options);
  ASSERT_EQ(found.size(), recording.rows.size());
  restatement::State expected{{5000.0, -3000.0, -60.0, 80.0},
                              restatement::Matrix(4, 4, {400, 0, 0, 0, 0, 400, 0, 0, 0, 0, 25, 0, 0, 0, 0, 25})};
  for (std::size_t k = 0; k < found.size(); ++k) {
    SCOPED_TRACE("row " + std::to_string(k));
    expected = stepped(expected, 1.0, recording.rows[k]);
    const std::array<std::string, 4> names = {"x_m", "y_m", "vx_mps", "vy_mps"};
    for (std::size_t i = 0; i < 4; ++i) {
      const double sigma = std::sqrt(expected.covariance(i, i));
      EXPECT_NEAR(number(found[k].at(names[i])), expected.mean[i], tolerance * sigma);
      EXPECT_NEAR(number(found[k].at("sigma_" + names[i])), sigma, tolerance * sigma);
    }
  }
}

/// Where the target is after k + 1 seconds.
std::array<double, 4> truth(int k) { return {5000.0 - 60.0 * (k + 1), -3000.0 + 80.0 * (k + 1), -60.0, 80.0}; }

TEST(HimmDemoVelocity, IsAMeasurementOnceItsAccuracyIsGiven) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise;
  Recording both, positions;
  both.text = positions.text = "time_s,x_m,y_m,vx_mps,vy_mps\n";
  for (int k = 0; k < 30; ++k) {
    auto x = truth(k);
    for (std::size_t i = 0; i < 4; ++i) x[i] += (i < 2 ? 12.0 : 0.5) * noise(engine);
    const bool slow = k % 5 == 2, lost = k % 5 == 3;  // without a velocity; with nothing but vy
    const std::string line = exact(k + 1) + "," + (lost ? "," : exact(x[0]) + "," + exact(x[1])) + "," +
                             (slow || lost ? "" : exact(x[2])) + "," + (slow ? "" : exact(x[3])) + "\n";
    both.text += line;
    positions.text += line;
    auto& row = both.rows.emplace_back();
    auto& part = positions.rows.emplace_back();
    for (std::size_t i = 0; i < 4; ++i)
      if (i < 2 ? !lost : !slow && (i == 3 || !lost)) {
        row.push_back(component(i, x[i], i < 2 ? 12.0 : 0.5));
        if (i < 2) part.push_back(row.back());
      }
  }
  expect_filtered(both, {"sigma_velocity_mps=0.5"}, 1e-8);
  expect_filtered(positions, {}, 1e-8);
}

TEST(HimmDemoVelocity, IsMadeOfASpeedInKnotsAndACourse) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> noise;
  Recording recording{"time_s,x_m,y_m,groundspeed_kt,track_deg\n", {}};
  for (int k = 0; k < 30; ++k) {
    auto x = truth(k);
    for (std::size_t i = 0; i < 4; ++i) x[i] += (i < 2 ? 12.0 : 0.5) * noise(engine);
    recording.text += exact(k + 1) + "," + exact(x[0]) + "," + exact(x[1]) + "," +
                      exact(std::hypot(x[2], x[3]) / knot) + "," + exact(90.0 - std::atan2(x[3], x[2]) / degree) + "\n";
    auto& row = recording.rows.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) row.push_back(component(i, x[i], i < 2 ? 12.0 : 0.5));
  }
  expect_filtered(recording, {"sigma_velocity_mps=0.5"}, 1e-8);
}

TEST(HimmDemoVelocity, AlongTheBeamIsMeasuredByARadarAndABearingByACamera) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> noise;
  const auto range = [](const auto& x) { return std::hypot(x[0], x[1]); };
  const auto azimuth = [](const auto& x) { return std::atan2(x[1], x[0]); };
  const auto rate = [](const auto& x) { return (x[0] * x[2] + x[1] * x[3]) / std::hypot(x[0], x[1]); };
  Recording recording{"time_s,sensor,range_m,azimuth_deg,range_rate_mps\n", {}};
  for (int k = 0; k < 40; ++k) {
    const auto x = truth(k);
    const bool camera = k % 3 == 1;
    const double alpha = azimuth(x) + (camera ? 0.01 : 0.3) * degree * noise(engine);
    auto& row = recording.rows.emplace_back();
    row.push_back({alpha, (camera ? 0.01 : 0.3) * degree, azimuth, true});
    if (camera) {
      recording.text += exact(k + 1) + ",camera,," + exact(alpha / degree) + ",\n";
      continue;
    }
    const double r = range(x) + 20.0 * noise(engine), v = rate(x) + 0.2 * noise(engine);
    recording.text += exact(k + 1) + ",radar," + exact(r) + "," + exact(alpha / degree) + "," + exact(v) + "\n";
    row.push_back({r, 20.0, range});
    row.push_back({v, 0.2, rate});
  }
  expect_filtered(recording,
                  {"sensor.radar.sigma_range_m=20", "sensor.radar.sigma_azimuth_deg=0.3",
                   "sensor.radar.sigma_range_rate_mps=0.2", "sensor.camera.sigma_azimuth_deg=0.01"},
                  1e-5);
}

/// Bearings of a target, alone or between positions.
Recording bearings(bool alone) {
  std::mt19937_64 engine(6);
  std::normal_distribution<double> noise;
  Recording recording{alone ? "time_s,azimuth_deg_north\n" : "time_s,x_m,y_m,azimuth_deg_north\n", {}};
  const auto azimuth = [](const auto& x) { return std::atan2(x[1] + 400.0, x[0] - 300.0); };
  for (int k = 0; k < 40; ++k) {
    auto x = truth(k);
    auto& row = recording.rows.emplace_back();
    if (alone || k % 3 == 1) {
      const double alpha = azimuth(x) + 0.05 * degree * noise(engine);
      row.push_back({alpha, 0.05 * degree, azimuth, true});
      recording.text += exact(k + 1) + (alone ? "," : ",,,") + exact(90.0 - alpha / degree) + "\n";
      continue;
    }
    for (std::size_t i = 0; i < 2; ++i) row.push_back(component(i, x[i] += 12.0 * noise(engine), 12.0));
    recording.text += exact(k + 1) + "," + exact(x[0]) + "," + exact(x[1]) + (k % 2 == 0 ? ",\n" : ",77\n");
  }
  return recording;
}

TEST(HimmDemoVelocity, BearingsCountBetweenPositionsAndAlone) {
  for (const bool alone : {false, true}) {
    SCOPED_TRACE(alone);
    expect_filtered(bearings(alone), {"sigma_azimuth_deg=0.05"}, 1e-5, {"--radar-at", "300,-400,0"});
  }
}

/// Where a truth is told, all positions are about one point; the first rows come before there is an estimate.
TEST(HimmDemoVelocity, OfAPlaceIsTakenBeforeTheStartToo) {
  const auto text = recording(
      "time_s,latitude_deg,longitude_deg,true_x_m,true_y_m,vx_mps,vy_mps",
      [](int k) { return exact(k) + "," + exact(50.0 + k * 1e-4) + ",1,0," + exact(k * 11.1229) + ",0,11.1229"; }, 20);
  const auto found = estimates(text, {"sigma_velocity_mps=0.1"});
  ASSERT_EQ(found.size(), 2U * 17U);
  EXPECT_NEAR(number(found.back().at("vy_mps")), 11.1229, 0.01);
  EXPECT_NEAR(number(found.back().at("y_m")), 19 * 11.1229, 0.5);
}

}  // namespace himm_demo_velocity_test
