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
  bool counts = false;  ///< what the file holds, else rows
  std::string model;    ///< the file to write
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

LearnedModel of_rows(const TrainOptions& options, Result& result) {
  const DataTable data = read_data(options.file, options.data, options.output.quiet);
  print_findings(data);
  LearnedModel model = learn(data, options.learning);
  model.missing = options.data.missing;
  model.right = right_when_left_out(data, options.learning);
  result.say("{}: {}", data.file, described(data));
  return model;
}

LearnedModel of_counts(const TrainOptions& options, Result& result) {
  LearnedModel model = learn_counts(options.file, options.data, options.learning);
  model.missing = options.data.missing;
  for (std::size_t c = 0; c < model.counts.pattern().size(); ++c)
    result.say("{}: {}, {} counted", options.file, model.counts.pattern().label(c), model.counts.rows(c));
  return model;
}

void run_train(const TrainOptions& options) {
  refuse_to_overwrite("--model", options.model, {options.file});
  Result result = result_of_contest("", options.output);
  const LearnedModel model = options.counts ? of_counts(options, result) : of_rows(options, result);
  write_model(model, options.kinds, options.model);
  result.say(described(options.learning));
  result.add(features_table(model), {});
  for (const Contestant& classifier : classifiers(model, options.kinds)) {
    const auto found = dominated({classifier});
    if (found.empty()) continue;
    result.say("warning: {} can never prefer {}: whatever is read, {} is at least as possible{}", classifier.name,
               in_quotes(found[0].pattern), in_quotes(found[0].dominator),
               found.size() == 1 ? ""
                                 : fmt::format("; so it is with {} others of {} classes", found.size() - 1,
                                               model.counts.pattern().size()));
  }
  fmt::print("{}\nWrote {}\n", result.text, options.model);
}

}  // namespace

void add_train(CLI::App& program, const std::string&) {
  const auto options = std::make_shared<TrainOptions>();
  Subcommand app(program, "train", "Learns a model from labelled data.");
  add_learning(app, options->file, options->data, options->learning);
  app.flag("--counts", options->counts,
           "DATA holds counts instead of rows: the label, feature, lower, upper, count, a row for each bin");
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
