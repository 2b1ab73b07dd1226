#include "support/sigmax.hpp"

namespace chi_square_test {

const std::initializer_list<int> all_degrees{1, 2, 3, 6, 9, 30, 101, 600, 1201, 57600};

/// P(χ² > x) as a finite sum: e^{−x/2} Σ (x/2)^i / i! for an even number of degrees, the tail of a squared normal and
/// half-integer terms for an odd one (Abramowitz, Stegun 26.4.4, 26.4.5).
double upper_tail(double x, int degrees) {
  const bool odd = degrees % 2 == 1;
  const double half = 0.5 * x;
  double sum = odd ? std::erfc(std::sqrt(half)) : 0.0;
  for (double power = odd ? 0.5 : 0.0; power < 0.5 * degrees - 0.25; power += 1.0)
    sum += std::exp(power * std::log(half) - half - std::lgamma(power + 1.0));
  return sum;
}

TEST(ChiSquare, TheQuantileHasItsProbability) {
  for (const int degrees : all_degrees)
    for (const double probability : {1e-6, 0.005, 0.025, 0.05, 0.5, 0.9, 0.975, 0.995, 1.0 - 1e-6})
      EXPECT_CLOSE(1.0 - upper_tail(chi_square_quantile(probability, degrees), degrees), probability, 1e-10)
          << degrees << " degrees, " << probability;
}

TEST(ChiSquare, TheBandOfAMeanIsThatOfTheSumDivided) {
  // 50 runs of 2 states: 100 degrees of freedom (Bar-Shalom, Li, Kirubarajan 2001, 5.4).
  const Band band = chi_square_band(2, 50);
  EXPECT_CLOSE(band.lower, 74.2219274749237 / 50, 1e-12);
  EXPECT_CLOSE(band.upper, 129.56119718583666 / 50, 1e-12);
  const Band narrow = chi_square_band(3, 1, 0.5);
  EXPECT_CLOSE(narrow.lower, chi_square_quantile(0.25, 3), 1e-12);
  EXPECT_CLOSE(narrow.upper, chi_square_quantile(0.75, 3), 1e-12);
}

TEST(ChiSquare, RefusesWhatHasNoAnswer) {
  for (const double degrees : {0.0, -1.0, not_a_number})
    EXPECT_INVALID(("chi_square_quantile"), chi_square_quantile(0.5, degrees));
  for (const double probability : {0.0, 1.0, -0.1, 1.1, not_a_number})
    EXPECT_INVALID(("chi_square_quantile"), chi_square_quantile(probability, 3));
}

}  // namespace chi_square_test
