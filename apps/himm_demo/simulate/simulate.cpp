#include "himm_demo/simulate/simulate.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "himm_demo/experiment/sentences.hpp"
#include "himm_demo/filter_options.hpp"
#include "himm_demo/simulate/views.hpp"
#include "himm_demo/tracker.hpp"
#include "result/braille.hpp"
#include "result/result.hpp"
#include "support/command_line.hpp"
#include "support/missing.hpp"

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
  std::vector<Performance> performances;  ///< of the measurement, then of the filters
  std::vector<double> ns_per_step;        ///< of each filter; empty unless all filters were asked for
};

/// CPU time of a step of each filter in ns, on one thread: the median over some of the runs. Not reproducible.
std::vector<double> nanoseconds_per_step(const Experiment& experiment) {
  constexpr int most_runs = 15;
  const auto cpu_time = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  };
  std::vector<double> medians;
  for (const auto& filter : experiment.filters) {
    std::vector<double> times;
    for (int number = 0; number < std::min(most_runs, experiment.runs); ++number) {
      RandomStream random(experiment.seed, static_cast<std::uint64_t>(number));
      std::vector<Reading<3>> measurements;
      for (const Polar& seen : simulate(experiment.scenario, experiment.group.data, random).measured)
        measurements.push_back(reading(seen, filter));
      Tracker<3> tracker(filter);
      double start = 0.0;
      int steps = -1;  // the first only warms up
      for (std::size_t k = 0; k < measurements.size(); ++k) {
        if (steps == 0) start = cpu_time();
        tracker.take(experiment.scenario.step_s * static_cast<double>(k), measurements[k], k,
                     [&](std::size_t) { ++steps; });
      }
      tracker.finish();
      times.push_back((cpu_time() - start) / steps);
    }
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    medians.push_back(times[times.size() / 2]);
  }
  return medians;
}

/// Parts of the table of figures: RMSE by phase and axis; NEES; cross-times; a few figures of many filters.
struct Part {
  enum : unsigned { rmse = 1, nees = 2, cross_times = 4, overview = 8 };
};

struct Consistency {
  Performance::Figure figure;
  std::string key, group, name;
};
const Consistency consistencies[] = {
    {Performance::nees_position, "nees_position", "position:", "position"},
    {Performance::nees_velocity, "nees_position_velocity", "and velocity:", "and velocity"},
    {Performance::nis, "nis", "", "NIS"}};

std::vector<ResultColumn> figure_columns(const Scenario& scenario) {
  std::vector<ResultColumn> columns = {{.key = "filter", .header = "filter", .align = Align::left}};
  const auto add = [&](ResultColumn column) { columns.push_back(std::move(column)); };
  const auto add_rmse = [&](const std::string& key, const std::string& group) {
    for (const std::string axis : axis_names)
      add({.key = key + "_" + axis + "_m", .header = axis, .sized = true, .group = group, .parts = Part::rmse});
  };
  for (const auto& [phase, first, last] : scenario.phases) {
    const std::string name(phase);
    add({.key = "rmse_" + name + "_m", .header = name, .sized = true, .group = "RMSE, m:", .parts = Part::overview});
    add_rmse("rmse_" + name, name);
  }
  add_rmse("peak", "peak");
  for (const auto& [figure, key, group, name] : consistencies) {
    for (const auto& [phase, first, last] : scenario.phases)
      add({.key = fmt::format("{}_{}", key, phase),
           .header = group.empty() ? "" : std::string(phase),
           .group = group,
           .parts = group.empty() ? 0U : Part::nees});
    add({.header = name, .group = group.empty() ? "" : "NEES:", .parts = Part::overview});
  }
  add({.key = "cross_time_of_runs", .header = "mean of runs", .interval = true, .parts = Part::cross_times});
  add({.header = "runs", .group = "cross-time:", .parts = Part::overview});
  add({.key = "runs_crossed", .parts = 0});
  add({.header = "runs that crossed", .parts = Part::cross_times});
  add({.key = "cross_time_of_curves", .header = "of the averaged curves", .parts = Part::cross_times});
  add({.header = "curves", .group = "cross-time:", .parts = Part::overview});
  add({.key = "cross_time_of_paper", .header = "paper", .parts = Part::cross_times});
  add({.header = "ns/step", .digits = 0, .parts = Part::overview});
  return columns;
}

