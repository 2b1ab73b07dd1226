#include "support/sigmax.hpp"

namespace trajectory_gospa_test {

using Trajectories = std::vector<Trajectory>;

/// On a line from a scan on.
Trajectory line(std::size_t start, const Numbers& positions) {
  Trajectory result{start, {}};
  for (const double x : positions) result.positions.push_back(std::isnan(x) ? Numbers{} : Numbers{x});
  return result;
}

/// The six examples of IEEE TSP 68:3917, by the figures that its authors published as MATLAB: δ = 1, Δ = 0.1.
struct Published {
  Trajectories truth, tracks;
  double value, localisation, missed, switches;
};

TEST(TrajectoryGospa, OfTheSixPublishedExamples) {
  const Trajectory ones = line(0, {1, 1, 1, 1, 1});
  const Trajectories two{line(0, {1, 1, 1, 1}), line(0, {2.2, 2.2, 2.2, 2.2})};
  const Trajectories three{ones, line(0, {2.2, 2.2, 2.2}), line(3, {2.2, 2.2})};
  const Trajectory first = line(0, {1.1, 1.1, 1.1}), second = line(3, {1.1, 1.1});
  const Trajectory four = line(0, {2, 2, 2, 2});
  const std::vector<Published> examples{
      {{ones}, {line(0, {2, 2, 2, 2, 2})}, 5.0, 5.0, 0.0, 0.0},
      {{ones}, {four}, 6.5, 4.0, 2.5, 0.0},
      {{ones}, {first, second}, 1.5, 0.5, 0.0, 1.0},
      {three, {first, second, line(0, {2.1, 2.1, 2.1, 2.1, 2.1})}, 3.0, 1.0, 0.0, 2.0},
      {two, {line(0, {2, 2, 1.2, 1.2}), line(0, {1.2, 1.2, 2, 2})}, 3.6, 1.6, 0.0, 2.0},
      {two, {four, line(0, {1.2, 1.2}), line(2, {1.2, 1.2})}, 2.6, 1.6, 0.0, 1.0}};
  for (const auto& [truth, tracks, value, localisation, missed, switches] : examples) {
    const TrajectoryGospa found = trajectory_gospa(truth, tracks, {5.0, 1.0, 1.0});
    const TrajectoryGospa mirrored = trajectory_gospa(tracks, truth, {5.0, 1.0, 1.0});
    for (const auto& [metric, missed_there, false_there] :
         {std::tuple{found, missed, 0.0}, std::tuple{mirrored, 0.0, missed}}) {
      EXPECT_CLOSE(metric.value, value, 1e-12);
      EXPECT_CLOSE(metric.localisation, localisation, 1e-12);
      EXPECT_CLOSE(metric.missed, missed_there, 1e-12);
      EXPECT_CLOSE(metric.false_targets, false_there, 1e-12);
      EXPECT_CLOSE(metric.switches, switches, 1e-12);
      EXPECT_TRUE(metric.exact);
    }
  }
}

/// The definition: dynamic programming over all assignments at all scans, the partner of each target or −1.
using Assignment = std::vector<int>;
void all_assignments(std::size_t tracks, Assignment& begun, std::size_t i, std::vector<Assignment>& result) {
  if (i == begun.size()) return result.push_back(begun);
  for (int j = -1; j < static_cast<int>(tracks); ++j) {
    if (j >= 0 && std::ranges::count(std::span{begun}.first(i), j) > 0) continue;
    begun[i] = j;
    all_assignments(tracks, begun, i + 1, result);
  }
}

std::optional<double> at(const Trajectory& trajectory, std::size_t scan) {
  if (scan < trajectory.start || scan >= trajectory.start + trajectory.positions.size()) return std::nullopt;
  const auto& point = trajectory.positions[scan - trajectory.start];
  return point.empty() ? std::nullopt : std::optional{point[0]};
}

constexpr int last = 7;  ///< scans

double restated(const Trajectories& truth, const Trajectories& tracks, double c, double p, double g) {
  std::vector<Assignment> all;
  Assignment begun(truth.size());
  all_assignments(tracks.size(), begun, 0, all);
  const double none = 0.5 * std::pow(c, p);
  Numbers costs(all.size(), 0.0);
  for (std::size_t k = 0; k < last; ++k) {
    Numbers next(all.size(), infinity);
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = 0; b < all.size(); ++b) {
        double switches = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i)
          if (all[a][i] != all[b][i]) switches += all[a][i] < 0 || all[b][i] < 0 ? 0.5 : 1.0;
        next[a] = std::min(next[a], costs[b] + (k == 0 ? 0.0 : std::pow(g, p) * switches));
      }
      std::vector<bool> used(tracks.size());
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const auto x = at(truth[i], k);
        const auto y = all[a][i] < 0 ? std::nullopt : at(tracks[static_cast<std::size_t>(all[a][i])], k);
        if (all[a][i] >= 0) used[static_cast<std::size_t>(all[a][i])] = true;
        if (x && y) next[a] += std::pow(std::min(c, std::abs(*x - *y)), p);
        if (x.has_value() != y.has_value()) next[a] += none;
      }
      for (std::size_t j = 0; j < tracks.size(); ++j)
        if (!used[j] && at(tracks[j], k)) next[a] += none;
    }
    costs = next;
  }
  return std::pow(*std::ranges::min_element(costs), 1.0 / p);
}

