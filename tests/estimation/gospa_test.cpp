#include "support/sigmax.hpp"

namespace gospa_test {

/// Least Σ over all partial assignments of row i and those after it, restated: none costs cᵖ/2 a row and a column.
double least(const Table& d, double c, double p, std::size_t i, std::vector<bool>& used) {
  const double none = 0.5 * std::pow(c, p);
  if (i == d.rows()) return none * static_cast<double>(std::ranges::count(used, false));
  double result = none + least(d, c, p, i + 1, used);
  for (std::size_t j = 0; j < d.columns(); ++j) {
    if (used[j]) continue;
    used[j] = true;
    result = std::min(result, std::pow(d(i, j), p) + least(d, c, p, i + 1, used));
    used[j] = false;
  }
  return result;
}

/// The definition of OSPA: all permutations of the larger set.
double ospa_by_permutations(const PointSet& small, const PointSet& large, double c, double p) {
  if (small.size() > large.size()) return ospa_by_permutations(large, small, c, p);
  std::vector<std::size_t> order(large.size());
  std::iota(order.begin(), order.end(), 0U);
  double result = infinity;
  do {
    double sum = std::pow(c, p) * static_cast<double>(large.size() - small.size());
    for (std::size_t i = 0; i < small.size(); ++i)
      sum += std::pow(std::min(c, std::abs(small[i][0] - large[order[i]][0])), p);
    result = std::min(result, sum);
  } while (std::ranges::next_permutation(order).found);
  return large.empty() ? 0.0 : std::pow(result / static_cast<double>(large.size()), 1.0 / p);
}

/// Up to five points on a line, some of them equal.
PointSet points() {
  PointSet result;
  for (const int x : *rc::gen::resize(5, rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 40))))
    result.push_back({0.5 * x});
  return result;
}

PROPERTY(Gospa, AsAllAssignmentsTellIt) {
  const PointSet x = points(), y = points();
  const GospaSettings settings{*rc::gen::element(0.5, 3.0, 10.0, 100.0), *rc::gen::element(1.0, 2.0, 3.5)};
  const auto [c, p] = settings;
  Table d(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j) d(i, j) = std::abs(x[i][0] - y[j][0]);
  const Gospa found = gospa(x, y, settings);
  std::vector<bool> used(y.size());
  require_near(std::pow(found.value, p), least(d, c, p, 0, used), 1e-12);
  require_near(ospa(x, y, settings), ospa_by_permutations(x, y, c, p), 1e-12);

  Gospa parts;
  std::set<std::size_t> taken;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (const auto estimate = found.estimate_of[i]) {
      RC_ASSERT(taken.insert(*estimate).second);
      RC_ASSERT(d(i, *estimate) < c);
      parts.localisation += std::pow(d(i, *estimate), p);
    } else {
      parts.missed += 0.5 * std::pow(c, p);
    }
  }
  parts.false_targets = 0.5 * std::pow(c, p) * static_cast<double>(y.size() - taken.size());
  require_near(found.localisation, parts.localisation);
  require_near(found.missed, parts.missed);
  require_near(found.false_targets, parts.false_targets);
}

PROPERTY(Gospa, IsAMetric) {
  const PointSet x = points(), y = points(), z = points();
  const GospaSettings settings{4.0, *rc::gen::element(1.0, 2.0)};
  RC_ASSERT(gospa(x, x, settings).value == 0.0);
  require_near(gospa(x, y, settings).value, gospa(y, x, settings).value, 1e-12);
  RC_ASSERT(gospa(x, z, settings).value <= gospa(x, y, settings).value + gospa(y, z, settings).value + 1e-12);
  RC_ASSERT(ospa(x, z, settings) <= ospa(x, y, settings) + ospa(y, z, settings) + 1e-12);
}

TEST(Gospa, InAPlaneByHand) {
  const Gospa found = gospa({{0.0, 0.0}, {100.0, 0.0}}, {{50.0, 50.0}, {3.0, 4.0}, {100.0, 90.0}});
  EXPECT_EQ(found.estimate_of, (std::vector<std::optional<std::size_t>>{1, std::nullopt}));
  EXPECT_CLOSE(found.localisation, 25.0, 1e-15);
  EXPECT_CLOSE(found.missed, 50.0, 1e-15);
  EXPECT_CLOSE(found.false_targets, 100.0, 1e-15);
  EXPECT_CLOSE(found.value, std::sqrt(175.0), 1e-15);
}

TEST(Gospa, OfManyTargets) {
  PointSet truth, estimates;
  for (int i = 0; i < 500; ++i) {
    truth.push_back({100.0 * i, 0.0});
    if (i % 10 != 0) estimates.push_back({100.0 * i, 1.0});
  }
  std::ranges::reverse(estimates);
  EXPECT_CLOSE(gospa(truth, estimates).value, std::sqrt(450.0 + 50.0 * 50.0), 1e-12);
}

TEST(Gospa, Refuses) {
  EXPECT_INVALID(("cutoff", "0.0", "order 2.0"), gospa(PointSet{}, {}, {0.0, 2.0}));
  EXPECT_INVALID(("order >= 1", "0.5"), ospa(PointSet{}, {}, {1.0, 0.5}));
  EXPECT_INVALID(("cutoff"), gospa(PointSet{}, {}, {infinity, 2.0}));
  EXPECT_INVALID(("1 coordinates", "2"), gospa({{0.0, 1.0}}, {{0.0}}));
  EXPECT_INVALID(("nan"), gospa({{0.0}}, {{not_a_number}}));
}

}  // namespace gospa_test
