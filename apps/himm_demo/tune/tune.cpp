#include "himm_demo/tune/tune.hpp"
#include "shell/command_line.hpp"

namespace sigmax::apps {

#ifndef SIGMAX_TUNING
void run_tune(TuneOptions) {
  throw InputError(
      "this himm_demo was built without an optimiser; install libnlopt-cxx-dev, run cmake again and build it");
}
#endif

void add_tune(CLI::App& program, const std::string& command) {
  Subcommand app(program, "tune", "Fits the settings of filters to recordings.");
  const auto options = std::make_shared<TuneOptions>();
  options->output.command = command;
  app.option("file", options->files, "Recordings, as track reads them").required().type("FILE.csv");
  add_recording(app, options->recording, options->radar);
  app.flag("--truth", options->truth, "Judge by the truth that the recording has: by its RMSE");
  app.option("--models", options->models,
             "Sets of models to choose from, as dwna,dwna+dwpa [the filter's, and each of them alone]")
      .list()
      .type("SET,…");
  app.option("--keep", options->fixed, "What is left as it is: models, sensors, transition, augmentation")
      .list()
      .one_of({"models", "sensors", "transition", "augmentation"})
      .type("WHAT,…");
  app.option("--folds", options->folds, "Parts of the rows, or of the tracks, each held out once").in(2, 20);
  app.option("--starts", options->starts, "Local searches, from the best points of the global one").in(1, 100);
  add_threads(app, options->threads);
  add_seed(app, options->seed, "of the search, and of a simulated radar");
  add_filter_options(app, options->filters);
  app.option("--out", options->out, "Write the settings found, for track --config").type("FILE.toml");
  app.option("--summary", options->output.summary, "Write what was found as data").type("FILE.json");
  app.option("--report", options->output.report, "Write it as a page of charts for a browser").type("FILE.html");
  add_quiet(app, options->output.quiet);
  add_wide(app, options->output.wide);
  app.run([options] { run_tune(*options); });
}

}  // namespace sigmax::apps
