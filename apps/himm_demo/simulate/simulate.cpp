#include "himm_demo/subcommands.hpp"

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "himm_demo/experiment/sentences.hpp"
#include "himm_demo/filters/keys.hpp"
#include "himm_demo/simulate/performance.hpp"
#include "result/braille.hpp"
#include "result/result.hpp"
#include "support/command_line.hpp"
#include "support/numbers.hpp"

namespace sigmax::apps {
namespace {

struct SimulateOptions {
  int scenario = 1;
  int group = 1;
  Preset preset = Preset::paper_text;
  std::optional<int> runs;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  std::string config;
  std::vector<std::string> sets;
  bool print_config = false;
  OutputOptions output;
};

/// All that an experiment found.
struct Found {
  const SimulateOptions& options;
  const Experiment& experiment;
  std::vector<Performance> performances;      ///< of the measurement, then of the filters
  std::map<std::string, double> ns_per_step;  ///< of each filter; empty unless all filters were asked for
};

/// CPU time of a step of each filter in ns, on one thread: the median over some of the runs. Not reproducible.
std::map<std::string, double> nanoseconds_per_step(const Experiment& experiment) {
  constexpr int most_runs = 15;
  const auto cpu_time = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  };
  std::map<std::string, double> medians;
  for (const auto& filter : experiment.filters) {
    std::vector<double> times;
    for (int number = 0; number < std::min(most_runs, experiment.runs); ++number) {
      RandomStream random(experiment.seed, static_cast<std::uint64_t>(number));
      const auto plots = plots_of(filter, experiment.scenario.step_s,
                                  simulate(experiment.scenario, experiment.group.data, random).measured);
      AnyTarget target(choice_of(filter, 3));
      double start = 0.0;
      int steps = -1;  // the first only warms up
      for (const AnyPlot& plot : plots) {
        if (steps == 0) start = cpu_time();
        target.take(plot, [&](std::size_t, bool is_start) { steps += is_start ? 0 : 1; });
      }
      if (filter.smooth) target.smoothed([](const TargetPoint&) {});
      times.push_back((cpu_time() - start) / steps);
    }
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    medians[filter.name] = times[times.size() / 2];
  }
  return medians;
}

/// Parts of the table of figures: RMSE by phase and axis; NEES; cross-times; a few figures of many filters.
struct FigurePart {
  enum : unsigned { rmse = 1, nees = 2, cross_times = 4, overview = 8 };
};

/// All figures of all runs of a filter, or of the measurement, as far as it has them.
std::vector<Field> figures_of(const Found& found, const Performance& of) {
  std::vector<Field> all = {{{.key = "filter", .header = "filter", .align = Align::left}, of.name()}};
  const auto add = [&](ResultColumn column, const Cell& cell) { all.push_back({std::move(column), cell}); };
  const auto add_of_filter = [&](const ResultColumn& column, const Cell& cell) {
    add(column, of.filter() ? cell : Cell());
  };
  const auto add_rmse = [&](const std::string& key, const std::string& group, const auto& value) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      add({.key = fmt::format("{}_{}_m", key, axis_names[axis]),
           .header = axis_names[axis],
           .sized = true,
           .group = group,
           .parts = FigurePart::rmse},
          value(axis));
  };
  std::array<std::string, 3> phases;
  for (std::size_t p = 0; p < 3; ++p) phases[p] = found.experiment.scenario.phases[p].name;
  for (std::size_t p = 0; p < 3; ++p) {
    add({.key = "rmse_" + phases[p] + "_m",
         .header = phases[p],
         .sized = true,
         .group = "RMSE, m:",
         .parts = FigurePart::overview},
        of.phase_rmse(p));
    add_rmse("rmse_" + phases[p], phases[p], [&](std::size_t axis) { return of.phase_rmse(p, axis); });
  }
  add_rmse("peak", "peak", [&](std::size_t axis) { return of.peak_rmse(axis); });
  const auto add_consistency = [&](Performance::Figure figure, const std::string& key, const std::string& group,
                                   const std::string& name) {
    const bool nees = !group.empty();  // whose phases have a table on the terminal
    for (std::size_t p = 0; p < 3; ++p)
      add_of_filter(
          {.key = key + "_" + phases[p], .header = phases[p], .group = group, .parts = nees ? FigurePart::nees : 0U},
          of.mean(figure, p));
    add_of_filter({.header = name, .group = nees ? "NEES:" : "", .parts = FigurePart::overview}, of.mean(figure));
  };
  add_consistency(Performance::nees_position, "nees_position", "position:", "position");
  add_consistency(Performance::nees_velocity, "nees_position_velocity", "and velocity:", "and velocity");
  add_consistency(Performance::nis, "nis", "", "NIS");

