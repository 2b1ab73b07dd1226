#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace sigmax::kernels {

/// Σ exp(log) of logarithms that are not above zero, by the widest vectors that the machine has, each term within two
/// units in its last place; negative if the library was built without Highway.
double tiled_sum_of_exponentials(const double* logs, std::size_t size);

/// Σ exp(log) of logarithms that are not above zero; −∞ adds nothing.
inline double sum_of_exponentials(std::span<const double> logs) {
  constexpr std::size_t worth_a_call = 32;
  if (logs.size() >= worth_a_call)
    if (const double sum = tiled_sum_of_exponentials(logs.data(), logs.size()); sum >= 0.0) return sum;
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log);
  return sum;
}

/// The greatest of some logarithms, in parts that do not wait for each other.
inline double greatest(std::span<const double> logs) {
  constexpr std::size_t parts = 8;
  if (logs.size() < parts) return *std::max_element(logs.begin(), logs.end());
  double greatest[parts];
  std::copy_n(logs.begin(), parts, greatest);
  for (std::size_t i = parts; i + parts <= logs.size(); i += parts)
    for (std::size_t p = 0; p < parts; ++p) greatest[p] = std::max(greatest[p], logs[i + p]);
  for (std::size_t i = logs.size() / parts * parts; i < logs.size(); ++i) greatest[0] = std::max(greatest[0], logs[i]);
  return *std::max_element(greatest, greatest + parts);
}

}  // namespace sigmax::kernels
