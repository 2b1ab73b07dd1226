#include "support/sigmax.hpp"

namespace converted_measurement_test {

PROPERTY(ConvertedMeasurement, DebiasedInThePlaneIsThePrintedOne) {  // Lerro and Bar-Shalom 1993, (20)–(23)
  const Polar m{number_between(1.0, 1e3), radians(number_between(-3.2, 3.2))};
  const Polar sigma{number_between(0.0, 50.0), radians(number_between(0.0, 0.5))};
  const double r = m.range, c = std::cos(m.azimuth.radians()), s = std::sin(m.azimuth.radians());
  const double v = sigma.azimuth.radians() * sigma.azimuth.radians(), vr = sigma.range * sigma.range;
  const double cosh2 = std::cosh(2 * v), cosh1 = std::cosh(v), sinh2 = std::sinh(2 * v), sinh1 = std::sinh(v);
  const auto variance = [&](double a, double b) {
    return std::exp(-2 * v) * (r * r * (a * a * (cosh2 - cosh1) + b * b * (sinh2 - sinh1)) +
                               vr * (a * a * (2 * cosh2 - cosh1) + b * b * (2 * sinh2 - sinh1)));
  };
  const double R12 = s * c * std::exp(-4 * v) * (vr + (r * r + vr) * (1 - std::exp(v)));
  const double bias = std::exp(-v) - std::exp(-v / 2);
  const auto found = to_cartesian(m, sigma, Conversion::debiased);
  require_near(found.mean, Vector<3>(r * c * (1 - bias), r * s * (1 - bias), 0.0), 1e-12);
  require_near(found.covariance.topLeftCorner<2, 2>() / (r * r),
               SquareMatrix<2>{{variance(c, s), R12}, {R12, variance(s, c)}} / (r * r), 1e-12);
  RC_ASSERT(found.covariance == found.covariance.transpose());
}

PROPERTY(ConvertedMeasurement, UnbiasedInThePlaneIsThePrintedOne) {  // Mo, Song, Zhou, Sun, Bar-Shalom 1998
  const Polar m{number_between(1.0, 1e3), radians(number_between(-3.2, 3.2))};
  const Polar sigma{number_between(0.0, 50.0), radians(number_between(0.0, 0.5))};
  const double r = m.range, c = std::cos(m.azimuth.radians()), s = std::sin(m.azimuth.radians()),
               vr = sigma.range * sigma.range;
  const double lambda = std::exp(-sigma.azimuth.radians() * sigma.azimuth.radians() / 2), k = 1 / (lambda * lambda) - 2;
  const double l4 = std::pow(lambda, 4), half = (r * r + vr) / 2;
  const double R11 = k * r * r * c * c + half * (1 + l4 * std::cos(2 * m.azimuth.radians()));
  const double R22 = k * r * r * s * s + half * (1 - l4 * std::cos(2 * m.azimuth.radians()));
  const double R12 = k * r * r * s * c + half * l4 * std::sin(2 * m.azimuth.radians());
  const auto found = to_cartesian(m, sigma, Conversion::unbiased);
  require_near(found.mean, Vector<3>(r * c / lambda, r * s / lambda, 0.0), 1e-12);
  require_near(found.covariance.topLeftCorner<2, 2>() / (r * r), SquareMatrix<2>{{R11, R12}, {R12, R22}} / (r * r),
               1e-12);
}

/// Integrals over the errors of a radar, by the trapezoidal rule, which converges fast for Gaussians.
template <class Function>
auto expected(const Polar& about, const Polar& sigma, const Function& function) {
  constexpr int steps = 24;
  constexpr double width = 8.0;
  auto sum = (0.0 * function(about)).eval();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k) {
        const auto at = [](int n) { return width * (2.0 * n / steps - 1.0); };
        const double weight = std::exp(-0.5 * (at(i) * at(i) + at(j) * at(j) + at(k) * at(k))) *
                              std::pow(2.0 * width / steps / std::sqrt(2.0 * std::numbers::pi), 3);
        sum += weight * function(Polar{about.range + sigma.range * at(i), about.azimuth + at(j) * sigma.azimuth,
                                       about.elevation + at(k) * sigma.elevation});
      }
  return sum;
}

const std::array<std::pair<Polar, Polar>, 3> scenes{
    {{{100.0, radians(0.7), radians(0.4)}, {5.0, radians(0.2), radians(0.1)}},
     {{50.0, radians(-2.5), radians(-1.0)}, {1.0, radians(0.05), radians(0.4)}},
     {{10.0, radians(3.1), radians(1.2)}, {1.0, radians(0.3), radians(0.3)}}}};

TEST(ConvertedMeasurement, TheUnbiasedOneIsUnbiasedAndItsCovarianceIsTheMeanSquareError) {
  for (const auto& [m, sigma] : scenes) {
    const auto& deviations = sigma;
    const Vector<3> mean = expected(
        m, sigma, [&](const Polar& seen) { return to_cartesian(seen, deviations, Conversion::unbiased).mean; });
    EXPECT_CLOSE(mean, to_cartesian(m), 1e-10) << "m is the truth here";

    const auto z = to_cartesian(m, sigma, Conversion::unbiased);  // and here what was measured
    const SquareMatrix<3> R = expected(m, sigma, [&](const Polar& truth) {
      const Vector<3> error = z.mean - to_cartesian(truth);
      return SquareMatrix<3>(error * error.transpose());
    });
    EXPECT_CLOSE(z.covariance, R, 1e-10);
  }
}

TEST(ConvertedMeasurement, TheDebiasedOneTakesTheMeanBiasAndTheMeanCovariance) {
  for (const auto& [m, sigma] : scenes) {
    const double la = std::exp(-sigma.azimuth.radians() * sigma.azimuth.radians() / 2),
                 le = std::exp(-sigma.elevation.radians() * sigma.elevation.radians() / 2);
    const Vector<3> l(la * le, la * le, le);  // E[conversion | truth] = l · truth
    const Vector<3> bias = expected(m, sigma, [&](const Polar& truth) {
      const Vector<3> p = to_cartesian(truth);
      return Vector<3>(l.cwiseProduct(p) - p);
    });
    const SquareMatrix<3> of_means = expected(m, sigma, [&](const Polar& truth) {
      const Vector<3> p = l.cwiseProduct(to_cartesian(truth));
      return SquareMatrix<3>(p * p.transpose());
    });
    const double root2 = std::sqrt(2.0);  // the truth about what was measured, and what would be measured about that
    const SquareMatrix<3> of_squares =
        expected(m, {root2 * sigma.range, root2 * sigma.azimuth, root2 * sigma.elevation}, [](const Polar& seen) {
          const Vector<3> p = to_cartesian(seen);
          return SquareMatrix<3>(p * p.transpose());
        });
    const auto z = to_cartesian(m, sigma, Conversion::debiased);
    EXPECT_CLOSE(z.mean, to_cartesian(m) - bias, 1e-10);
    EXPECT_CLOSE(z.covariance, of_squares - of_means, 1e-10);
  }
}

}  // namespace converted_measurement_test
