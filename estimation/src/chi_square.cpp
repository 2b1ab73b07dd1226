#include <sigmax/estimation/chi_square.hpp>

#include <stdexcept>

#include <boost/math/special_functions/gamma.hpp>

namespace sigmax {
namespace {

// Failures are asked for beforehand, and nothing is computed in long double.
using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

double chi_square_quantile(double probability, double degrees) {
  if (!(probability > 0.0 && probability < 1.0) || !(degrees > 0.0))
    throw std::invalid_argument("chi_square_quantile needs a probability between 0 and 1 and degrees of freedom > 0");
  return 2.0 * boost::math::gamma_p_inv(0.5 * degrees, probability, Policy{});
}

Band chi_square_band(double degrees, double count, double probability) {
  const double tail = 0.5 * (1.0 - probability);
  const double total = degrees * count;
  return {chi_square_quantile(tail, total) / count, chi_square_quantile(1.0 - tail, total) / count};
}

}  // namespace sigmax
