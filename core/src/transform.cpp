#include <sigmax/core/transform.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include <sigmax/core/tie.hpp>

namespace sigmax {
namespace {

std::vector<double> powers(double exponent, std::span<const double> values, double greatest, double power) {
  if (!(exponent > 0.0 && std::isfinite(exponent)))
    throw std::invalid_argument("RatioScale needs an exponent that is positive and finite, not " +
                                std::to_string(exponent));
  std::vector<double> result(values.begin(), values.end());
  for (double& value : result) value = std::pow(value / greatest, power);
  return result;
}

/// One of the distinct values of a distribution, from the least upwards; values that tie are one.
struct Level {
  double value;  // the level itself: the least of those that tie
  double gap;    // how far it lies above the previous one, or above zero
  double here;   // how many outcomes have this value
  double above;  // how many have this value or a greater one
};

/// Gives every outcome the sum of step(level) over the levels up to its own: ties stay ties. O(n log n).
template <class Step>
std::vector<double> sum_over_levels(std::span<const double> values, const Step& step) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  double sum = 0.0, below = 0.0;
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    const double value = values[order[first]];
    while (last < order.size() && detail::numbers_tie(value, values[order[last]])) ++last;
    sum +=
        step(Level{value, value - below, static_cast<double>(last - first), static_cast<double>(order.size() - first)});
    for (std::size_t k = first; k < last; ++k) result[order[k]] = sum;
    below = value;
  }
  return result;
}

}  // namespace

std::vector<double> RatioScale::possibilities(std::span<const double> p) const {
  return powers(exponent, p, *std::max_element(p.begin(), p.end()), exponent);
}
std::vector<double> RatioScale::probabilities(std::span<const double> pi) const {
  return powers(exponent, pi, 1.0, 1.0 / exponent);
}

std::vector<double> DuboisPrade::possibilities(std::span<const double> p) const {
  return sum_over_levels(p, [](const Level& at) { return at.value * at.here; });
}

std::vector<double> DuboisPradeSandri::possibilities(std::span<const double> p) const {
  return sum_over_levels(p, [](const Level& at) { return at.gap * at.above; });
}
std::vector<double> DuboisPradeSandri::probabilities(std::span<const double> pi) const {
  return sum_over_levels(pi, [](const Level& at) { return at.gap / at.above; });
}

namespace detail {

void assign_weights(const Outcomes& variable, check::Row row, std::span<double> values,
                    const std::vector<double>& weights, const AnyAlgebra& algebra) {
  check::size(variable, row, variable.size() - values.size() + weights.size());
  check::weights(variable, row, weights, algebra);
  std::copy(weights.begin(), weights.end(), values.begin());
  condition(algebra, values);
}

}  // namespace detail

}  // namespace sigmax
