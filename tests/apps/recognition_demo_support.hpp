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

template <class Transform>
Matrix each_row(const Matrix& rows, const Transform& transform) {
  Matrix result;
  for (const auto& row : rows) result.push_back(transform(row));
  return result;
}

}  // namespace sigmax::apps
