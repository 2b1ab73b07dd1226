#include "himm_demo/track.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "himm_demo/estimates_file.hpp"
#include "himm_demo/track_report.hpp"
#include "himm_demo/track_run.hpp"
#include "support/angle.hpp"
#include "support/output.hpp"

namespace sigmax::apps {
namespace {

void refuse_what_means_nothing(const TrackOptions& options, const RecordingReader& recording) {
  const std::string& file = recording.csv().file();
  if (options.radar_at && !options.radar && !recording.polar())
    throw UsageError("--radar-at is for --radar and for radar input, but " + file + " has no range_m");
  if (!options.radar) return;
  if (recording.polar()) throw UsageError("--radar measures positions, but " + file + " holds a radar's measurements");
  if (recording.has_truth()) throw UsageError("--radar takes positions as the truth, but " + file + " has true_x_m");
  if (recording.axes() != 3) throw UsageError("--radar needs three axes, but " + file + " has two");
}

}  // namespace

void track_and_report(const TrackOptions& options) {
  const Settings settings = Settings::read(options.config, options.sets);
  FilterDefaults defaults;
  const auto sigma = options.radar.value_or(std::array{10.0, 0.1, 0.1});
  defaults.filter.accuracy.radar = {sigma[0], sigma[1] * degree, sigma[2] * degree};
  const auto filters = read_filters(settings, defaults);
  settings.refuse_unknown();
  if (options.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  RecordingReader recording(options.recording);
  refuse_what_means_nothing(options, recording);
  std::optional<OutputDirectory> directory;
  std::optional<EstimatesFile> estimates;
  if (!options.out.empty()) {
    directory.emplace(options.out);
    estimates.emplace(*directory, filters, recording);
  }
  const TrackOutcome outcome = run_track(options, recording, filters, estimates ? &*estimates : nullptr);
  TrackReport found = report(options, recording, filters, outcome);
  if (directory) {
    AtomicFile summary = directory->file("summary.json");
    summary.write(found.summary);
    commit_all(estimates->file(), summary);
    found.text += fmt::format("\nWrote estimates.csv and summary.json to {}\n", options.out);
  }
  fmt::print("{}", found.text);
  if (!found.warnings.empty()) std::fflush(stdout);  // they come last where both streams are one
  for (const auto& warning : found.warnings) fmt::print(stderr, "himm_demo: warning: {}\n", warning);
}

}  // namespace sigmax::apps
