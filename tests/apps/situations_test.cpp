#include "himm_demo/associate/associate.hpp"

#include <sigmax/estimation/root_mean_square.hpp>

#include "support/test.hpp"

namespace situations_test {

/// A situation as it is seen by default, and otherwise.
Scene drawn(const std::string& situation, std::uint64_t seed, int radars = 0, double detection_probability = 0.9) {
  AssociateOptions options;
  options.situation = situation;
  options.radars = radars;
  options.rules.detection_probability = detection_probability;
  return simulate(options, seed);
}

/// What depends on the seed: what is seen in a scan, and where everybody is.
Rows seen(const Scene& scene, std::size_t scan) {
  return each(scene.scans[scan], [](const Row& row) { return Numbers{row.detection.z[0], row.detection.z[1]}; });
}
std::vector<PointSet> truth(const Scene& scene) { return each(scene.truth, &Trajectory::positions); }

TEST(Situations, DependOnTheSeedAlone) {
  for (const auto& [situation, speed, sets] : situations) {
    const Scene scene = drawn(situation, 7);
    EXPECT_EQ(seen(scene, 30), seen(drawn(situation, 7), 30));
    EXPECT_EQ(truth(scene), truth(drawn(situation, 7, 2, 0.5)));
    EXPECT_NE(truth(scene), truth(drawn(situation, 8)));
  }
  // Drawn by g++. Here clang once evaluated the operands of a sum, and so drew, in the other order.
  EXPECT_CLOSE(drawn("dense", 1).truth[0].positions[0][0], 1040.6912186197571, 1e-6);
}

/// Errors in their standard deviations, shares of detections, and false detections, over 20 seeds.
TEST(Situations, AreSeenAsToldForEachKindOfSensor) {
  for (const auto& [situation, speed, sets] : situations)
    for (const int radars : {0, 4}) {
      RootMeanSquare errors;
      double alive = 0.0, detected = 0.0, spurious = 0.0, expected = 0.0;
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Scene scene = drawn(situation, seed, radars);
        for (const auto& [start, path] : scene.truth) alive += static_cast<double>(path.size());
        for (std::size_t k = 0; k < scene.scans.size(); ++k) {
          expected += situation == "dense" ? 60.0 : 10.0;
          for (std::size_t tag = 0; const Row& row : scene.scans[k]) {
            const AnyDetection& detection = row.detection;
            EXPECT_EQ(detection.tag, tag++);
            if (row.measured()) ++(row.truth ? detected : spurious);
            if (!row.truth) continue;
            const auto& [start, path] = scene.truth[std::stoul(row.track) - 1];
            EXPECT_EQ((Numbers{(*row.truth)[0], (*row.truth)[1]}), path[k - start]);
            if (!row.measured()) continue;
            const double dx = (*row.truth)[0] - detection.origin[0], dy = (*row.truth)[1] - detection.origin[1];
            const double first = radars == 0 ? dx : std::hypot(dx, dy), second = radars == 0 ? dy : std::atan2(dy, dx);
            errors.add((detection.z[0] - first) / std::sqrt(detection.variance(0)));
            errors.add((detection.z[1] - second) / std::sqrt(detection.variance(1)));
          }
        }
      }
      EXPECT_CLOSE(errors.value(), 1.0, 0.05);
      EXPECT_CLOSE(detected / alive, 0.9, 0.02);
      EXPECT_CLOSE(spurious / expected, 1.0, 0.05);
    }
}

/// The least distance of two targets at one scan, and when.
std::pair<double, std::size_t> least_distance(const Scene& scene, std::size_t i, std::size_t j) {
  std::pair<double, std::size_t> result{1e9, 0};
  const auto &x = scene.truth[i], &y = scene.truth[j];
  for (std::size_t k = std::max(x.start, y.start); k < scene.scans.size(); ++k)
    if (k - x.start < x.positions.size() && k - y.start < y.positions.size()) {
      const auto &p = x.positions[k - x.start], &q = y.positions[k - y.start];
      result = std::min(result, {std::hypot(p[0] - q[0], p[1] - q[1]), k});
    }
  return result;
}

TEST(Situations, AreWhatTheirNamesSay) {
  RootMeanSquare differences;  // of second order: √(2 q T³/3), before the middle and after
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(least_distance(drawn("crossing", seed), 0, 1), (std::pair<double, std::size_t>{0.0, 30}));
    EXPECT_LT(least_distance(drawn("parallel", seed), 0, 1).first, 150.0);
    EXPECT_EQ(least_distance(drawn("splitting", seed), 0, 1), (std::pair<double, std::size_t>{0.0, 20}));
    EXPECT_LT(least_distance(drawn("manoeuvring", seed), 0, 1).first, 600.0);
    EXPECT_EQ(drawn("dense", seed).truth.size(), 12U);
    const Scene meeting = drawn("meeting", seed);
    const auto alive = [&](std::size_t k) {
      return std::ranges::count_if(meeting.scans[k], [](const Row& row) { return row.truth.has_value(); });
    };
    EXPECT_EQ(alive(39), 4);
    EXPECT_EQ(alive(40), 3);
    EXPECT_LT(least_distance(meeting, 1, 2).first, 3.0);
    for (const auto& [start, path] : meeting.truth)
      for (std::size_t k = 2; k < path.size(); ++k) differences.add(path[k][0] - 2.0 * path[k - 1][0] + path[k - 2][0]);
  }
  EXPECT_CLOSE(differences.value(), std::sqrt(2.0 * 0.01 / 3.0), 0.002);
}

}  // namespace situations_test
