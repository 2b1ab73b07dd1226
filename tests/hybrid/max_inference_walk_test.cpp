#include "support/sigmax.hpp"

/// The code of docs/max_inference.md.
namespace max_inference_walk_test {

TEST(MaxInference, GaussianPossibilityFunctions) {
  const auto model = dwna<1>(0.5);
  GaussianPossibility<2> pi{Gaussian<2>{Vector<2>{0.0, 1.0}, SquareMatrix<2>::Identity()}};
  pi = predict(model, pi, 2.0);
  pi = update(model, pi, {Vector<1>{2.5}, SquareMatrix<1>{0.25}});
  const double possibility = pi({2.4, 1.2});

  // F = [1 2; 0 1], G = [2, 2], Q = 0.25 GGᵀ = [1 1; 1 1]: P = [5 2; 2 1] + [1 1; 1 1] = [6 3; 3 2], S = 6.25.
  const double x = 2.0 + 6.0 / 6.25 * 0.5, v = 1.0 + 3.0 / 6.25 * 0.5;
  const double P_xx = 6.0 - 36.0 / 6.25, P_xv = 3.0 - 18.0 / 6.25, P_vv = 2.0 - 9.0 / 6.25;
  const double a = 2.4 - x, b = 1.2 - v;
  const double squared = (P_vv * a * a - 2.0 * P_xv * a * b + P_xx * b * b) / (P_xx * P_vv - P_xv * P_xv);
  EXPECT_CLOSE(possibility, std::exp(-0.5 * squared), 1e-12);
}

TEST(MaxInference, TheGridFilter) {
  GridFilter<Fuzzy, 1> filter{Grid<1>{Vector<1>{-10.0}, Vector<1>{10.0}, Vector<1>{0.1}},
                              [](const Vector<1>& x) { return -0.5 * x(0) * x(0); }};
  filter.predict([](const Vector<1>& x) { return Vector<1>{std::sin(x(0))}; }, SquareMatrix<1>{0.5});
  const double log_evidence = filter.update([](const Vector<1>& x) { return -std::abs(x(0) - 0.8); });
  const Vector<1> best = filter.most_likely();
  const Gaussian<1> moments = filter.moments();  // of the density in proportion to it, (35)

  // The same suprema over points 0.01 apart.
  double supremum = -100.0, at = 0.0, sum = 0.0, sum_x = 0.0;
  for (int j = -600; j <= 600; ++j) {
    const double y = 0.01 * j;
    double log = -100.0;
    for (int i = -600; i <= 600; ++i) {
      const double from = 0.01 * i, miss = y - std::sin(from);
      log = std::max(log, -0.5 * from * from - miss * miss);
    }
    log -= std::abs(y - 0.8);
    if (log > supremum) at = y;
    supremum = std::max(supremum, log);
    sum += std::exp(log);
    sum_x += y * std::exp(log);
  }
  EXPECT_CLOSE(log_evidence, supremum, 0.05);  // half a cell, and the slope of the likelihood
  EXPECT_CLOSE(best(0), at, 0.1);
  EXPECT_CLOSE(moments.mean(0), sum_x / sum, 0.01);
}

TEST(MaxInference, ModesOverAnyTimeStep) {
  const RandomVariable random_mode{"mode", {"steady", "manoeuvring"}};
  const TimedTransition random_transition{random_mode, rates_of_sojourns({20.0, 5.0})};  // s, on average
  const FuzzyVariable fuzzy_mode{"mode", {"steady", "manoeuvring"}};
  const TimedTransition fuzzy_transition{fuzzy_mode, rates_of_sojourns({20.0, 5.0})};
  random_transition(0.2);  // p(r_k | r_{k−1}) for a step of 0.2 s
  fuzzy_transition(0.2);   // π(r_k | r_{k−1}): each row on the ratio scale, (34)

  const double p = 0.2 * -std::expm1(-0.25 * 0.2);
  EXPECT_CLOSE(random_transition(0.2)(0, 1), p, 1e-15);
  EXPECT_CLOSE(fuzzy_transition(0.2)(0, 1), p / (1.0 - p), 1e-15);
}

}  // namespace max_inference_walk_test