  const auto runs = of.cross_time_of_runs();
  const auto crossed = of.runs_crossed();
  const std::string of_all = crossed ? fmt::format("{} of {}", *crossed, found.experiment.runs) : "–";
  const auto curves = of.cross_time_of_curves();
  const auto paper =
      of.filter() ? paper_cross_time(found.options.scenario, found.options.group, *of.filter()) : std::nullopt;
  const auto ns = found.ns_per_step.find(of.name());
  add_of_filter(
      {.key = "cross_time_of_runs", .header = "mean of runs", .interval = true, .parts = FigurePart::cross_times},
      runs);
  add_of_filter({.header = "runs", .group = "cross-time:", .parts = FigurePart::overview}, runs ? runs->mean : nan);
  add_of_filter({.key = "runs_crossed", .parts = 0}, crossed);
  add_of_filter({.header = "runs that crossed", .parts = FigurePart::cross_times}, of_all);
  add_of_filter({.key = "cross_time_of_curves", .header = "of the averaged curves", .parts = FigurePart::cross_times},
                curves);
  add_of_filter({.header = "curves", .group = "cross-time:", .parts = FigurePart::overview}, curves);
  add_of_filter({.key = "cross_time_of_paper", .header = "paper", .parts = FigurePart::cross_times}, paper);
  add_of_filter({.header = "ns/step", .digits = 0, .parts = FigurePart::overview},
                ns == found.ns_per_step.end() ? Cell() : Cell(ns->second));
  return all;
}

/// One filter against another: a row for each phase with the differences of RMSE by axis, and what the paper claims.
struct Comparison {
  std::string filter, reference;
  ResultTable table;
  std::string sentence;  ///< what became of the claims, if there are any
};

Comparison compared(const Found& found, const Performance& of, const Performance& to) {
  const bool claimed = judged(*of.filter(), *to.filter());
  std::vector<ResultColumn> columns = {
      {.key = "phase", .header = fmt::format("{} − {}, m", of.name(), to.name()), .align = Align::left}};
  for (const char* axis : axis_names)
    columns.push_back({.key = axis, .header = axis, .sign = true, .sized = true, .interval = true});
  if (claimed) {
    columns.push_back({.header = "the paper says", .align = Align::left});
    columns.push_back({.header = to.filter()->imm_mixing == MixingWeights::correct ? "against the correct IMM that"
                                                                                   : "against the released IMM that",
                       .align = Align::left});
  }
  Comparison comparison{of.name(), to.name(), ResultTable(columns), ""};
  for (std::size_t p = 0; p < 3; ++p) {
    const std::string_view phase = found.experiment.scenario.phases[p].name;
    std::vector<Cell> cells = {phase};
    std::array<Interval, 3> difference;
    std::array<double, 3> reference;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      difference[axis] = of.minus(to, p, axis);
      reference[axis] = to.phase_rmse(p, axis);
      cells.emplace_back(difference[axis]);
    }
    if (claimed) {
      const Region claim = claim_of(found.options.scenario, found.options.group, p);
      const std::string holds = verdict(claim, difference, reference);
      cells.emplace_back(word_of(claim));
      cells.emplace_back(holds);
      comparison.sentence += fmt::format("{} {} the manoeuvre the paper says {}, which {}{}",
                                         p ? ";" : fmt::format("{} against {}:", of.name(), to.name()), phase,
                                         word_of(claim), holds, p == 2 ? "." : "");
    }
    comparison.table.row(std::move(cells));
  }
  return comparison;
}

/// Whether two filters take the same and make the same of it, but for the kind of the mode.
bool alike(const FilterSettings& a, const FilterSettings& b) {
  return a.scheme == b.scheme && a.smooth == b.smooth && a.radar_measurement == b.radar_measurement &&
         a.sojourn_s == b.sojourn_s;
}

/// Every fuzzy filter against every random one like it; without such a pair, every filter against the first.
std::vector<Comparison> comparisons(const Found& found) {
  std::vector<Comparison> all;
  const auto& of = found.performances;
  for (std::size_t f = 1; f < of.size(); ++f)
    for (std::size_t r = 1; r < of.size(); ++r)
      if (of[f].filter()->fuzzy && !of[r].filter()->fuzzy && alike(*of[f].filter(), *of[r].filter()))
        all.push_back(compared(found, of[f], of[r]));
  const bool none = all.empty();
  for (std::size_t f = 2; f < of.size() && none; ++f) all.push_back(compared(found, of[f], of[1]));
  return all;
}

