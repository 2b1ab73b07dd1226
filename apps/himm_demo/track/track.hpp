#pragma once

#include "himm_demo/filters/settings.hpp"
#include "himm_demo/track/outcome.hpp"
#include "records/plots.hpp"
#include "report/result.hpp"

namespace sigmax::apps {

class TrackPage;

/// The options of `himm_demo track`.
struct TrackOptions {
  RecordingOptions recording;
  RadarOptions radar;
  std::uint64_t seed = 1;
  FilterOptions filters;
  std::string predict_to_text;          ///< as it was given
  std::optional<double> predict_to;     ///< a time, up to which targets that ended before are predicted
  bool predict_to_time_of_day = false;  ///< whether that is one, so of the last day
  bool iso_times = false;               ///< a column with dates and times beside the seconds
  OutputOptions output;
};

/// Where a run puts what it finds row by row; null where nobody wants it.
struct TrackSinks {
  ResultFiles* files = nullptr;  ///< for estimates.csv
  TrackPage* page = nullptr;
  std::function<void(const Row&, const LocalFrame*)> rows{};  ///< before a simulated radar sees them
};

/// Runs all filters over a recording. Throws InputError with file and line.
TrackOutcome run_track(const TrackOptions& options, RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, TrackSinks sinks);

/// The gate that is proposed where there are outliers.
inline constexpr double outlier_gate = 0.9999;

/// What that makes of outliers; nothing where there are none, or where a recording comes only once.
std::optional<TrackOutcome> with_gate(TrackOptions options, const RecordingOptions& what,
                                      std::vector<FilterSettings> filters, const TrackOutcome& outcome);

/// Whether the filters are consistent with the measurements, or what is wrong, with its number and the one thing to do.
/// `gated` is the outcome with that gate, if it was tried.
std::string verdict_of(const TrackOptions& options, const RecordingReader& recording,
                       const std::vector<FilterSettings>& filters, const TrackOutcome& outcome,
                       const TrackOutcome* gated);

}  // namespace sigmax::apps
