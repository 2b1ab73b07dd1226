#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "himm_demo/reproduce.hpp"
#include "himm_demo/reproduce_page.hpp"
#include "support/result_files.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

/// Every figure of every sentence as the tables show it: in per cent where it is relative.
nlohmann::ordered_json figures_of(const Judgements& all, Preset preset) {
  nlohmann::ordered_json figures;
  const auto& sentences = all.at(preset).at(reading_of(preset));
  for (std::size_t s = 0; s < sentences.size(); ++s)
    for (std::size_t i = 0; i < sentences[s].against_correct.size(); ++i) {
      const Measured& measured = sentences[s].against_correct[i];
      auto& figure = figures[std::to_string(s + 1)][subject_of(measured)];
      figure["per_cent"] = scale_of(measured.statement->figure) > 1.0;
      figure["against_correct_imm"] = as_json(shown(measured));
      figure["against_released_imm"] = as_json(shown(sentences[s].against_released[i]));
    }
  return figures;
}

}  // namespace

void report(const ReproduceOptions& options, const std::vector<Condition>& conditions) {
  ResultFiles files(options.output);
  const Judgements all = judge(conditions);
  const std::size_t width = options.output.width();
  const auto note = [&](const std::string& text) { fmt::print("{}", wrapped(text, width)); };
  fmt::print("Section VI, sentence by sentence: {} runs of each scenario, group and preset, seed {}\n\n",
             options.choice.runs, options.choice.seed);
  claims(all).print(width);
  note(
      "(1/2 is scenario 1, group 2. \"only released\": holds only against the released IMM. HIMM has the reading of "
      "(57) "
      "that is printed, or released.)");
  for (const Preset preset : both_presets) note(counts_of_verdicts(all, preset));
  fmt::print("\nEach reading of (57), as printed and then as released\n");
  by_reading(all).print(width);
  note(
      "((yes): only against the released IMM. ?: undecided. sel., rec., rel., env.: selected, own_recentred, released, "
      "and envelope, which is (A-1) without (A-4).)");
  for (const Preset preset : both_presets) {
    fmt::print("\n{}: the figures that decide\n", words_of(preset));
    deciding_figures(all, preset).print(width);
  }
  note(
      "(Scenario/group, filter : its reference, phase and axis. The relative difference of RMSE unless something else "
      "is "
      "named, ± 95 % by paired runs, together for all figures of a sentence; \"sure\" is how many of them are where "
      "the "
      "sentence wants them, and the figure is the least favourable, against the correct IMM.)");
  for (const Preset preset : both_presets) {
    fmt::print("\n{}: RMSE over that of the measurement, mean over axes and phases\n", words_of(preset));
    overview(conditions, preset).print(width);
  }
  note("(Filters whose names end with 5 have sigma_w = 5.)");
  if (files.wanted()) {
    files.write("claims.csv", claims(all).csv());
    files.write("readings.csv", by_reading(all).csv());
    files.write("figures.csv", figures_table(all).csv());
    files.write("filters.csv", filters_table(conditions).csv());
    auto summary = summary_of(options.output);
    summary["runs"] = options.choice.runs;
    summary["seed"] = options.choice.seed;
    summary["sentences"] = claims(all).json();
    summary["readings"] = by_reading(all).json();
    for (const Preset preset : both_presets)
      summary["over_measurement"][name_of(preset)] = overview(conditions, preset).json();
    for (const auto& condition : conditions)
      summary["rmse"][name_of(condition.preset())][name_of(condition)] = rmse_table(condition).json();
    for (const Preset preset : both_presets) summary["figures"][name_of(preset)] = figures_of(all, preset);
    if (files.report_wanted()) summary["report_data"] = report_data_name;
    files.write_json("summary.json", summary);
  }
  if (files.report_wanted()) files.write_report(page_of(options, conditions, all));
  files.commit();
}

}  // namespace sigmax::apps
