#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "himm_demo/experiment/figures.hpp"
#include "himm_demo/experiment/sentences.hpp"
#include "study/statistic.hpp"
#include "study/study.hpp"

namespace sigmax::apps {

/// What decides every figure of `himm_demo reproduce`.
struct ReproduceChoice {
  int runs = 1000;
  std::uint64_t seed = 1;
};

/// The readings of (57) by which there is a filter himm_…; `envelope` is without.
inline constexpr std::array<const char*, 5> himm_readings = {"selected", "own", "own_recentred", "released",
                                                             "envelope"};

/// The reading that a preset takes for the paper's.
inline std::string_view reading_of(Preset preset) { return preset == Preset::released ? "released" : "own"; }

/// The figures of one filter in one batch of runs, as they follow each other in a row: sums over the runs. Those of the
/// measurement are the squares alone.
struct Column {
  static constexpr std::size_t square = 0;                  ///< by phase and axis: mean square error
  static constexpr std::size_t onset_z = square + squares;  ///< of z in ten samples before and ten from the onset on
  static constexpr std::size_t lead = onset_z + 2;          ///< by phase: share of samples with the manoeuvre's model
  static constexpr std::size_t switches = lead + 3;         ///< by phase: how often the lead changes
  static constexpr std::size_t crossing = switches + 3;     ///< cross-times …
  static constexpr std::size_t crossed = crossing + 1;      ///< … and of how many runs
  static constexpr std::size_t curve = crossed + 1;         ///< the model's lead in weight, from the onset on
  static constexpr std::size_t curve_samples = 16;
  static constexpr std::size_t count = curve + curve_samples;
};

/// One scenario and group under one preset, with all that was found there.
class Condition {
 public:
  Condition(Preset under, int scenario_number, int group_number, const ReproduceChoice& choice);

  /// The runs first … last − 1 of all filters, as one row: how many they are, and the columns of the measurement and of
  /// each filter.
  Study::Row batch(std::uint64_t first, std::uint64_t last) const;

  /// Whether there is such a filter here, or the measurement.
  bool has(std::string_view filter) const;

  /// The mean of one column over the runs. `filter` may be "measurement" for mean square errors.
  Statistic mean(std::string_view filter, std::size_t column) const { return batches.mean(place(filter) + column); }

  /// RMSE of a phase and axis in m.
  Statistic rmse(std::string_view filter, std::size_t phase, std::size_t axis) const {
    return sqrt(mean(filter, Column::square + 3 * phase + axis));
  }

  /// The mean cross-time of the runs that crossed.
  Statistic cross_time_of_runs(std::string_view filter) const {
    return batches.mean(place(filter) + Column::crossing, place(filter) + Column::crossed);
  }

  /// Where the averaged curves cross; NaN if not soon after the onset.
  Statistic cross_time_of_curves(std::string_view filter) const;

  Preset preset;
  int scenario, group;
  Experiment experiment;
  Batches batches;

 private:
  std::size_t place(std::string_view filter) const;
};

/// Both presets, both scenarios and all groups, in this order.
std::vector<Condition> conditions(const ReproduceChoice& choice);

/// All runs of the conditions, in batches whose number does not depend on the runs (but for few). Does them, and gives
/// each condition its own; false where there is nothing to report.
bool run(const ReproduceChoice& choice, const Sharing& sharing, const OutputOptions& options,
         std::vector<Condition>& conditions);

/// One figure of a sentence, measured. The intervals of all figures of one sentence hold together with 95 %.
struct Measured {
  const Statement* statement;
  std::optional<std::size_t> phase;
  std::optional<std::size_t> axis;
  Interval interval;
  Finding finding;
};

/// Which filters a sentence is read of.
struct Cast {
  std::string_view reading;  ///< of (57), for HIMM
  bool released_imm;         ///< the authors' program's IMM rather than the correct one

  std::string filter(Actor subject) const;
};

enum class Verdict { holds, only_against_released, does_not_hold, undecided };

/// One sentence under one preset and reading, against both IMMs.
struct Judged {
  std::vector<Measured> against_correct;
  std::vector<Measured> against_released;

  /// A sentence holds if all its figures are inside their regions, and does not if one is outside. The correct IMM
  /// decides, unless it holds only against the released one.
  Verdict verdict() const;
};

/// Everything that is judged, by preset, reading and sentence.
using Judgements = std::map<Preset, std::map<std::string_view, std::vector<Judged>>>;

/// Measures every sentence for every preset and reading.
Judgements judge(const std::vector<Condition>& conditions);

}  // namespace sigmax::apps
