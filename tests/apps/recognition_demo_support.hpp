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

/// Counts of two classes in two bins of each of the four features.
inline const std::map<std::string, Matrix> counts = {{"altitude_layer_ft_agl", {{30, 10}, {5, 35}}},
                                                     {"airspeed_kt", {{50, 50}, {1, 99}}},
                                                     {"vertical_rate_ft_per_min", {{7, 3}, {5, 5}}},
                                                     {"turn_rate_deg_per_s", {{20, 60}, {10, 70}}}};

inline std::string counts_csv() {
  const std::map<std::string, Numbers> bounds = {{"altitude_layer_ft_agl", {50, 1000, 5000}},
                                                 {"airspeed_kt", {0, 100, 300}},
                                                 {"vertical_rate_ft_per_min", {-2000, 0, 2000}},
                                                 {"turn_rate_deg_per_s", {-8, 2, 8}}};
  std::ostringstream text;
  text << "class,feature,bin,lower,upper,count\n";
  for (std::size_t c = 0; c < 2; ++c)
    for (const auto& [feature, table] : counts)
      for (std::size_t b = 0; b < 2; ++b)
        text << (c == 0 ? "slow" : "fast") << ',' << feature << ',' << b + 1 << ',' << bounds.at(feature)[b] << ','
             << bounds.at(feature)[b + 1] << ',' << table[c][b] << '\n';
  return text.str();
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
