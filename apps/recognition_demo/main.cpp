#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "recognition_demo/classify.hpp"
#include "recognition_demo/encounter.hpp"
#include "recognition_demo/esm.hpp"
#include "recognition_demo/evaluate.hpp"
#include "recognition_demo/manoeuvre.hpp"
#include "recognition_demo/performance.hpp"
#include "recognition_demo/regimes.hpp"
#include "recognition_demo/train.hpp"
#include "support/run.hpp"
#include "version.hpp"

namespace {

using namespace sigmax::apps;

constexpr int exit_usage = 2;

template <class Options>
void add_out(CLI::App& app, Options& options) {
  app.add_option("--out", options.out, "Directory for the result files")->type_name("DIR");
}
void add_quiet(CLI::App& app, bool& quiet) { app.add_flag("--quiet", quiet, "No progress bar"); }

/// What the subcommands with random draws share.
template <class Options>
void add_draws(CLI::App& app, Options& options) {
  app.add_option("--runs", options.runs, "Simulated runs")->check(CLI::Range(2, 100000000))->capture_default_str();
  app.add_option("--seed", options.seed, "Seed of the random numbers")->capture_default_str();
  app.add_option("--threads", options.threads, "Threads; the results do not depend on it [all]")
      ->check(CLI::Range(1, 4096));
  add_out(app, options);
  add_quiet(app, options.quiet);
}

/// What `train` and `evaluate` share.
template <class Options>
void add_learning(CLI::App& app, Options& options) {
  app.add_option("data", options.file, "A headed CSV file; empty cells and ? are missing values")
      ->required()
      ->type_name("DATA");
  app.add_option("--label", options.data.label, "The column with the class")->required()->type_name("COLUMN");
  app.add_option("--categorical", options.data.categorical,
                 "A column to take as words although it holds numbers, or all; may be repeated")
      ->type_name("COLUMN|all")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--ignore", options.data.ignore, "A column to leave out; may be repeated")
      ->type_name("COLUMN")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--bins", options.learning.bins, "Bins of a numeric column")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--equal-width", options.learning.equal_width, "Bins of equal width instead of equal frequency");
  app.add_option("--smoothing", options.learning.smoothing, "What is added to every count; 1 is Laplace's rule")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  app.add_option("--misread", options.learning.misread,
                 "Probability that a reading is not the feature's value but one of the others")
      ->check(CLI::Range(0.0, 0.999))
      ->capture_default_str();
  app.add_flag("--equal-prior", options.learning.equal_prior,
               "Every class is equally plausible before, whatever its share of the rows");
}

}  // namespace