std::size_t samples_of(const Found& found) { return static_cast<std::size_t>(found.experiment.scenario.samples); }

/// The RMSE of every sample, and the mean weights.
ResultTable rmse_by_sample(const Found& found) {
  ResultTable table({{.key = "sample"}, {.key = "filter"}, {.key = "axis"}, {.key = "rmse_m"}});
  for (const Performance& of : found.performances)
    for (std::size_t k = 0; k < samples_of(found); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) table.row({k + 1, of.name(), axis_names[axis], of.rmse(k, axis)});
  return table;
}

ResultTable weights_by_sample(const Found& found) {
  const std::vector<std::string> models = model_names(found.experiment.filters);
  std::vector<ResultColumn> columns = {{.key = "sample"}, {.key = "filter"}};
  for (const auto& model : models) columns.push_back({.key = "weight_" + model});
  ResultTable table(columns);
  for (const Performance& of : found.performances)
    for (std::size_t k = 0; k < samples_of(found) && of.filter(); ++k) {
      const std::vector<double> weights = of.told_weights(k);
      std::vector<Cell> cells = {k + 1, of.name()};
      for (const auto& model : models) {
        const auto& own = of.filter()->models;
        const auto j = static_cast<std::size_t>(std::find(own.begin(), own.end(), model) - own.begin());
        cells.push_back(j < weights.size() ? Cell(weights[j]) : Cell());
      }
      table.row(std::move(cells));
    }
  return table;
}

void report(const Found& found, ResultFiles& files) {
  const SimulateOptions& options = found.options;
  const Experiment& experiment = found.experiment;
  const auto& phases = experiment.scenario.phases;
  Result result(options.output);
  result.page.title =
      fmt::format("Scenario {}, group {}: {} simulated runs", options.scenario, options.group, experiment.runs);
  result.fact({"scenario"}, options.scenario);
  result.fact({"group"}, options.group);
  result.fact({"preset"}, name_of(options.preset));
  result.fact({"runs"}, experiment.runs);
  result.fact({"seed"}, experiment.seed);
  result.fact({"settings_toml"}, as_toml(experiment.filters));
  result.say(fmt::format("Scenario {}, group {}, preset {}: {} runs, seed {}", options.scenario, options.group,
                         name_of(options.preset), experiment.runs, experiment.seed));
  result.say(fmt::format("Phases by sample: {} {}–{}, {} {}–{}, {} {}–{}", phases[0].name, phases[0].first,
                         phases[0].last, phases[1].name, phases[1].first, phases[1].last, phases[2].name,
                         phases[2].first, phases[2].last));

  const bool brief = !found.ns_per_step.empty();
  ResultTable figures;
  for (const Performance& of : found.performances) figures.row_of(figures_of(found, of));
  const auto compared = comparisons(found);
  ResultTable few = figures.part(FigurePart::overview, "filter"),
              consistency = figures.part(FigurePart::nees, "mean NEES", 1);
  few.rule();
  few.row({"if consistent", {}, {}, {}, "3", "6", "3", {}, {}, {}});
  consistency.rule();
  consistency.row({"if consistent", "3", "3", "3", "6", "6", "6"});
  result.add(figures, {.printed = false, .csv = "filters.csv", .summary = {"results"}});
  result.add(rmse_by_sample(found), {.printed = false, .csv = "rmse.csv"});
  result.add(weights_by_sample(found), {.printed = false, .csv = "weights.csv"});
  result.add(few, {.printed = brief});
  result.add(figures.part(FigurePart::rmse, "position RMSE, m"),
             {.printed = !brief, .title = "Position RMSE by phase"});
  for (std::size_t i = 0; i < compared.size(); ++i) {
    result.fact({"comparisons", i, "filter"}, compared[i].filter);
    result.fact({"comparisons", i, "minus"}, compared[i].reference);
    result.add(compared[i].table, {.printed = !brief,
                                   .summary = {"comparisons", i, "rmse_difference_m"},
                                   .title = crowded(experiment) ? "" : "Difference of RMSE, paired by run, ± 95 %"});
    if (result.page.verdict.size() < 2 && !compared[i].sentence.empty())
      result.page.verdict.push_back(compared[i].sentence);
  }
  result.say(
      {{brief,
        "(RMSE of the distance. NEES and NIS: means over all phases. Cross-time: mean of the runs' that crossed, and "
        "of "
        "the averaged curves, in samples. ns/step: CPU time on one thread, median; all else is the same for a seed.)"},
       {!brief && !compared.empty(),
        fmt::format("(RMSE differences ± 95 % by paired runs; negative is better. \"Competitive\": within {:.0f} %.)",
                    100.0 * competitive_fraction)}});
  result.add(consistency, {.printed = !brief, .title = "Mean NEES"});
  result.add(figures.part(FigurePart::cross_times, "cross-time, sample", 1),
             {.printed = !brief, .title = "Cross-time: when the manoeuvre model overtakes"});
  result.say({{!brief && experiment.mode_sample_shift != 0,
               "(As in the released program, mode weights are counted one sample early.)"}});
  for (const auto& filter : experiment.filters)
    if (brief) result.fact({"not_reproducible", "ns_per_step", filter.name}, found.ns_per_step.at(filter.name));

  Report& page = result.page;
  page.verdict.push_back(fmt::format("Preset {}, seed {}; a sample is {} s. The manoeuvre is in samples {} to {}.",
                                     name_of(options.preset), experiment.seed, shortest(experiment.scenario.step_s),
                                     phases[1].first, phases[1].last));
  if (crowded(experiment)) page.verdict.push_back("Two filters are switched on at first.");
  page.groups = {{measurement_name, true}, {truth_name, true}};
  for (const auto& filter : experiment.filters)
    page.groups.push_back({.name = filter.name, .shown = !crowded(experiment) || page.groups.size() < 4});
  page.chooser = "Show";
  if (files.report_wanted() || charts_on_terminal(options.output)) {
    page.views = views_of(experiment, found.performances);
    result.on_terminal = charts_of(page.views.front());
  }
  page.last.emplace_back(Words{"Settings in force", as_toml(experiment.filters), true});
  result.publish(files);
}

