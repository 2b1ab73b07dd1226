#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/recording.hpp"
#include "result/output_options.hpp"
#include "support/command_line.hpp"

namespace sigmax::apps {

/// What settings are judged by, always less is better.
enum class Objective {
  prequential,  ///< minus the log_score of the measurements, in nats
  rmse,         ///< root mean square of the distance from the truth, in m
  density       ///< minus the logarithm of the density that the estimate gives the true position, in nats
};

/// The options of `himm_demo tune`.
struct TuneOptions {
  std::vector<std::string> files;
  RecordingOptions recording;                     ///< of each of them
  std::optional<std::array<double, 3>> radar;     ///< a simulated one's standard deviations: m, degrees, degrees
  std::optional<std::array<double, 3>> radar_at;  ///< where a radar stands, in m
  std::string truth;                              ///< how it judges, "rmse" or "density", or empty
  Objective objective = Objective::prequential;   ///< what that says
  std::vector<std::string> models;  ///< sets to choose from, as dwna+dwpa; empty: those of the filter, and each alone
  std::vector<std::string> fixed;   ///< what is not fitted
  std::size_t folds = 4;
  std::size_t starts = 2;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string config;
  std::vector<std::string> sets;
  bool print_config = false;
  std::string out;      ///< a file for the settings, or empty
  std::string summary;  ///< a file for what was found, or empty
  OutputOptions page;   ///< its report and command
  bool quiet = false;
  bool wide = false;

  bool fits(const std::string& what) const;
  std::size_t width() const { return wide ? any_width : terminal_width; }
};

/// `himm_demo tune`: the settings that suit recordings.
void add_tune(CLI::App& program, const std::string& command);

}  // namespace sigmax::apps
