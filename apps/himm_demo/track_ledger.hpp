#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/said.hpp"
#include "himm_demo/track_run.hpp"

namespace sigmax::apps {

/// Takes down what a recording holds and what the filters say of it, in the order of its rows.
class TrackLedger {
 public:
  TrackLedger(const TrackOptions& options, const std::vector<FilterSettings>& filters, int axes, TrackSinks sinks);

  /// A row as it was read.
  void read(const Fix& fix, bool has_sensors);

  /// What it measured, as a position where the others are counted from, if that is of use here, and where the target
  /// was; after a simulated radar has seen it.
  void measured(const Fix& fix, const std::optional<Vector<3>>& position, const std::optional<Geodetic>& anchor);

  /// What a filter said of a row.
  void said(const Fix& fix, const Said& said);

  /// What the step with a row changed, and the least NIS that a filter found.
  void stepped(const Fix& fix, const std::vector<Tally>& before, const std::vector<Tally>& after,
               std::optional<double> least);

  /// The end of a track, which had so many measurements.
  void ended(const std::string& track, const std::vector<Tally>& tallies, std::size_t measurements);
  void history(const std::string& track, std::size_t filter, std::vector<ModeStay> stays);

  TrackOutcome outcome;

 private:
  [[maybe_unused]] const TrackOptions& options_;
  const std::vector<FilterSettings>& filters_;
  int axes_;
  TrackSinks sinks_;
  std::array<double, 6> usual_nis_;  // below which 95 % of the NIS are, of 1 to 6 quantities
};

}  // namespace sigmax::apps
