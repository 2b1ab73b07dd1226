// How a radar's measurements are taken: converted, or in the radar's own space.

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/estimation/unscented.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "apps/recordings.hpp"

namespace himm_demo_radar_test {

using support::degree;

/// A row of a recording: measured by the radar, or else by its position.
struct Row {
  double time;
  Polar seen;
  bool by_radar;
  Vector<3> position;
};

/// What the radar and the filters believe.
const Polar sigma{20.0, degrees(2.0), degrees(1.5)};
const double sigma_position = 15.0;
const Vector<3> radar_at{400.0, -300.0, 10.0};

/// A target that passes west of the radar, so that its azimuth goes through 180°, and turns. Every third row has a
/// position instead of the radar's measurement if there are `others`; with two axes all is on the ground.
std::vector<Row> passing_target(int axes, bool others) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  Vector<3> x = radar_at + Vector<3>(-3000.0, 2500.0, axes == 3 ? 900.0 : -radar_at.z());
  double heading = -0.5 * std::numbers::pi;
  std::vector<Row> rows;
  double time = 0.0;
  for (int k = 0; k < 90; ++k) {
    const double dt = 0.5 + 0.25 * (k % 4);
    time += dt;
    x += dt * Vector<3>(60.0 * std::cos(heading), 60.0 * std::sin(heading), 0.0);
    if (k > 40) heading += 0.03 * dt;
    Vector<3> from_radar = x - radar_at;
    if (axes == 2) from_radar.z() = 0.0;
    Polar seen = to_polar(from_radar);
    seen.range += sigma.range * normal(engine);
    seen.azimuth += normal(engine) * sigma.azimuth;
    if (axes == 3) seen.elevation += normal(engine) * sigma.elevation;
    Vector<3> position = x;
    for (int axis = 0; axis < axes; ++axis) position(axis) += sigma_position * normal(engine);
    rows.push_back({time, seen, !(others && k % 3 == 2), position});
  }
  return rows;
}

std::string csv(const std::vector<Row>& rows, int axes) {
  std::string text = axes == 3 ? "time_s,sensor,x_m,y_m,z_m,range_m,azimuth_deg,elevation_deg\n"
                               : "time_s,sensor,x_m,y_m,range_m,azimuth_deg\n";
  for (const auto& row : rows) {
    text += exact(row.time) + (row.by_radar ? ",radar" : ",beacon");
    for (int axis = 0; axis < axes; ++axis) text += row.by_radar ? "," : "," + exact(row.position(axis));
    const std::array seen = {row.seen.range, row.seen.azimuth.degrees(), row.seen.elevation.degrees()};
    for (int i = 0; i < axes; ++i) text += row.by_radar ? "," + exact(seen[static_cast<std::size_t>(i)]) : ",";
    text += "\n";
  }
  return text;
}

std::vector<TextRow> followed(const std::string& text, const Arguments& settings) {
  return estimates(text,
                   settings + Arguments{"filters=imm", "sigma_range_m=20", "sigma_azimuth_deg=2",
                                        "sigma_elevation_deg=1.5", "sigma_position_m=15"},
                   {"--radar-at=400,-300,10"});
}

template <int Axes>
Gaussian<Axes> converted(const Row& row, Conversion conversion) {
  if (!row.by_radar)
    return {row.position.head<Axes>(), sigma_position * sigma_position * SquareMatrix<Axes>::Identity()};
  Polar deviations = sigma;
  if (Axes == 2) deviations.elevation = Angle{};
  const Gaussian<3> z = to_cartesian(row.seen, deviations, conversion);
  const Vector<3> moved = z.mean + radar_at;
  return {moved.head<Axes>(), z.covariance.topLeftCorner<Axes, Axes>()};
}

template <int Axes>
void expect_near(const TextRow& found, const Gaussian<2 * Axes>& expected, double nis) {
  expect_row(found, {entries(expected.mean), dense(expected.covariance)}, Axes);
  ASSERT_CLOSE(std::stod(found.at("nis")), nis, 1e-9);
}

/// One model alone is filtered by hand: `take(row, estimate)` updates by a row and gives the NIS.
template <int Axes, class Take>
void equals_by_hand(const std::vector<Row>& rows, const std::vector<std::string>& sets, Conversion start,
                    const Take& take) {
  const auto found = followed(csv(rows, Axes), sets);
  ASSERT_EQ(found.size(), rows.size() - 3);
  const auto model = dwna<Axes>(2.0);
  auto estimate = two_point_start<Axes>({rows[1].time, converted<Axes>(rows[1], start)},
                                        {rows[2].time, converted<Axes>(rows[2], start)});
  for (std::size_t k = 3; k < rows.size(); ++k) {
    SCOPED_TRACE("row " + std::to_string(k));
    predict(model, estimate, rows[k].time - rows[k - 1].time, estimate);
    const double nis = take(rows[k], estimate);
    expect_near<Axes>(found[k - 3], estimate, nis);
    if (testing::Test::HasFatalFailure()) return;
  }
}

template <int Axes>
void equals_each_conversion_by_hand() {
  for (const auto& [name, conversion] : {std::pair{"standard", Conversion::standard},
                                         {"unbiased", Conversion::unbiased},
                                         {"debiased", Conversion::debiased}})
    equals_by_hand<Axes>(passing_target(Axes, true),
                         {"models=[dwna]", "sigma_w=2", std::string("radar_measurement=") + name}, conversion,
                         [c = conversion](const Row& row, auto& estimate) {
                           return update(dwna<Axes>(2.0), estimate, converted<Axes>(row, c), estimate).squared_distance;
                         });
}

