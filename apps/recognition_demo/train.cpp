#include "recognition_demo/folding.hpp"
#include "recognition_demo/subcommands.hpp"
#include "recognition_demo/table_checks.hpp"

namespace sigmax::apps {
namespace {

struct TrainOptions {
  std::string file;
  DataOptions data;
  LearningOptions learning;
  std::vector<std::string> kinds = kind_names;
  std::string model;  ///< the file to write
  OutputOptions output;
};

ResultTable features_table(const LearnedModel& model) {
  ResultTable table({of_words("", "feature"), {.header = "values"}, of_words("", "what they are")});
  for (const FeatureCode& feature : model.features) {
    const auto labels = feature.labels();
    table.row({feature.name, labels.size(), listed(labels, feature.bins ? labels.size() : 6)});
  }
  return table;
}

void run_train(const TrainOptions& options) {
  refuse_to_overwrite("--model", options.model, {options.file});
  const DataTable data = read_data(options.file, options.data, options.output.quiet);
  print_findings(data);
  LearnedModel model = learn(data, options.learning);
  model.missing = options.data.missing;
  model.right = right_when_left_out(data, options.learning);
  write_model(model, options.kinds, options.model);

  Result result = result_of_contest("", options.output);
  result.say("{}: {}\n{}", data.file, described(data), described(options.learning));
  result.add(features_table(model), {});
  for (const Contestant& classifier : classifiers(model, options.kinds)) {
    const auto found = dominated({classifier});
    if (found.empty()) continue;
    result.say("warning: {} can never prefer {}: whatever is read, {} is at least as possible{}", classifier.name,
               in_quotes(found[0].pattern), in_quotes(found[0].dominator),
               found.size() == 1
                   ? ""
                   : fmt::format("; so it is with {} others of {} classes", found.size() - 1, data.classes.size()));
  }
  fmt::print("{}\nWrote {}\n", result.text, options.model);
}

}  // namespace

void add_train(CLI::App& program, const std::string&) {
  const auto options = std::make_shared<TrainOptions>();
  Subcommand app(program, "train", "Learns a model from labelled data.");
  add_learning(app, options->file, options->data, options->learning);
  app.option("--model", options->model, "The model to write").required().type("MODEL.json");
  app.option("--kinds", options->kinds, "The kinds of classifiers in the model")
      .list()
      .one_of(kind_names)
      .text("sigma,max,sigma-max [all]");
  add_quiet(app, options->output.quiet);
  add_wide(app, options->output.wide);
  app.run([options] { run_train(*options); });
}

}  // namespace sigmax::apps
