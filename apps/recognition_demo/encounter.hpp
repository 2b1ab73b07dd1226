#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace sigmax::apps {

/// The options of `recognition_demo encounter`.
struct EncounterOptions {
  std::string file;
  std::size_t reports = 10;
  std::size_t runs = 1000;
  std::uint64_t seed = 1;
  int threads = 0;    ///< 0: as many as the machine has
  std::string track;  ///< a recording to classify instead of draws
  double every_s = 10.0;
  std::optional<double> ground_ft;  ///< nothing: the lowest altitude of the recording
  std::string out;
  bool quiet = false;
  std::string command;  ///< as typed, for the record
};

/// What class of aircraft is it? From counts of radar samples, as p(f|c) and as π(f|c).
void encounter_and_report(const EncounterOptions& options);

}  // namespace sigmax::apps