int drawn(int from, int end) { return *rc::gen::resize(100, rc::gen::inRange(from, end)); }

/// Most often three trajectories, with gaps, on few places, so that they meet and cross.
Trajectories trajectories() {
  Trajectories result;
  for (int n = std::min(3, drawn(0, 9)); n > 0; --n) {
    const int start = std::max(0, drawn(-6, last)), end = std::min(last, drawn(start, last + 8));
    Numbers positions;
    for (int k = start; k < end; ++k) positions.push_back(drawn(0, 10) == 0 ? not_a_number : 0.5 * drawn(0, 10));
    result.push_back(line(static_cast<std::size_t>(start), positions));
  }
  return result;
}

PROPERTY(TrajectoryGospa, AsAllSequencesOfAssignmentsTellIt) {
  const Trajectories truth = trajectories(), tracks = trajectories();
  const double c = *rc::gen::element(1.2, 3.0, 20.0), p = *rc::gen::element(1.0, 2.0);
  const double g = *rc::gen::element(0.1, 0.7, 1.0, 4.0);
  const TrajectoryGospa found = trajectory_gospa(truth, tracks, {c, p, g});
  RC_ASSERT(found.exact);
  require_near(found.value, restated(truth, tracks, c, p, g), 1e-12);
  require_near(std::pow(found.value, p), found.localisation + found.missed + found.false_targets + found.switching);
  const TrajectoryGospa mirrored = trajectory_gospa(tracks, truth, {c, p, g});
  require_near(mirrored.value, found.value, 1e-12);
  const TrajectoryGospa bound = trajectory_gospa(truth, tracks, {c, p, g, 1});
  RC_ASSERT(bound.value >= found.value - 1e-12);
  if (bound.exact) require_near(bound.value, found.value, 1e-12);
}

PROPERTY(TrajectoryGospa, ObeysTheTriangleInequality) {
  const Trajectories x = trajectories(), y = trajectories(), z = trajectories();
  const TrajectoryGospaSettings settings{3.0, *rc::gen::element(1.0, 2.0), 0.8};
  RC_ASSERT(trajectory_gospa(x, x, settings).value == 0.0);
  RC_ASSERT(trajectory_gospa(x, z, settings).value <=
            trajectory_gospa(x, y, settings).value + trajectory_gospa(y, z, settings).value + 1e-12);
}

TEST(TrajectoryGospa, OfOneScanIsGospa) {
  const PointSet x{{0.0, 0.0}, {3.0, 0.0}, {40.0, 1.0}}, y{{1.0, 1.0}, {2.0, -1.0}, {41.0, 5.0}, {90.0, 0.0}};
  Trajectories truth, tracks;
  for (const auto& point : x) truth.push_back({4, {point}});
  for (const auto& point : y) tracks.push_back({4, {point}});
  EXPECT_CLOSE(trajectory_gospa(truth, tracks).value, gospa(x, y).value, 1e-12);
}

TEST(TrajectoryGospa, Refuses) {
  const Trajectories one{line(0, {1.0})};
  EXPECT_INVALID(("cutoff"), trajectory_gospa(one, one, {0.0, 1.0, 1.0}));
  EXPECT_INVALID(("switch penalty", "0.0"), trajectory_gospa(one, one, {1.0, 1.0, 0.0}));
  EXPECT_INVALID(("state"), trajectory_gospa(one, one, {1.0, 1.0, 1.0, 0}));
  EXPECT_INVALID(("2 coordinates", "1"), trajectory_gospa(one, Trajectories{{0, {{1.0, 2.0}}}}));
  EXPECT_INVALID(("inf"), trajectory_gospa(one, Trajectories{{0, {{infinity}}}}));
}

}  // namespace trajectory_gospa_test
