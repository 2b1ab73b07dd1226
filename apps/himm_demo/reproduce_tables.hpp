#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "himm_demo/reproduce_world.hpp"
#include "himm_demo/verdicts.hpp"
#include "support/result_table.hpp"

namespace sigmax::apps {

inline constexpr std::array both_presets = {Preset::paper_text, Preset::released};

inline constexpr std::array phase_names = {"before", "during", "after"};

/// "1/2": scenario and group.
std::string name_of(const Condition& condition);

/// The tables show a figure times that: in per cent where it is a share or a relative difference.
double scale_of(FigureOf figure);
Interval shown(const Measured& measured);

/// "himm_5", "most likely".
std::string_view word_of(Actor actor);

/// Of whom a figure is, where and when: "1/2 himm : imm, during z".
std::string subject_of(const Measured& measured, bool with_place = true);

/// One sentence under one preset and reading, against both IMMs.
struct Judged {
  std::vector<Measured> against_correct;
  std::vector<Measured> against_released;

  Verdict verdict() const { return apps::verdict(against_correct, against_released); }
};

/// Everything that is judged, by preset, reading and sentence.
using Judgements = std::map<Preset, std::map<std::string_view, std::vector<Judged>>>;

/// Measures every sentence for every preset and reading.
Judgements judge(const std::vector<Condition>& conditions);

/// The sentences with a verdict for each preset, HIMM being what the preset takes for it.
ResultTable claims(const Judgements& all);

/// The verdicts for HIMM under each reading of (57).
ResultTable by_reading(const Judgements& all);

/// How many figures of each sentence are where it wants them, and the one that speaks most against it.
ResultTable deciding_figures(const Judgements& all, Preset preset);

/// Every figure of every sentence, for files.
ResultTable figures_table(const Judgements& all);

/// RMSE of every filter, for files.
ResultTable filters_table(const std::vector<Condition>& conditions);

/// RMSE of every filter and the measurement in one scenario and group, by phase and axis.
ResultTable rmse_table(const Condition& condition);

/// The mean over axes and phases of RMSE over that of the measurement, of one filter …
double over_measurement(const Condition& condition, std::string_view filter);

/// … and of every filter in every scenario and group.
ResultTable overview(const std::vector<Condition>& conditions, Preset preset);

}  // namespace sigmax::apps
