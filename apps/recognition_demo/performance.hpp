#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sigmax::apps {

/// The options of `recognition_demo performance`.
struct PerformanceOptions {
  std::string file;
  std::string draws = "density";  ///< or "triangle": what the quantities are drawn from
  std::size_t bins = 40;
  double least = 0.01;  ///< possibility of what lies outside [minimum, maximum]
  std::size_t runs = 1000;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  std::string out;
  bool quiet = false;
  std::string command;  ///< as typed, for the record
};

/// Which type of aircraft is it? From [minimum, optimum, maximum] and from fitted densities of the same quantities.
void performance_and_report(const PerformanceOptions& options);

}  // namespace sigmax::apps
