#include <sigmax/core/distribution.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>

#include <sigmax/core/sample.hpp>

#include "belief.hpp"

namespace sigmax {

std::size_t index_of_greatest(std::span<const double> values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

namespace detail {

double total(const AnyAlgebra& algebra, std::span<const double> values) {
  return with(algebra, [&](auto a) { return total(a, values); });
}

void condition(const AnyAlgebra& algebra, std::span<double> joint) {
  with(algebra, [&](auto a) { condition(a, joint); });
}

double equal_share(const AnyAlgebra& algebra, std::size_t n) {
  return with(algebra, [n](auto a) { return equal_share(a, n); });
}

double normalize_logs(std::span<double> logs, const AnyAlgebra& algebra) {
  return with_scaling(algebra, [logs](auto a) { return normalize_logs(a, logs); });
}

Table conditioned(const Outcomes& variable, std::span<const double> weights, const AnyAlgebra& algebra) {
  check::size(variable, {}, weights.size());
  check::weights(variable, {}, weights, algebra);
  Table row(weights);
  condition(algebra, row.values());
  return row;
}

bool is_normalized(std::span<const double> values, const AnyAlgebra& algebra) {
  return std::abs(total(algebra, values) - 1.0) <= 4.0 * normalization_tolerance;
}

void write(std::ostream& out, const Outcomes& variable, std::span<const double> values) {
  out << variable.name() << ':';
  for (std::size_t i = 0; i < values.size(); ++i) out << (i > 0 ? ", " : " ") << variable.label(i) << ' ' << values[i];
}

std::size_t outcome_at(std::span<const double> values, double level) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0.0) continue;
    last = i;
    level -= values[i];
    if (level < 0.0) break;
  }
  return last;
}

bool same_numbers(std::span<const double> a, std::span<const double> b) { return std::ranges::equal(a, b); }

}  // namespace detail

}  // namespace sigmax
