#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sigmax::apps {

/// The options of `recognition_demo esm`.
struct EsmOptions {
  std::string usage = "uniform";  ///< or "dirichlet"
  double alpha = 0.5;
  std::size_t reports = 40;
  std::size_t runs = 1000;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  std::string out;
  bool quiet = false;
  std::string command;  ///< as typed, for the record
};

/// The synthetic emitter world: all classifiers side by side.
void esm_and_report(const EsmOptions& options);

}  // namespace sigmax::apps
