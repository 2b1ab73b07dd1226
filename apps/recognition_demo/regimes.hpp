#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sigmax::apps {

/// The options of `recognition_demo regimes`.
struct RegimesOptions {
  std::size_t reports = 40;
  std::size_t runs = 1000;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  std::string out;
  bool quiet = false;
  std::string command;  ///< as typed, for the record
};

/// The synthetic emitter world in which what the classifiers believe is wrong in several ways: where is max inference,
/// or sigma-max inference, the better one?
void regimes_and_report(const RegimesOptions& options);

}  // namespace sigmax::apps
