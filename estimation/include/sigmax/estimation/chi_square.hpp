#pragma once

namespace sigmax {

/// The x with P(χ² ≤ x) = probability for so many degrees of freedom, to about 1e-12 relative. Throws
/// std::invalid_argument unless 0 < probability < 1 and degrees > 0.
double chi_square_quantile(double probability, double degrees);

/// The interval in which the mean of `count` independent χ² variables lies with the given probability.
struct Band {
  double lower;
  double upper;
};

/// The band of a mean NEES or NIS over `count` runs if the filter is consistent (Bar-Shalom, Li, Kirubarajan
/// 2001, 5.4).
Band chi_square_band(double degrees, double count, double probability = 0.95);

}  // namespace sigmax
