#include <sigmax/recognition/triangle.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace sigmax {

Triangle::Triangle(double minimum, double optimum, double maximum)
    : minimum_(minimum), optimum_(optimum), maximum_(maximum) {
  if (!(std::isfinite(minimum) && std::isfinite(maximum) && minimum <= optimum && optimum <= maximum))
    throw std::invalid_argument("a triangle needs minimum ≤ optimum ≤ maximum, not " + std::to_string(minimum) + ", " +
                                std::to_string(optimum) + ", " + std::to_string(maximum));
}

double Triangle::operator()(double x) const {
  if (x == optimum_) return 1.0;
  const double side = x < optimum_ ? minimum_ : maximum_;
  if (side == optimum_ || !(minimum_ < x && x < maximum_)) return 0.0;
  return (x - side) / (optimum_ - side);
}

double Triangle::supremum(double lower, double upper) const {
  if (lower <= optimum_ && optimum_ < upper) return 1.0;
  if (lower > optimum_) return (*this)(lower);
  return minimum_ == optimum_ ? 0.0 : (*this)(upper);  // up to `upper`: the limit there
}

Distribution<Fuzzy> triangular(const FuzzyVariable& variable, const Discretization& bins, const Triangle& triangle,
                               double least) {
  if (!(least >= 0.0 && least <= 1.0))
    throw std::invalid_argument("the least possibility is in [0, 1], not " + std::to_string(least));
  std::vector<double> values;
  for (std::size_t i = 0; i < bins.size(); ++i)
    values.push_back(std::max(least, triangle.supremum(bins.lower(i), bins.upper(i))));
  return {variable, values};
}

}  // namespace sigmax