void simulate_and_report(const SimulateOptions& options) {
  const Settings settings = Settings::read(options.config, options.sets);
  const Group parameters = group(options.group, options.scenario);
  const auto filters = read_filters(settings, FilterDefaults::of(options.preset, parameters));
  settings.refuse_unknown();
  if (options.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  refuse_to_overwrite(options.output, {options.config}, {"filters.csv", "rmse.csv", "weights.csv"});
  const bool released = options.preset == Preset::released;
  const Experiment experiment{scenario(options.scenario, options.preset), parameters,   filters,
                              options.runs.value_or(released ? 50 : 100), options.seed, released ? -1 : 0};
  Found found{options, experiment, performances(experiment), {}};
  const Study study{"runs", static_cast<std::size_t>(experiment.runs),
                    [&](std::size_t number) { return row_of(found.performances, experiment.traced(number)); }};
  const auto take = [&](std::size_t, const Study::Row& row) { add(row, found.performances); };
  if (!run(study, {.threads = options.threads}, options.output, take)) return;
  if (asks_for_all(settings)) found.ns_per_step = nanoseconds_per_step(experiment);
  ResultFiles files(options.output);
  report(found, files);
}

}  // namespace

void add_simulate(CLI::App& program, const std::string& command) {
  Subcommand app(program, "simulate", "The paper's experiment (section VI) on simulated radar targets.");
  const auto options = std::make_shared<SimulateOptions>();
  options->output.command = command;
  app.option("--scenario", options->scenario, "1: fire control radar, 2: surveillance radar")
      .one_of({1, 2})
      .shows_default();
  app.option("--group", options->group, "Group of data and model parameters, section VI.C")
      .one_of({1, 2, 3, 4})
      .shows_default();
  app.choice(
         "--preset", {"paper_text", "released"},
         [options](int preset) { options->preset = both_presets.at(static_cast<std::size_t>(preset)); },
         "The experiment as printed (paper_text) or as the authors' program has it (released)")
      .text("paper_text|released [paper_text]");
  app.option("--runs", options->runs, "Monte Carlo runs [100, or 50 for released]").in(1, 100000000);
  add_threads(app, options->threads);
  app.footer(
      "Examples:\n"
      "  himm_demo simulate --scenario 2 --group 3 --out results\n"
      "  himm_demo simulate --set filters=all\n"
      "  himm_demo simulate --set filter.himm.sigma_w=5 --set lift=unbiased --runs 1000");
  add_seed(app, options->seed);
  add_filter_options(app, options->config, options->sets, options->print_config);
  add_output(app, options->output);
  add_report(app, options->output);
  add_no_chart(app, options->output.no_chart);
  app.run([options] { simulate_and_report(*options); });
}

}  // namespace sigmax::apps
