#pragma once

#include "himm_demo/filters/settings.hpp"
#include "records/recording.hpp"
#include "report/result.hpp"

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
  RecordingOptions recording;  ///< of each of them
  RadarOptions radar;
  std::string truth;                             ///< how it judges, "rmse" or "density", or empty
  Objective objective = Objective::prequential;  ///< what that says
  std::vector<std::string> models;  ///< sets to choose from, as dwna+dwpa; empty: those of the filter, and each alone
  std::vector<std::string> fixed;   ///< what is not fitted
  std::size_t folds = 4;
  std::size_t starts = 2;
  std::uint64_t seed = 1;
  int threads = 0;
  FilterOptions filters;
  std::string out;       ///< a file for the settings, or empty
  OutputOptions output;  ///< its summary, report and command

  bool fits(std::string_view what) const { return std::ranges::find(fixed, what) == fixed.end(); }
};

/// Tunes, prints and writes.
void run_tune(TuneOptions options);

}  // namespace sigmax::apps
