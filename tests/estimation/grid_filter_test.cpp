#include "support/sigmax.hpp"

namespace grid_filter_test {

using Function = std::function<double(double)>;

double parabola(double x, double variance) { return -0.5 * x * x / variance; }
SquareMatrix<1> variance(double value) { return SquareMatrix<1>{value}; }

/// A filter on a line, of functions of a number: of one type, so that it is compiled once for each kind.
template <Uncertainty Kind>
struct OnLine : GridFilter<Kind, 1> {
  using Base = GridFilter<Kind, 1>;
  static auto at(const Function& function) {
    return [&function](const Vector<1>& x) { return function(x(0)); };
  }
  OnLine(double lower, double upper, double step, const Function& log, const GridOptions& options = {})
      : Base({Vector<1>{lower}, Vector<1>{upper}, Vector<1>{step}}, at(log), options) {}
  void predict(const Function& f, double Q) {
    Base::predict([&](const Vector<1>& x) { return Vector<1>{f(x(0))}; }, variance(Q));
  }
  double update(const Function& log_likelihood) { return Base::update(at(log_likelihood)); }
  double step() const { return this->grid().step()(0); }
};

double grown(double x, int k) { return 0.5 * x + 25.0 * x / (1.0 + x * x) + 8.0 * std::cos(1.2 * k); }

/// The growth model by brute force, on a grid that is fine everywhere: (23), (24) with `plus` a sum, (36), (37) with a
/// maximum. The filter with its default options is right to 1 % of the deviation, about 8.
template <Uncertainty Kind, class Plus>
void expect_brute_force(const Plus& plus, double of_mean, double of_evidence) {
  const double Q = 10.0, R = 1.0, h = 0.025, end = 30.0;
  OnLine<Kind> filter{-20.0, 20.0, 0.2, [](double x) { return parabola(x, 5.0); }};
  std::vector<double> x, belief;
  double total = 0.0;
  for (double at = -end; at <= end; at += h) {
    x.push_back(at);
    belief.push_back(std::exp(parabola(at, 5.0)));
    total = plus(total, belief.back());
  }
  for (double& value : belief) value /= total;
  const double common = std::is_same_v<Kind, Random> ? h / std::sqrt(2.0 * std::numbers::pi * Q) : 1.0;
  for (int k = 1; k <= 6; ++k) {
    const double z = 6.0 + 5.0 * std::sin(k);
    filter.predict([&](double state) { return grown(state, k); }, Q);
    const double log_evidence = filter.update([&](double state) { return parabola(z - state * state / 20.0, R); });

    std::vector<double> next(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (belief[i] < 1e-12) continue;
      const double mean = grown(x[i], k);
      for (std::size_t j = 0; j < x.size(); ++j)
        if (std::abs(x[j] - mean) < 20.0)
          next[j] = plus(next[j], common * std::exp(parabola(x[j] - mean, Q)) * belief[i]);
    }
    total = 0.0;
    double sum = 0.0, first = 0.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      next[j] *= std::exp(parabola(z - x[j] * x[j] / 20.0, R));
      total = plus(total, next[j]);
      sum += next[j];
      first += next[j] * x[j];
    }
    EXPECT_NEAR(log_evidence, std::log(total), of_evidence) << "step " << k;
    EXPECT_NEAR(filter.moments().mean(0), first / sum, of_mean) << "step " << k;
    for (double& value : next) value /= total;
    belief = next;
  }
}

TEST(GridFilter, OfARandomStateIsRightByDefault) {
  expect_brute_force<Random>([](double a, double b) { return a + b; }, 1e-6, 1e-6);
}

TEST(GridFilter, OfAFuzzyStateIsRightToAPercentByDefault) {
  expect_brute_force<Fuzzy>([](double a, double b) { return a > b ? a : b; }, 0.08, 0.05);
}

TYPED_SUITE(GridFilterOf, Random, Fuzzy);

/// Each cell, the first and the last too, goes where f leads its centre.
TYPED_TEST(GridFilterOf, MovesTheCellsAtTheEdges) {
  for (const double only : {-1.0, 0.5, 3.5}) {  // a cell, or all
    OnLine<TypeParam> filter{
        0.0, 4.0, 1.0, [&](double x) { return only < 0.0 || x == only ? 0.0 : log_zero; }, {1e-12, 1}};
    filter.predict([](double x) { return 2.0 * x + 10.0; }, 1.0);
    EXPECT_CLOSE(filter.moments().mean(0), 2.0 * (only < 0.0 ? 2.0 : only) + 10.0, 1e-6);
  }
}

