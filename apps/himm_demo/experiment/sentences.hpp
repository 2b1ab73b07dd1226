#pragma once

#include "himm_demo/experiment/tally.hpp"

namespace sigmax::apps {

/// Of what a sentence of section VI speaks. Where it compares two, it is the first's figure relative to the second's.
struct FigureOf {
  std::string_view name, words;
  bool relative;  ///< a share or a relative difference, which is shown in per cent
  bool by_axis, by_phase;
  Statistic (*of)(const Tally& tally, std::size_t filter,
                  std::size_t place);  ///< that of the phase and axis, as in a row
};

/// Where a figure must lie for the sentence to hold.
struct Region {
  double above = -infinity, below = infinity;
};

/// What runs say of a region in which a figure should lie: its whole interval does, or none of it does, or neither.
enum class Finding { inside, outside, open };

/// A part of a sentence that can be measured.
struct Statement {
  const FigureOf* figure;
  std::string of,
      against;  ///< "himm", "himm_5" with σ_w = 5, "imm", "most likely" with such an output, "measurement", ""
  int scenario, group;
  std::vector<std::size_t> phases;  ///< 0: before, 1: during, 2: after the manoeuvre
  Region region;
};

/// A sentence of section VI of the paper.
struct Sentence {
  std::string place;
  std::string words{};
  std::vector<Statement> statements{};
};

/// The readings of (57) by which there is a filter himm_…; `envelope` is without.
constexpr std::array<const char*, 5> himm_readings = {"selected", "own", "own_recentred", "released", "envelope"};

/// The reading that a preset takes for the paper's.
constexpr std::string_view reading_of(Preset preset) { return preset == Preset::released ? "released" : "own"; }

/// The name of the filter that a sentence is about: by a reading of (57), for HIMM, and with the authors' program's IMM
/// or the correct one.
std::string filter_of(const std::string& actor, std::string_view reading, bool released_imm);

/// One scenario and group under one preset, with all that was found there.
struct Condition {
  Preset preset;
  int scenario, group;
  Tally tally;
};

/// Both presets, both scenarios and all groups, in this order, with the filters of the paper and those that they are to
/// be compared with, so far without runs.
std::vector<Condition> conditions(int runs, std::uint64_t seed);

inline const char* words_of(Preset preset) { return preset == Preset::released ? "As released" : "As printed"; }

/// "1/2": scenario and group.
template <class Of>
std::string place_of(const Of& of) {
  return fmt::format("{}/{}", of.scenario, of.group);
}

/// One figure of a sentence, measured against the correct IMM and against the released one. The intervals of all
/// figures of one sentence hold together with 95 %.
struct Measured {
  const Statement* statement;
  std::optional<std::size_t> phase, axis;
  std::array<Interval, 2> interval{};
  std::array<Finding, 2> finding{};

  /// Of whom it is, and when: "himm : imm, during z".
  std::string subject() const;

  /// The interval as it is shown, perhaps in per cent.
  Interval shown(std::size_t imm) const;
};

enum class Verdict { holds, only_against_released, does_not_hold, undecided };

/// The figures of one sentence under one preset and reading.
struct Judged {
  std::vector<Measured> figures;

  /// A sentence holds if all its figures are inside their regions, and does not if one is outside. The correct IMM
  /// decides, unless it holds only against the released one.
  Verdict verdict() const;

  /// The figure that speaks most against the sentence, in half widths of its interval.
  const Measured& least_favourable() const;
};

/// All sentences, in their order.
std::vector<Judged> judge(const std::vector<Condition>& conditions, Preset preset, std::string_view reading);

/// What decides in a condition, and the RMSE of the measurement and the filters.
View view_of(const std::vector<Judged>& sentences, const Condition& condition, const std::vector<std::string>& names);

/// What sections VI.D and VI.E say that can be checked, in the order of the paper.
const std::vector<Sentence>& sentences();

/// The cross-time that the paper prints for such a filter, if it has it.
std::optional<double> paper_cross_time(int scenario, int group, const FilterSettings& filter);

}  // namespace sigmax::apps