TEST(HimmDemoRadar, EachConversionIsTheLibrarys) {
  equals_each_conversion_by_hand<2>();
  equals_each_conversion_by_hand<3>();
}

template <int Axes, template <class> class Member>
void equals_own_space_by_hand(const std::string& member) {
  const PolarSensor<Axes> radar{Vector<Axes>(radar_at.head<Axes>())};
  const Member seen{dwna<Axes>(2.0)};
  equals_by_hand<Axes>(
      passing_target(Axes, true), {"models=[dwna]", "sigma_w=2", "radar_measurement=polar", "member=" + member},
      Conversion::unbiased, [&](const Row& row, auto& estimate) {
        if (!row.by_radar)
          return update(dwna<Axes>(2.0), estimate, converted<Axes>(row, Conversion::standard), estimate)
              .squared_distance;
        return update(seen, estimate, radar.measurement(row.seen, sigma), estimate).squared_distance;
      });
}

TEST(HimmDemoRadar, InItsOwnSpaceBesidePositionsIsTheMemberOfEachRow) {
  equals_own_space_by_hand<2, Extended>("ekf");
  equals_own_space_by_hand<3, Extended>("ekf");
  equals_own_space_by_hand<2, Unscented>("ukf");
  equals_own_space_by_hand<3, Cubature>("ckf");
}

TEST(HimmDemoRadar, InItsOwnSpaceEveryModelOfAFilterSeesIt) {
  const auto rows = passing_target(2, false);
  const auto found = followed(csv(rows, 2), {"models=[dwna,ct]", "member=ukf", "radar_measurement=polar",
                                             "sigma_w=[2,0.5]", "turn_drift_deg_s=0.3", "start_sigma_turn_deg_s=4",
                                             "transition_probability=[[0.9,0.1],[0.2,0.8]]"});
  ASSERT_EQ(found.size(), rows.size() - 3);
  const PolarSensor<2> radar{Vector<2>(radar_at.head<2>())};
  const std::tuple models{Unscented{dwna<2>(2.0)}, Unscented{CoordinatedTurn<2>(0.5, 0.3 * degree)}};
  const auto straight = two_point_start<2>({rows[1].time, converted<2>(rows[1], Conversion::unbiased)},
                                           {rows[2].time, converted<2>(rows[2], Conversion::unbiased)});
  Gaussian<5> turning{Vector<5>::Zero(), SquareMatrix<5>::Zero()};
  turning.mean.head<4>() = straight.mean;
  turning.covariance.topLeftCorner<4, 4>() = straight.covariance;
  turning.covariance(4, 4) = 16.0 * degree * degree;
  const RandomVariable mode{"mode", 2};
  InteractingMultipleModel filter{models, Relation{mode, mode, {{0.9, 0.1}, {0.2, 0.8}}},
                                  std::tuple{straight, turning}};
  for (std::size_t k = 3; k < rows.size(); ++k) {
    filter.step(rows[k].time - rows[k - 1].time, radar.measurement(rows[k].seen, sigma));
    const auto estimate = filter.estimate();
    const auto& row = found[k - 3];
    SCOPED_TRACE("row " + std::to_string(k));
    expect_near<2>(row, {estimate.mean.head<4>(), estimate.covariance.topLeftCorner<4, 4>()}, filter.nis());
    if (testing::Test::HasFatalFailure()) return;
    ASSERT_CLOSE(std::stod(row.at("turn_rate_deg_s")), estimate.mean(4) / degree, 1e-9);
    EXPECT_EQ(row.at("ax_mps2"), "");
    ASSERT_CLOSE(std::stod(row.at("weight_ct")), filter.belief()[1], 1e-9);
  }
}

/// The rows of a text whose time is `from` or later.
std::string later(const std::string& text, double from) {
  std::string result = text.substr(0, text.find('\n') + 1);
  for (auto line = result.size(); line < text.size(); line = text.find('\n', line) + 1)
    if (std::stod(text.substr(line)) >= from) result += text.substr(line, text.find('\n', line) + 1 - line);
  return result;
}

TEST(HimmDemoRadar, InItsOwnSpaceAMissedRowIsAPredictionAndAfterAGapItStartsAgain) {
  auto rows = passing_target(2, true);
  for (std::size_t k = 45; k < rows.size(); ++k) rows[k].time += 100.0;
  const double again = rows[45].time;
  std::string text = csv(rows, 2);
  const auto missed = text.find("\n" + exact(rows[60].time) + ",");  // by the radar
  text.replace(missed, text.find('\n', missed + 1) - missed, "\n" + exact(rows[60].time) + ",radar,,,,");
  const std::vector<std::string> sets = {"models=[dwna,ct]", "member=ckf", "radar_measurement=polar",
                                         "restart_after_s=50"};
  auto all = followed(text, sets);
  std::erase_if(all, [&](const TextRow& row) { return std::stod(row.at("time_s")) < again; });
  EXPECT_EQ(all, followed(later(text, again), sets));
  ASSERT_EQ(all.size(), rows.size() - 45 - 3);
  EXPECT_EQ(all[60 - 48].at("nis"), "");
  EXPECT_NE(all[61 - 48].at("nis"), "");
}

}  // namespace himm_demo_radar_test
