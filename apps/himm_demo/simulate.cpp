#include "himm_demo/experiment/sentences.hpp"
#include "report/result.hpp"
#include "shell/command_line.hpp"

namespace sigmax::apps {
namespace {

struct SimulateOptions {
  int scenario = 1, group = 1;
  Preset preset = Preset::paper_text;
  std::optional<int> runs;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  FilterOptions filters;
  OutputOptions output;
};

/// Parts of the table of figures: RMSE by phase and axis; NEES; cross-times.
struct FigurePart {
  enum : unsigned { rmse = 1, nees = 2, cross_times = 4 };
};

/// All figures of all runs of a filter, or of the measurement, as far as it has them.
std::vector<Field> figures_of(const SimulateOptions& options, const Tally& tally, std::size_t of) {
  const FilterSettings* const filter = tally.filter(of);
  std::vector<Field> all = {{of_words("filter", "filter"), tally.name(of)}};
  const auto add = [&](ResultColumn column, const Cell& cell) {
    all.push_back({std::move(column), filter ? cell : Cell()});
  };
  const auto add_rmse = [&](const std::string& key, const std::string& header, const std::string& group, unsigned part,
                            double rmse) {
    all.push_back({{.key = key + "_m", .header = header, .sized = true, .group = group, .parts = part}, rmse});
  };
  const auto add_axes = [&](const std::string& key, const std::string& group, const auto& rmse) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      add_rmse(fmt::format("{}_{}", key, axis_names[axis]), axis_names[axis], group, FigurePart::rmse, rmse(axis));
  };
  for (std::size_t p = 0; p < 3; ++p) {
    const std::string phase = phase_names[p];
    const auto rmse = [&](std::size_t axis) { return tally.rmse(of, p, axis).value(); };
    add_rmse("rmse_" + phase, "", "", 0U, std::hypot(rmse(0), rmse(1), rmse(2)));
    add_axes("rmse_" + phase, phase, rmse);
  }
  add_axes("peak", "peak", [&](std::size_t axis) { return tally.peak_rmse(of, axis); });
  const auto add_consistency = [&](Tally::BySample figure, const std::string& key, const std::string& group) {
    for (std::size_t p = 0; p < 3; ++p)
      add({.key = fmt::format("{}_{}", key, phase_names[p]),
           .header = phase_names[p],
           .group = group,
           .parts = group.empty() ? 0U : FigurePart::nees},  // NIS has no table on the terminal
          tally.mean_of(of, figure, p));
  };
  add_consistency(Tally::nees_position, "nees_position", "position:");
  add_consistency(Tally::nees_velocity, "nees_position_velocity", "and velocity:");
  add_consistency(Tally::nis, "nis", "");