/// All figures of all runs: a row for the measurement, as far as it has them, and for each filter.
ResultTable figures_table(const Found& found) {
  const std::vector<ResultColumn> columns = figure_columns(found.experiment.scenario);
  ResultTable table(columns);
  for (const Performance& of : found.performances) {
    std::vector<Cell> cells = {of.name()};
    for (std::size_t p = 0; p < 3; ++p) {
      cells.emplace_back(of.phase_rmse(p));
      for (std::size_t axis = 0; axis < 3; ++axis) cells.emplace_back(of.phase_rmse(p, axis));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) cells.emplace_back(of.peak_rmse(axis));
    for (const Consistency& kind : consistencies) {
      for (std::size_t p = 0; p < 3 && of.filter(); ++p) cells.emplace_back(of.mean(kind.figure, p));
      if (of.filter()) cells.emplace_back(of.mean(kind.figure));
    }
    if (of.filter()) {
      const auto runs = of.cross_time_of_runs();
      const auto crossed = of.runs_crossed();
      const auto curves = of.cross_time_of_curves();
      const auto f = static_cast<std::size_t>(of.filter() - found.experiment.filters.data());
      for (Cell cell : {Cell(runs), Cell(runs ? runs->mean : nan), Cell(crossed),
                        Cell(crossed ? fmt::format("{} of {}", *crossed, found.experiment.runs) : "–"), Cell(curves),
                        Cell(curves), Cell(paper_cross_time(found.options.scenario, found.options.group, *of.filter())),
                        found.ns_per_step.empty() ? Cell() : Cell(found.ns_per_step[f])})
        cells.push_back(std::move(cell));
    }
    cells.resize(columns.size());
    table.row(std::move(cells));
  }
  return table;
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
  const ResultTable figures = figures_table(found);
  const auto compared = comparisons(found);
  ResultTable few = figures.part(Part::overview, "filter"), consistency = figures.part(Part::nees, "mean NEES", 1);
  few.rule();
  few.row({"if consistent", {}, {}, {}, "3", "6", "3", {}, {}, {}});
  consistency.rule();
  consistency.row({"if consistent", "3", "3", "3", "6", "6", "6"});
  result.add(figures, {.printed = false, .csv = "filters.csv", .summary = {"results"}});
  result.add(rmse_by_sample(found), {.printed = false, .csv = "rmse.csv"});
  result.add(weights_by_sample(found), {.printed = false, .csv = "weights.csv"});
  result.add(few, {.printed = brief});
  result.add(figures.part(Part::rmse, "position RMSE, m"), {.printed = !brief, .title = "Position RMSE by phase"});
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
  result.add(figures.part(Part::cross_times, "cross-time, sample", 1),
             {.printed = !brief, .title = "Cross-time: when the manoeuvre model overtakes"});
  result.say({{!brief && experiment.mode_sample_shift != 0,
               "(As in the released program, mode weights are counted one sample early.)"}});
  for (std::size_t f = 0; f < found.ns_per_step.size(); ++f)
    result.fact({"not_reproducible", "ns_per_step", experiment.filters[f].name}, found.ns_per_step[f]);

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
  CLI::App& app =
      *program.add_subcommand("simulate", "The paper's experiment (section VI) on simulated radar targets.");
  const auto options = std::make_shared<SimulateOptions>();
  options->output.command = command;
  app.add_option("--scenario", options->scenario, "1: fire control radar, 2: surveillance radar")
      ->check(CLI::IsMember({1, 2}))
      ->capture_default_str();
  app.add_option("--group", options->group, "Group of data and model parameters, section VI.C")
      ->check(CLI::IsMember({1, 2, 3, 4}))
      ->capture_default_str();
  app.add_option("--preset", options->preset,
                 "The experiment as printed (paper_text) or as the authors' program has it (released)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Preset>{{"paper_text", Preset::paper_text}, {"released", Preset::released}}))
      ->option_text("paper_text|released [paper_text]");
  app.add_option("--runs", options->runs, "Monte Carlo runs [100, or 50 for released]")
      ->check(CLI::Range(1, 100000000));
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
  app.callback([options] { simulate_and_report(*options); });
}

}  // namespace sigmax::apps
