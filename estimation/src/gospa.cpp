#include <sigmax/estimation/gospa.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <sigmax/core/matching.hpp>

#include "points.hpp"

namespace sigmax {
namespace detail {

void check(const GospaSettings& settings) {
  if (!(settings.cutoff > 0.0) || !(settings.order >= 1.0) || !std::isfinite(std::pow(settings.cutoff, settings.order)))
    throw std::invalid_argument("GOSPA needs a cutoff > 0 and an order >= 1, both finite; found cutoff " +
                                std::to_string(settings.cutoff) + ", order " + std::to_string(settings.order));
}

void check_point(std::span<const double> point, std::size_t coordinates) {
  if (point.size() != coordinates)
    throw std::invalid_argument("a point has " + std::to_string(point.size()) + " coordinates, the first one has " +
                                std::to_string(coordinates));
  for (const double x : point)
    if (!std::isfinite(x)) throw std::invalid_argument("a coordinate of a point is " + std::to_string(x));
}

double distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < a.size(); ++axis) sum = std::hypot(sum, a[axis] - b[axis]);
  return sum;
}

}  // namespace detail

namespace {

/// The assignment that is the best by GOSPA and OSPA alike, Σ (dᵖ − cᵖ) over pairs, without the value.
Gospa best(const PointSet& truth, const PointSet& estimates, const GospaSettings& settings) {
  detail::check(settings);
  const auto& first = truth.empty() ? estimates : truth;
  for (const auto* points : {&truth, &estimates})
    for (const auto& point : *points) detail::check_point(point, first.front().size());
  const double none = std::pow(settings.cutoff, settings.order);
  Choices savings;
  for (const auto& target : truth) {
    savings.add_row(0.0);
    for (std::size_t j = 0; j < estimates.size(); ++j)
      if (const double d = detail::distance(target, estimates[j]); d < settings.cutoff)
        savings.add(j, none - std::pow(d, settings.order));
  }
  Gospa result;
  std::size_t pairs = 0;
  for (const std::size_t j : match<Fuzzy, Fuzzy>(savings, {.marginals = false}).best) {
    auto& estimate = result.estimate_of.emplace_back();
    if (j == no_column) continue;
    estimate = j;
    const double d = detail::distance(truth[result.estimate_of.size() - 1], estimates[j]);
    result.localisation += std::pow(d, settings.order);
    ++pairs;
  }
  result.missed = 0.5 * none * static_cast<double>(truth.size() - pairs);
  result.false_targets = 0.5 * none * static_cast<double>(estimates.size() - pairs);
  return result;
}

}  // namespace

Gospa gospa(const PointSet& truth, const PointSet& estimates, const GospaSettings& settings) {
  Gospa result = best(truth, estimates, settings);
  result.value = std::pow(result.localisation + result.missed + result.false_targets, 1.0 / settings.order);
  return result;
}

double ospa(const PointSet& truth, const PointSet& estimates, const GospaSettings& settings) {
  const Gospa least = best(truth, estimates, settings);
  const double n = static_cast<double>(std::max(truth.size(), estimates.size()));
  // Each point of the larger set without a pair costs cᵖ: twice what GOSPA takes for it.
  const double total = least.localisation + 2.0 * std::max(least.missed, least.false_targets);
  return n == 0.0 ? 0.0 : std::pow(total / n, 1.0 / settings.order);
}

}  // namespace sigmax