  const std::vector<double> times = tally.cross_times(of);
  const auto mean_time = times.empty() ? std::nullopt : std::optional(mean_interval(times));
  const auto crossed = tally.has_manoeuvre(of) ? std::optional(times.size()) : std::nullopt;
  add({.key = "cross_time_of_runs", .header = "mean of runs", .interval = true, .parts = FigurePart::cross_times},
      mean_time);
  add({.key = "runs_crossed", .parts = 0}, crossed);
  add({.header = "runs that crossed", .parts = FigurePart::cross_times},
      crossed ? fmt::format("{} of {}", *crossed, tally.experiment.runs) : "–");
  add({.key = "cross_time_of_curves", .header = "of the averaged curves", .parts = FigurePart::cross_times},
      tally.cross_time_of_curves(of));
  add({.key = "cross_time_of_paper", .header = "paper", .parts = FigurePart::cross_times},
      filter ? paper_cross_time(options.scenario, options.group, *filter) : std::nullopt);
  return all;
}

/// One filter against another: a row for each phase with the differences of RMSE by axis.
struct Comparison {
  std::string filter, reference;
  ResultTable table{};
};

Comparison compared(const Tally& tally, std::size_t of, std::size_t to) {
  Comparison comparison{tally.name(of), tally.name(to)};
  for (std::size_t p = 0; p < 3; ++p) {
    std::vector<Field> fields = {
        {of_words("phase", fmt::format("{} − {}, m", tally.name(of), tally.name(to))), phase_names[p]}};
    for (std::size_t axis = 0; axis < 3; ++axis)
      fields.push_back(
          {{.key = axis_names[axis], .header = axis_names[axis], .sign = true, .sized = true, .interval = true},
           (tally.rmse(of, p, axis) - tally.rmse(to, p, axis)).interval()});
    comparison.table.row_of(fields);
  }
  return comparison;
}

/// Every fuzzy filter against every random one that takes the same and makes the same of it; without such a pair, every
/// filter against the first.
std::vector<Comparison> comparisons(const Tally& tally) {
  std::vector<Comparison> all;
  for (std::size_t of = 1; of < tally.size(); ++of)
    for (std::size_t to = 1; to < tally.size(); ++to) {
      const FilterSettings &a = *tally.filter(of), &b = *tally.filter(to);
      if (a.fuzzy && !b.fuzzy && a.scheme == b.scheme && a.smooth == b.smooth &&
          a.radar_measurement == b.radar_measurement && a.sojourn_s == b.sojourn_s)
        all.push_back(compared(tally, of, to));
    }
  const bool none = all.empty();
  for (std::size_t of = 2; of < tally.size() && none; ++of) all.push_back(compared(tally, of, 1));
  return all;
}

/// The RMSE of every sample, and the mean weights.
void add_samples(const Tally& tally, Result& result) {
  const std::vector<std::string> models = model_names(tally.experiment.filters);
  ResultTable rmse, weights;
  for (std::size_t of = 0; of < tally.size(); ++of)
    for (std::size_t k = 0; k < tally.experiment.samples(); ++k) {
      std::vector<Field> fields = {{{.key = "sample"}, k + 1}, {{.key = "filter"}, tally.name(of)}};
      for (std::size_t axis = 0; axis < 3; ++axis)
        rmse.row_of({fields[0],
                     fields[1],
                     {{.key = "axis"}, axis_names[axis]},
                     {{.key = "rmse_m"}, tally.rmse_at(of, k, axis)}});
      if (of == 0) continue;
      const std::vector<double> own = tally.weights_at(of, k);
      const auto& names = tally.filter(of)->models;
      for (const auto& model : models) {
        const auto j = static_cast<std::size_t>(std::ranges::find(names, model) - names.begin());
        fields.push_back({{.key = "weight_" + model}, j < own.size() ? Cell(own[j]) : Cell()});
      }
      weights.row_of(fields);
    }
  result.add(rmse, {.printed = false, .csv = "rmse.csv"});
  result.add(weights, {.printed = false, .csv = "weights.csv"});
}

void report(const SimulateOptions& options, const Tally& tally) {
  ResultFiles files(options.output);
  const Experiment& experiment = tally.experiment;
  const auto& phases = experiment.scenario.phases;
  const std::string settings = as_toml(experiment.filters);
  Result result(options.output);
  result.page.title =
      fmt::format("Scenario {}, group {}: {} simulated runs", options.scenario, options.group, experiment.runs);
  result.facts("scenario", options.scenario, "group", options.group, "preset", name_of(options.preset), "runs",
               experiment.runs, "seed", experiment.seed, "settings_toml", settings);
  result.say("Scenario {}, group {}, preset {}: {} runs, seed {}", options.scenario, options.group,
             name_of(options.preset), experiment.runs, experiment.seed);
  result.say("Phases by sample: {}", list_of(std::array{0U, 1U, 2U}, [&](std::size_t p) {
               return fmt::format("{} {}–{}", phase_names[p], phases[p].first, phases[p].last);
             }));

  ResultTable figures;
  for (std::size_t of = 0; of < tally.size(); ++of) figures.row_of(figures_of(options, tally, of));
  const auto compared = comparisons(tally);
  ResultTable consistency = figures.part(FigurePart::nees, "mean NEES", 1);
  consistency.rule();
  consistency.row({"if consistent", "3", "3", "3", "6", "6", "6"});
  result.add(figures, {.printed = false, .csv = "filters.csv", .summary = {"results"}});
  add_samples(tally, result);
  result.add(figures.part(FigurePart::rmse, "position RMSE, m"), {.title = "Position RMSE by phase"});
  for (std::size_t i = 0; i < compared.size(); ++i) {
    result.facts_at({"comparisons", i}, "filter", compared[i].filter, "minus", compared[i].reference);
    result.add(compared[i].table, {.printed = !crowded(experiment),
                                   .summary = {"comparisons", i, "rmse_difference_m"},
                                   .title = crowded(experiment) ? "" : "Difference of RMSE, paired by run, ± 95 %"});
  }
  result.say(
      {{!crowded(experiment) && !compared.empty(), "(RMSE differences ± 95 % by paired runs; negative is better.)"}});
  result.add(consistency, {.title = "Mean NEES"});
  result.add(figures.part(FigurePart::cross_times, "cross-time, sample", 1),
             {.title = "Cross-time: when the manoeuvre model overtakes"});
  result.say({{experiment.mode_sample_shift != 0,
               "(As in the released program, mode weights are counted one sample early.)"}});

  Report& page = result.page;
  page.verdict.push_back(fmt::format("Preset {}, seed {}; a sample is {} s. The manoeuvre is in samples {} to {}.",
                                     name_of(options.preset), experiment.seed, shortest(experiment.scenario.step_s),
                                     phases[1].first, phases[1].last));
  if (crowded(experiment)) page.verdict.push_back("Two filters are switched on at first.");
  page.groups = {{measurement_name, true}, {truth_name, true}};
  for (const auto& filter : experiment.filters)
    page.groups.push_back({.name = filter.name, .shown = !crowded(experiment) || page.groups.size() < 4});
  if (files.report_wanted()) page.panels = panels_of(tally);
  page.last.emplace_back(Words{"Settings in force", settings, true});
  result.publish(files);
}

void simulate_and_report(const SimulateOptions& options) {
  const Settings settings = Settings::read(options.filters.config, options.filters.sets);
  const int runs = options.runs.value_or(options.preset == Preset::released ? 50 : 100);
  Tally tally(experiment_of(options.preset, options.scenario, options.group, settings, runs, options.seed), true);
  if (options.filters.print_config) {
    fmt::print("{}", as_toml(tally.experiment.filters));
    return;
  }
  refuse_to_overwrite(options.output, {options.filters.config}, {"filters.csv", "rmse.csv", "weights.csv"});
  const Study study{"runs", static_cast<std::size_t>(runs), [&](std::size_t run) { return tally.row(run, run + 1); }};
  const auto add = [&](std::size_t, const Study::Row& row) { tally.add(row); };
  if (!run(study, {.threads = options.threads}, options.output, add)) return;
  report(options, tally);
}

}  // namespace

void add_simulate(CLI::App& program, const std::string& command) {
  Subcommand app(program, "simulate", "The paper's experiment (section VI) on simulated radar targets.");
  const auto options = std::make_shared<SimulateOptions>();
  app.option("--scenario", options->scenario, "1: fire control radar, 2: surveillance radar").in({1, 2});
  app.option("--group", options->group, "Group of data and model parameters, section VI.C").in({1, 2, 3, 4});
  app.choice(
         "--preset", {"paper_text", "released"},
         [options](int preset) { options->preset = both_presets.at(static_cast<std::size_t>(preset)); },
         "The experiment as printed (paper_text) or as the authors' program has it (released)")
      .text("paper_text|released [paper_text]");
  app.option("--runs", options->runs, "Monte Carlo runs [100, or 50 for released]").in(1, 100000000);
  add_threads(app, options->threads);
  add_seed(app, options->seed);
  add_filter_options(app, options->filters);
  add_results(app, options->output, command);
  app.run([options] { simulate_and_report(*options); });
}

}  // namespace sigmax::apps
