// The grid filter of more than one dimension, which takes long to compile.

#include "support/sigmax.hpp"

namespace grid_filter_space_test {

// Functions are of one type for each dimension, so that a filter is compiled once.
template <int N>
using Log = std::function<double(const Vector<N>&)>;
template <int N>
using Dynamics = std::function<Vector<N>(const Vector<N>&)>;

double parabola(double x, double variance) { return -0.5 * x * x / variance; }

/// Position and velocity that leave the first grid far behind, with correlated noise.
template <Uncertainty Kind>
void expect_to_follow(double tolerance) {
  const SquareMatrix<2> F{{1.0, 1.0}, {0.0, 1.0}}, Q{{4.0, 3.0}, {3.0, 6.0}};
  const FixedStepMotion<2> model("line", {"x", "v"}, 1.0, F, Q);
  Gaussian<2> kalman{{0.0, 100.0}, SquareMatrix<2>{{25.0, 0.0}, {0.0, 9.0}}};
  const Log<2> start = [](const Vector<2>& x) { return parabola(x(0), 25.0) + parabola(x(1) - 100.0, 9.0); };
  GridFilter<Kind, 2> filter{Grid<2>{{-25.0, 85.0}, {25.0, 115.0}, {1.0, 1.0}}, start, {1e-5, 10}};
  for (int k = 1; k <= 4; ++k) {
    const Gaussian<1> z{Vector<1>{100.0 * k + 3.0 * std::sin(k)}, SquareMatrix<1>{4.0}};
    predict(model, kalman, 1.0, kalman);
    update(model, kalman, z, PositionSensor<1>{}, kalman);
    filter.predict(Dynamics<2>([&](const Vector<2>& x) { return F * x; }), Q);
    filter.update(Log<2>([&](const Vector<2>& x) { return parabola(z.mean(0) - x(0), 4.0); }));
    EXPECT_LT(filter.grid().size(), 10000U);
    const Gaussian<2> found = filter.moments();
    for (const int i : {0, 1}) {
      EXPECT_CLOSE(found.mean(i), kalman.mean(i), tolerance);
      for (const int j : {0, 1}) EXPECT_CLOSE(found.covariance(i, j), kalman.covariance(i, j), 10.0 * tolerance);
    }
  }
}

TEST(GridFilter, FollowsTheStateThroughThePlane) {
  expect_to_follow<Random>(1e-4);
  expect_to_follow<Fuzzy>(1e-2);
}

constexpr double deviations[] = {1.0, 0.7, 1.4}, seen[] = {2.0, -1.0, 0.0};

/// Independent walks along these axes.
template <Uncertainty Kind, int N>
GridFilter<Kind, N> walked(const Eigen::Matrix<int, N, 1>& axes) {
  const Vector<N> ends = Vector<N>::Constant(4.0);
  Vector<N> Q, z;
  for (int i = 0; i < N; ++i) {
    Q(i) = deviations[axes(i)] * deviations[axes(i)];
    z(i) = seen[axes(i)];
  }
  const Log<N> start = [](const Vector<N>& x) { return parabola(x.norm(), 1.0); };
  GridFilter<Kind, N> filter{Grid<N>{-ends, ends, Vector<N>::Ones()}, start, {1e-4, 4}};
  filter.predict(Dynamics<N>([](const Vector<N>& x) { return 1.5 * x; }), Q.asDiagonal());
  filter.update(Log<N>([&](const Vector<N>& x) { return parabola((x - z).norm(), 2.0); }));
  return filter;
}

TYPED_SUITE(GridFilterInSpace, Random, Fuzzy);

/// The grid of three dimensions has the beliefs of grids of any two of them.
TYPED_TEST(GridFilterInSpace, HasTheBeliefsOfItsPlanes) {
  const auto space = walked<TypeParam, 3>({0, 1, 2});
  for (const int axis : {0, 1, 2}) {
    const auto plane = walked<TypeParam, 2>({axis, (axis + 1) % 3});
    EXPECT_EQ(space.grid().step()(axis), plane.grid().step()(0));
    EXPECT_CLOSE(space.moments().mean(axis), plane.moments().mean(0), 2e-3);
    EXPECT_CLOSE(space.moments().covariance(axis, axis), plane.moments().covariance(0, 0), 2e-2);
    EXPECT_CLOSE(space.most_likely()(axis), plane.most_likely()(0), 1e-12);
  }
}

}  // namespace grid_filter_space_test
