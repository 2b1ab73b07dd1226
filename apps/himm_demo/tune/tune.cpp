#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "himm_demo/filters/keys.hpp"
#include "himm_demo/subcommands.hpp"
#include "himm_demo/tune/report.hpp"
#include "result/result.hpp"
#include "support/command_line.hpp"
#include "support/error.hpp"
#include "support/options.hpp"
#include "support/output.hpp"
#include "support/parallel.hpp"
#include "support/progress.hpp"

namespace sigmax::apps {

namespace {

/// What is read must not be written over.
void refuse_inputs(const TuneOptions& options) {
  auto inputs = options.files;
  inputs.push_back(options.config);
  refuse_to_overwrite("--out", options.out, inputs);
  refuse_to_overwrite("--summary", options.summary, inputs);
  refuse_to_overwrite(options.page, inputs);
}

void refuse_without_search() {
  if (!can_search())
    throw InputError(message({.what = "this himm_demo was built without an optimiser",
                              .remedy = "install libnlopt-cxx-dev, run cmake again and build it"}));
}

/// The likelihood that has no determinant finds any measurement possible where the noise is great enough.
void refuse_possibility(const FilterSettings& filter, Objective objective) {
  if (objective == Objective::prequential && filter.likelihood == LikelihoodForm::possibility)
    throw InputError(message({.what = fmt::format("filter '{}': likelihood = \"possibility\"", filter.name),
                              .expected = "\"density\", since a possibility never blames noise that is too great",
                              .remedy = "tune with --truth, or with likelihood=density"}));
}

std::string heading(const TuneData& data, const TuneOptions& options) {
  const std::map<Objective, std::string_view> by = {
      {Objective::prequential, "how well each measurement was predicted (nats a row; less is better)"},
      {Objective::rmse, "the RMSE of the position against the truth"},
      {Objective::density, "the density of the true position (nats a row; less is better)"}};
  std::string text = fmt::format("{} measurements of {} track{}", data.measurements, data.tracks.size(),
                                 data.tracks.size() == 1 ? "" : "s");
  if (data.too_short > 0) text += fmt::format(" ({} too short)", data.too_short);
  const bool by_track = data.tracks.size() >= 2 * options.folds;
  return fmt::format("{}, judged by {}. Held out: {} folds {}.", text, by.at(options.objective), options.folds,
                     by_track ? "of tracks" : "in time");
}

/// Tunes one filter, prints what was found, and adds what is to be written.
TuneFindings tune_and_report(const FilterSettings& filter, const TuneData& data, const TuneOptions& options,
                             std::vector<FilterSettings>& written) {
  Diagnosis before = diagnose(data, filter, options.objective);
  fmt::print("\nfilter {}: before\n\n{}\n", printable(filter.name), text_of(before, options.page.width()));
  Progress progress(filter.name, work_of(filter, data, options), options.page.quiet);
  TunedFilter tuned = tune(filter, data, options, [&](std::size_t work) { progress.advance(work); });
  progress.finish();
  fmt::print("{}", text_of(tuned, options.objective, options.page.width()));

  std::optional<Diagnosis> after;
  if (tuned.selected.best > 0) {
    after = diagnose(data, tuned.best().settings, options.objective);
    fmt::print("\nfilter {}: with the best settings\n\n{}", printable(filter.name),
               text_of(*after, options.page.width()));
    if (before.rmse_m && after->rmse_m)
      fmt::print("RMSE against the truth: {:.4g} m before, {:.4g} m now.\n", *before.rmse_m, *after->rmse_m);
  }
  written.push_back(tuned.best().settings);
  if (tuned.selected.simple != tuned.selected.best) {
    written.push_back(tuned.simple().settings);
    written.back().name += "_simple";
  }
  return {std::move(before), std::move(after), std::move(tuned)};
}

Objective objective_of(const std::string& truth) {
  if (truth.empty() || truth == "false") return Objective::prequential;
  if (truth == "rmse" || truth == "true") return Objective::rmse;
  if (truth == "density") return Objective::density;
  throw UsageError(
      message({.what = "--truth", .found = in_quotes(truth), .expected = "--truth, --truth=rmse or --truth=density"}));
}

void tune_and_write(TuneOptions options) {
  options.objective = objective_of(options.truth);
  const auto filters = filters_for(options.recording, options.config, options.sets, options.radar.sigma);
  if (options.print_config) {
    fmt::print("{}", as_toml(filters));
    return;
  }
  refuse_without_search();
  for (const auto& filter : filters) {
    refuse_possibility(filter, options.objective);
    model_sets(filter, options);  // refuses what is none
  }
  options.threads = threads_or_all(options.threads);
  refuse_inputs(options);
  std::optional<AtomicFile> file, summary;  // made first, so that a bad name is known before the work
  if (!options.out.empty()) file.emplace(options.out);
  if (!options.summary.empty()) summary.emplace(options.summary);
  ResultFiles page(options.page);
  const TuneData data = read_tune_data(options);
  fmt::print("{}", wrapped(heading(data, options)));
  for (const std::string& note : data.notes) fmt::print("{}", wrapped(note));
  std::vector<FilterSettings> written;
  std::vector<TuneFindings> found;
  for (const auto& filter : filters) found.push_back(tune_and_report(filter, data, options, written));
  if (page.report_wanted()) page.write_report(page_of(heading(data, options), options, data, found));
  if (summary) summary->write(summary_of(options, data, found).dump(2) + "\n");
  if (file) file->write(as_toml(written));
  page.commit();
  if (summary) {
    summary->commit();
    fmt::print("\nWrote {}\n", printable(options.summary));
  }
  if (!file) return;
  file->commit();
  fmt::print("\nWrote {}, which track --config takes\n", printable(options.out));
}

}  // namespace

void add_tune(CLI::App& program, const std::string& command) {
  Subcommand app(program, "tune", "Fits the settings of filters to recordings.");
  const auto options = std::make_shared<TuneOptions>();
  options->page.command = command;
  app.option("file", options->files, "Recordings, as track reads them").required().type("FILE.csv");
  add_recording(app, options->recording, options->radar);
  app.flag("--truth{rmse}", options->truth,
           "Judge by the truth that the recording has: by its RMSE, or by its density with --truth=density");
  app.option("--models", options->models,
             "Sets of models to choose from, as dwna,dwna+dwpa [the filter's, and each of them alone]")
      .list_alone()
      .type("SET,…");
  app.option("--keep", options->fixed, "What is left as it is: models, sensors, transition, lift")
      .list_alone()
      .one_of({"models", "sensors", "transition", "lift"})
      .type("WHAT,…");
  app.option("--folds", options->folds, "Parts of the rows, or of the tracks, each held out once")
      .in(2, 20)
      .shows_default();
  app.option("--starts", options->starts, "Searches from different places").in(1, 100).shows_default();
  add_threads(app, options->threads);
  add_seed(app, options->seed, "of the starts, and of a simulated radar");
  add_filter_options(app, options->config, options->sets, options->print_config);
  app.option("--out", options->out, "Write the settings found, for track --config").type("FILE.toml");
  app.option("--summary", options->summary, "Write what was found as data").type("FILE.json");
  app.option("--report", options->page.report, "Write it as a page of charts for a browser").type("FILE.html");
  add_quiet(app, options->page.quiet);
  add_wide(app, options->page.wide);
  app.footer(
      "Examples:\n"
      "  himm_demo tune flight.csv --out best.toml\n"
      "  himm_demo tune flight.csv --radar 50,0.1,0.1 --radar-at=-20000,-10000,0 --truth\n"
      "  himm_demo tune a.csv b.csv --models dwna,dwna+dwpa,dwna+ct --set filters=imm");
  app.run([options] { tune_and_write(*options); });
}

}  // namespace sigmax::apps