/// A system on a line that changes at every step and is not measured at the third, and its Kalman filter.
struct Line {
  static constexpr int steps = 6;
  static constexpr double Q = 0.5, R = 0.8;
  static double F(int k) { return k % 2 == 0 ? 1.1 : 0.9; }
  static bool measured(int k) { return k != 2; }
  static double z(int k) { return std::sin(k); }

  Gaussian<1> estimate{Vector<1>{0.4}, SquareMatrix<1>{1.2}};

  void step(int k) {
    const FixedStepMotion<1> model("line", {"x"}, 1.0, variance(F(k)), variance(Q));
    predict(model, estimate, 1.0, estimate);
    if (measured(k)) update(model, estimate, {Vector<1>{z(k)}, variance(R)}, PositionSensor<1>{}, estimate);
  }
  double P() const { return estimate.covariance(0, 0); }
  double log_possibility(double x) const { return parabola(x - estimate.mean(0), P()); }

  template <Uncertainty Kind>
  static void step(OnLine<Kind>& filter, int k) {
    filter.predict([&](double x) { return F(k) * x; }, Q);
    if (measured(k)) filter.update([&](double x) { return parabola(z(k) - x, R); });
  }
  template <Uncertainty Kind>
  static OnLine<Kind> filter(double h) {  // so many cells that none is cut or joined
    return {-8.0, 8.0, h, [](double x) { return parabola(x - 0.4, 1.2); }, {1e-16, static_cast<int>(8.0 / h)}};
  }
};

/// Sums over centres h apart of a Gaussian of variance s² are off by about exp(−2π²s²/h²), which halving h raises to
/// the fourth power. The narrowest Gaussian summed is p(y|x) p(x) as a function of x: 1/s² = 1/P + F²/Q.
TEST(GridFilter, OfARandomStateConvergesToTheKalmanFilterExponentially) {
  for (const double h : {0.6, 0.3}) {
    Line kalman;
    auto filter = Line::filter<Random>(h);
    double narrowest = Line::Q;
    for (int k = 0; k < Line::steps; ++k) {
      narrowest = std::min(narrowest, 1.0 / (1.0 / kalman.P() + Line::F(k) * Line::F(k) / Line::Q));
      kalman.step(k);
      Line::step(filter, k);
      EXPECT_EQ(filter.step(), h);
      const double tolerance = 1e-10 + 10.0 * std::exp(-2.0 * std::pow(std::numbers::pi / h, 2.0) * narrowest);
      EXPECT_CLOSE(filter.moments().mean(0), kalman.estimate.mean(0), tolerance);
      EXPECT_CLOSE(filter.moments().covariance(0), kalman.P(), tolerance);
      if (h == 0.3) {
        EXPECT_LT(tolerance, 1e-8);
      }
    }
  }
}

/// A maximum over centres h apart misses a parabola of curvature c by at most ch²/8. In log π that happens once over x,
/// c = 1/P + F²/Q, once in normalising each row, c = 1/Q, and, in the end, once in normalising π, c = 1/P.
TEST(GridFilter, OfAFuzzyStateConvergesToTheKalmanFilterQuadratically) {
  for (const double h : {0.4, 0.2, 0.1}) {
    Line kalman;
    auto filter = Line::filter<Fuzzy>(h);
    double curvatures = 0.0;
    for (int k = 0; k < Line::steps; ++k) {
      curvatures += 1.0 / kalman.P() + (Line::F(k) * Line::F(k) + 1.0) / Line::Q;
      kalman.step(k);
      Line::step(filter, k);
      const double bound = h * h / 8.0 * (curvatures + 1.0 / kalman.P());
      for (std::size_t i = 0; i < filter.grid().size(); ++i) {
        const double x = filter.grid().centre(i)(0);
        if (std::abs(x - kalman.estimate.mean(0)) > 5.0 * std::sqrt(kalman.P())) continue;
        ASSERT_LE(std::abs(std::log(filter.belief()[i]) - kalman.log_possibility(x)), bound) << "at " << x;
      }
      EXPECT_LE(std::abs(filter.most_likely()(0) - kalman.estimate.mean(0)), std::sqrt(2.0 * kalman.P() * bound));
    }
  }
}

