#pragma once

#include "apps/rows.hpp"
#include "support/program.hpp"

namespace sigmax::apps {

using Matrix = std::vector<Numbers>;

inline program::Ending recognition_demo(const std::vector<std::string>& arguments) {
  return program::run(SIGMAX_RECOGNITION_DEMO, arguments);
}

inline program::Ending recognition_demo_succeeds(const std::vector<std::string>& arguments) {
  return program::succeeds(SIGMAX_RECOGNITION_DEMO, arguments);
}

// Plain restatements, which share no code with the library.

inline double sum(const Numbers& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
inline double greatest(const Numbers& values) { return *std::max_element(values.begin(), values.end()); }

inline Numbers divided(Numbers values, double by) {
  for (double& value : values) value /= by;
  return values;
}

/// π ∝ p.
inline Numbers by_ratio(const Numbers& p) { return divided(p, greatest(p)); }

/// π_i = Σ of the p_j that are not above p_i, by pairs of numbers.
inline Numbers by_dubois_prade(const Numbers& p) {
  Numbers pi;
  for (const double own : p) {
    pi.push_back(0.0);
    for (const double other : p)
      if (other <= own) pi.back() += other;
  }
  return divided(pi, greatest(pi));
}

template <class Transform>
Matrix each_row(const Matrix& rows, const Transform& transform) {
  Matrix result;
  for (const auto& row : rows) result.push_back(transform(row));
  return result;
}

}  // namespace sigmax::apps
