#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace sigmax::apps {

/// The options of `recognition_demo manoeuvre`.
struct ManoeuvreOptions {
  std::size_t runs = 50;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  std::string out;
  bool quiet = false;
  std::string command;  ///< as typed, for the record
};

/// Airliner, bomber or fighter? A tracked target's mode weights tell how hard it manoeuvres, and that what it may be.
void manoeuvre_and_report(const ManoeuvreOptions& options);

}  // namespace sigmax::apps