/// Cells of a width of one with the numbers 1, 2, 3, … normalised, adapted.
template <Uncertainty Kind>
OnLine<Kind> ramp(double cells, const GridOptions& options) {
  OnLine<Kind> filter(
      0.0, cells, 1.0, [](double x) { return std::log(x + 0.5); }, options);
  filter.adapt();
  return filter;
}

template <Uncertainty Kind>
void expect_cut(const std::vector<double>& expected) {
  const Function two_of_eight = [](double x) { return x < 2.0 ? std::log(x + 0.5) : -100.0; };
  OnLine<Kind> filter(0.0, 8.0, 1.0, two_of_eight, {1e-12, 4});
  filter.adapt();
  EXPECT_CLOSE(filter.belief().values(), expected, 1e-15);
  EXPECT_EQ(filter.step(), 0.5);
}

TEST(GridFilter, CutsCellsByHalvesOrKeepsTheirPossibility) {
  expect_cut<Random>({1.0 / 6, 1.0 / 6, 1.0 / 3, 1.0 / 3});
  expect_cut<Fuzzy>({0.5, 0.5, 1.0, 1.0});
}

TEST(GridFilter, JoinsCellsBySumOrMaximum) {
  EXPECT_CLOSE(ramp<Random>(8.0, {1e-12, 1}).belief().values(), (std::vector{3.0 / 36, 7.0 / 36, 11.0 / 36, 15.0 / 36}),
               1e-15);
  const auto fuzzy = ramp<Fuzzy>(8.0, {1e-12, 1});
  EXPECT_CLOSE(fuzzy.belief().values(), (std::vector{0.25, 0.5, 0.75, 1.0}), 1e-15);
  EXPECT_EQ(fuzzy.step(), 2.0);
}

TEST(GridFilter, StartsWithTheCellsWantedAndKeepsToThoseAllowed) {
  EXPECT_EQ(ramp<Random>(4.0, {1e-12, 8}).step(), 0.5);
  EXPECT_EQ(ramp<Random>(4.0, {1e-12, 50, 20}).grid().size(), 16U);
}

TEST(GridFilter, DropsWhatIsNegligibleAndNormalisesTheRest) {
  const auto random = ramp<Random>(4.0, {0.6, 2});
  EXPECT_CLOSE(random.belief().values(), (std::vector{3.0 / 7, 4.0 / 7}), 1e-15);
  EXPECT_EQ(random.grid().first()(0), 2);
}

TEST(GridFilter, OfAStateThatDoesNotMoveNarrowsDown) {
  OnLine<Fuzzy> filter{-100.0, 100.0, 1.0, [](double) { return 0.0; }};
  for (int k = 0; k < 400; ++k) {
    filter.update([](double x) { return parabola(x - 12.34, 1.0); });
    filter.adapt();
  }
  EXPECT_LE(std::abs(filter.most_likely()(0) - 12.34), 0.5 * filter.step());
  // exp(−400 (x − 12.34)²/2) but for what the cells missed while they were wider.
  EXPECT_CLOSE(filter.moments().covariance(0, 0) * 400.0, 1.0, 0.05);
}

TEST(GridFilter, RefusesWhatItCannotDo) {
  const Function flat = [](double) { return 0.0; }, not_a_number = [](double) { return NAN; };
  using std::domain_error, std::invalid_argument;
  OnLine<Random> filter{0.0, 4.0, 1.0, flat, {1e-12, 1, 10}};
  EXPECT_REFUSED(domain_error, ("f(x)", "not finite"), filter.predict(not_a_number, 1.0));
  EXPECT_REFUSED(domain_error, ("process covariance"), filter.predict(flat, 0.0));
  EXPECT_REFUSED(std::length_error, ("cells", "10 are allowed"), filter.predict([](double x) { return 1e3 * x; }, 1.0));
  EXPECT_REFUSED(domain_error, ("cell"), filter.update([](double) { return log_zero; }));
  EXPECT_REFUSED(invalid_argument, ("cell"), filter.update(not_a_number));
  EXPECT_REFUSED(invalid_argument, ("negligible"), OnLine<Random>(0.0, 4.0, 1.0, flat, {0.0}));
}

}  // namespace grid_filter_test
