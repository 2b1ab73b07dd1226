#include <sigmax/estimation/chi_square.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace sigmax {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// log of xᵃ e⁻ˣ / Γ(a).
double log_prefactor(double a, double x) { return a * std::log(x) - x - std::lgamma(a); }

/// P(a, x) by its power series; converges fast for x < a + 1.
double lower_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (double n = a + 1.0; term > sum * epsilon; n += 1.0) {
    term *= x / n;
    sum += term;
  }
  return sum * std::exp(log_prefactor(a, x));
}

/// 1 − P(a, x) by Lentz's continued fraction; converges fast for x > a + 1.
double upper_fraction(double a, double x) {
  double b = x + 1.0 - a;
  double c = std::numeric_limits<double>::max();
  double d = 1.0 / b;
  double h = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    const double factor = d * c;
    h *= factor;
    if (std::abs(factor - 1.0) <= epsilon) break;
  }
  return h * std::exp(log_prefactor(a, x));
}

}  // namespace

double chi_square_cdf(double x, double degrees) {
  if (!(degrees > 0.0) || !(x >= 0.0))
    throw std::invalid_argument("chi_square_cdf needs x >= 0 and degrees of freedom > 0");
  if (x == 0.0) return 0.0;
  if (std::isinf(x)) return 1.0;
  const double a = 0.5 * degrees;
  return 0.5 * x < a + 1.0 ? lower_series(a, 0.5 * x) : 1.0 - upper_fraction(a, 0.5 * x);
}

double chi_square_quantile(double probability, double degrees) {
  if (!(probability > 0.0 && probability < 1.0) || !(degrees > 0.0))
    throw std::invalid_argument("chi_square_quantile needs a probability between 0 and 1 and degrees of freedom > 0");
  double low = 0.0;
  double high = degrees + 1.0;
  while (chi_square_cdf(high, degrees) < probability) {
    low = high;
    high *= 2.0;
  }
  // Newton's step where it stays inside the bracket, else bisection.
  double x = 0.5 * (low + high);
  for (int i = 0; i < 200 && high - low > 4.0 * epsilon * high; ++i) {
    const double excess = chi_square_cdf(x, degrees) - probability;
    (excess > 0.0 ? high : low) = x;
    const double density = 0.5 * std::exp(log_prefactor(0.5 * degrees, 0.5 * x)) / (0.5 * x);
    const double newton = x - excess / density;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - x) <= 2.0 * epsilon * x) return next;
    x = next;
  }
  return x;
}

Band chi_square_band(double degrees, double count, double probability) {
  const double tail = 0.5 * (1.0 - probability);
  const double total = degrees * count;
  return {chi_square_quantile(tail, total) / count, chi_square_quantile(1.0 - tail, total) / count};
}

}  // namespace sigmax