int main(int argc, char** argv) {
  std::string command = "recognition_demo";
  for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);

  CLI::App app{
      "Recognises patterns by sigma inference (probabilities), max inference (possibilities) and sigma-max inference "
      "(both). Without a subcommand it runs esm.",
      "recognition_demo"};
  app.set_version_flag("--version", fmt::format("recognition_demo {}", version));
  app.require_subcommand(0, 1);
  app.footer("recognition_demo SUBCOMMAND --help lists the options of a subcommand, with examples.");

  EsmOptions esm;
  esm.command = command;
  CLI::App& esm_app =
      *app.add_subcommand("esm", "Which platform is it? A synthetic world of emitters, all classifiers.");
  esm_app.add_option("--usage", esm.usage, "How often a platform uses its emitters: equally, or drawn for each run")
      ->check(CLI::IsMember({"uniform", "dirichlet"}))
      ->capture_default_str();
  const CLI::Option* const alpha =
      esm_app.add_option("--alpha", esm.alpha, "Parameter of the Dirichlet density; the smaller, the less equal")
          ->check(CLI::Range(0.01, 1000.0))
          ->capture_default_str();
  esm_app.add_option("--reports", esm.reports, "Reports in a run")->check(CLI::Range(1, 100000))->capture_default_str();
  add_draws(esm_app, esm);
  esm_app.footer(
      "Examples:\n"
      "  recognition_demo esm --usage dirichlet --alpha 0.5\n"
      "  recognition_demo esm --reports 100 --runs 5000 --out results");

  RegimesOptions regimes;
  regimes.command = command;
  CLI::App& regimes_app = *app.add_subcommand(
      "regimes",
      "Where is max inference the better one? The synthetic world, with beliefs that are wrong in several ways.");
  regimes_app.add_option("--reports", regimes.reports, "Reports in a run")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_draws(regimes_app, regimes);
  regimes_app.footer(
      "Examples:\n"
      "  recognition_demo regimes\n"
      "  recognition_demo regimes --reports 10 --runs 5000 --out results");

  ManoeuvreOptions manoeuvre;
  manoeuvre.command = command;
  CLI::App& manoeuvre_app =
      *app.add_subcommand("manoeuvre", "Airliner, bomber or fighter? From how a tracked target manoeuvres; simulated.");
  add_draws(manoeuvre_app, manoeuvre);
  manoeuvre_app.footer(
      "Examples:\n"
      "  recognition_demo manoeuvre\n"
      "  recognition_demo manoeuvre --runs 1000 --out results");

  EncounterOptions encounter;
  encounter.command = command;
  CLI::App& encounter_app = *app.add_subcommand(
      "encounter", "What class of aircraft is it? From counts of altitude, airspeed, climb and turn rate.");
  encounter_app
      .add_option("counts", encounter.file, "Counts by class and feature: class,feature,bin,lower,upper,count")
      ->required()
      ->type_name("COUNTS.csv");
  encounter_app.add_option("--reports", encounter.reports, "Reports in a drawn run")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  CLI::Option* const track_option =
      encounter_app
          .add_option("--track", encounter.track,
                      "Instead of drawing, classify a recording: time_s, altitude_ft (or altitude_gnss_ft), "
                      "groundspeed_kt (or tas_kt), track_deg, vertical_rate_fpm (or roc_fpm)")
          ->type_name("FILE.csv");
  encounter_app.add_option("--every", encounter.every_s, "Seconds between two reports of a recording")
      ->check(CLI::Range(0.001, 1e6))
      ->needs(track_option)
      ->capture_default_str();
  CLI::Option* const ground_option =
      encounter_app
          .add_option("--ground", encounter.ground_ft, "Altitude of the ground, in ft [the recording's lowest]")
          ->needs(track_option)
          ->type_name("FT");
  add_draws(encounter_app, encounter);
  encounter_app.footer(
      "Examples:\n"
      "  recognition_demo encounter encounter_features.csv\n"
      "  recognition_demo encounter encounter_features.csv --track helicopter.csv --every 30");

  PerformanceOptions performance;
  performance.command = command;
  CLI::App& performance_app = *app.add_subcommand(
      "performance", "Which type of aircraft is it? From [min, opt, max] and from densities of the same quantities.");
  performance_app.add_option("data", performance.file, "type,variable,optimum,minimum,maximum,model,parameters")
      ->required()
      ->type_name("PERFORMANCE.csv");
  performance_app.add_option("--draws", performance.draws, "What the quantities are drawn from")
      ->check(CLI::IsMember({"density", "triangle"}))
      ->capture_default_str();
  performance_app.add_option("--bins", performance.bins, "Bins of a quantity")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  performance_app.add_option("--least", performance.least, "Possibility of what lies outside [min, max]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  add_draws(performance_app, performance);
  performance_app.footer(
      "Examples:\n"
      "  recognition_demo performance openap_performance.csv\n"
      "  recognition_demo performance openap_performance.csv --draws triangle --least 0.1");

  TrainOptions train;
  std::vector<std::string> kinds(std::begin(kind_names), std::end(kind_names));
  CLI::App& train_app = *app.add_subcommand("train", "Learns a model from labelled data.");
  add_learning(train_app, train);
  train_app.add_option("--model", train.model, "The model to write")->required()->type_name("MODEL.json");
  train_app.add_option("--kinds", kinds, "The kinds of classifiers in the model")
      ->delimiter(',')
      ->check(CLI::IsMember({"sigma", "max", "sigma-max"}))
      ->option_text("sigma,max,sigma-max [all]");
  add_quiet(train_app, train.data.quiet);
  train_app.footer(
      "Examples:\n"
      "  recognition_demo train zoo.csv --label type --ignore name --categorical all --model zoo.json\n"
      "  recognition_demo train wine.csv --label class --bins 5 --kinds sigma,max --model wine.json");

  ClassifyOptions classify;
  classify.command = command;
  CLI::App& classify_app = *app.add_subcommand("classify", "Classifies the rows of a file by a model.");
  classify_app.add_option("model", classify.model, "A model that `train` wrote")->required()->type_name("MODEL.json");
  classify_app.add_option("data", classify.file, "A headed CSV file with the model's columns")
      ->required()
      ->type_name("DATA");
  classify_app.add_flag("--explain", classify.explain, "Say why, for the rows that are shown");
  classify_app.add_option("--rows", classify.rows, "How many rows to show")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  classify_app
      .add_option("--least-margin", classify.least_margin,
                  "Reject decisions whose lead in probability, or necessity, is smaller")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  add_out(classify_app, classify);
  add_quiet(classify_app, classify.quiet);
  classify_app.footer(
      "Examples:\n"
      "  recognition_demo classify zoo.json zoo.csv --explain --rows 1\n"
      "  recognition_demo classify wine.json cellar.csv --least-margin 0.5 --out results");

  EvaluateOptions evaluate;
  evaluate.command = command;
  CLI::App& evaluate_app =
      *app.add_subcommand("evaluate", "Cross-validates every kind of classifier on labelled data.");
  add_learning(evaluate_app, evaluate);
  evaluate_app.add_option("--folds", evaluate.folds, "Parts of the data, each classified by what the others teach")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  evaluate_app.add_option("--seed", evaluate.seed, "Seed of the folds")->capture_default_str();
  evaluate_app.add_option("--threads", evaluate.threads, "Threads; the results do not depend on it [all]")
      ->check(CLI::Range(1, 4096));
  add_out(evaluate_app, evaluate);
  add_quiet(evaluate_app, evaluate.quiet);
  evaluate_app.footer(
      "Examples:\n"
      "  recognition_demo evaluate mushroom.csv --label edible --ignore veil_type\n"
      "  recognition_demo evaluate letter.csv --label letter --categorical all --out results");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }

  return run_program("recognition_demo", [&] {
    if (train_app.parsed()) {
      train.kinds = kinds;
      train_and_report(train);
    } else if (classify_app.parsed()) {
      classify_and_report(classify);
    } else if (evaluate_app.parsed()) {
      evaluate.data.quiet = evaluate.quiet;
      evaluate_and_report(evaluate);
    } else if (manoeuvre_app.parsed()) {
      manoeuvre_and_report(manoeuvre);
    } else if (regimes_app.parsed()) {
      regimes_and_report(regimes);
    } else if (encounter_app.parsed()) {
      if (ground_option->count() == 0) encounter.ground_ft.reset();
      encounter_and_report(encounter);
    } else if (performance_app.parsed()) {
      performance_and_report(performance);
    } else {
      if (alpha->count() > 0 && esm.usage == "uniform") throw UsageError("--alpha needs --usage dirichlet");
      esm_and_report(esm);
    }
  });
}
