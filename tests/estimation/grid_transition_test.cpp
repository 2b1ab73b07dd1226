#include "support/sigmax.hpp"

namespace grid_transition_test {

const SquareMatrix<2> Q{{2.0, -0.6}, {-0.6, 0.5}};
const Grid<2> grid{{-4.0, -3.0}, {5.0, 3.0}, {0.5, 0.25}};
const Vector<2> m{0.3, -0.1};

/// The row of noise around m, with the quadratic form by hand, divided by its sum or maximum.
template <Uncertainty Kind>
void expect_row(double negligible, bool divided_by_sum) {
  const GridNoise<2> noise(Q, negligible);
  const auto relation =
      grid_transition<Kind>(grid, {"to", grid.size()}, {"from", 1}, negligible,
                            [&](const Grid<2>& to, std::size_t, GridRow& row) { noise.fill(to, m, row); });
  std::vector<double> expected(grid.size());
  double greatest = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double x = grid.centre(i)(0) - m(0), y = grid.centre(i)(1) - m(1);
    expected[i] = std::exp(-0.5 * (0.5 * x * x + 2.0 * 0.6 * x * y + 2.0 * y * y) / (2.0 * 0.5 - 0.6 * 0.6));
    greatest = std::max(greatest, expected[i]);
  }
  for (double& value : expected) {
    if (value < negligible * greatest) value = 0.0;
    sum += value;
  }
  for (double& value : expected) value /= divided_by_sum ? sum : greatest;
  std::vector<double> found(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) found[i] = relation(0, i);
  EXPECT_CLOSE(found, expected, 1e-14);
}

TEST(GridTransition, IsTheNoiseNormalisedByTheStatesOwnSum) {
  for (const double negligible : {1e-3, 1e-16}) {
    expect_row<Random>(negligible, true);
    expect_row<Fuzzy>(negligible, false);
  }
}

TEST(GridTransition, OfNoiseNarrowerThanACellGoesToTheNearest) {
  const GridNoise<2> noise(1e-8 * SquareMatrix<2>::Identity(), 1e-12);
  const auto relation =
      grid_transition<Random>(grid, {"to", grid.size()}, {"from", 1}, 1e-12,
                              [&](const Grid<2>& to, std::size_t, GridRow& row) { noise.fill(to, m, row); });
  EXPECT_EQ(relation(0, grid.cell(grid.place_of(m))), 1.0);
}

TEST(GridNoise, IsAsWideAlongAnAxisAsTheOtherComponentLeavesIt) {
  const GridNoise<2> noise(Q, std::exp(-0.5 * 9.0));
  EXPECT_CLOSE(noise.widths()(0), std::sqrt(2.0 - 0.6 * 0.6 / 0.5), 1e-15);
  EXPECT_CLOSE(noise.widths()(1), std::sqrt(0.5 - 0.6 * 0.6 / 2.0), 1e-15);
  EXPECT_CLOSE(noise.reach()(0), 3.0 * std::sqrt(2.0), 1e-14);
}

TEST(GridNoise, NeedsAPositiveDefiniteCovariance) {
  EXPECT_REFUSED(std::domain_error, ("process covariance", "not positive definite"),
                 GridNoise<2>(SquareMatrix<2>::Ones(), 1e-12));
}

}  // namespace grid_transition_test
