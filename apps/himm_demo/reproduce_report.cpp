#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "himm_demo/reproduce.hpp"
#include "himm_demo/reproduce_tables.hpp"
#include "support/result_files.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

const char* preset_words(Preset preset) { return preset == Preset::released ? "As released" : "As printed"; }

/// "as printed: 3 hold, 4 hold only against the released IMM, …".
std::string counts(const Judgements& all, Preset preset) {
  std::array<int, 4> count{};
  for (const auto& judged : all.at(preset).at(reading_of(preset))) ++count[static_cast<std::size_t>(judged.verdict())];
  return fmt::format("{}: {} of {} hold, {} only against the released IMM, {} do not, {} are undecided.",
                     preset_words(preset), count[0], sentences().size(), count[1], count[2], count[3]);
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
  for (const Preset preset : both_presets) note(counts(all, preset));
  fmt::print("\nEach reading of (57), as printed and then as released\n");
  by_reading(all).print(width);
  note(
      "((yes): only against the released IMM. ?: undecided. sel., rec., rel., env.: selected, own_recentred, released, "
      "and envelope, which is (A-1) without (A-4).)");
  for (const Preset preset : both_presets) {
    fmt::print("\n{}: the figures that decide\n", preset_words(preset));
    deciding_figures(all, preset).print(width);
  }
  note(
      "(Scenario/group, filter : its reference, phase and axis. The relative difference of RMSE unless something else "
      "is "
      "named, ± 95 % by paired runs, together for all figures of a sentence; \"sure\" is how many of them are where "
      "the "
      "sentence wants them, and the figure is the least favourable, against the correct IMM.)");
  for (const Preset preset : both_presets) {
    fmt::print("\n{}: RMSE over that of the measurement, mean over axes and phases\n", preset_words(preset));
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
    files.write_json("summary.json", summary);
  }
  files.commit();
}

}  // namespace sigmax::apps
