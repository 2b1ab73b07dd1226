#include <map>
#include <numeric>

#include <sigmax/recognition/dominance.hpp>

#include "recognition_demo/learning.hpp"

namespace sigmax::apps {
namespace {

struct TrainOptions {
  std::string file;
  TableReading data;
  TableOptions learning;
  std::vector<std::string> kinds = kind_names;
  bool counts = false;  ///< what the file holds, else rows
  std::string model;    ///< the file to write
  OutputOptions output;
};

ResultTable features_table(const TableModel& model) {
  ResultTable table({of_words("", "feature"), {.header = "values"}, of_words("", "what they are")});
  for (const TableFeature& feature : model.features) {
    const auto labels = feature.labels();
    table.row({feature.name, labels.size(), listed(labels, feature.bins ? labels.size() : 6)});
  }
  return table;
}

TableModel of_rows(const TrainOptions& options, Result& result) {
  const LabelledTable data = read_table(options.file, options.data, options.output.quiet);
  print_findings(data);
  result.say("{}: {}", data.file, described(data));
  return TableModel::fit(data.columns, {data.label, data.classes}, data.labels, options.learning);
}

/// Where the bins of a feature begin and end, and how often one class was seen in each.
struct Bins {
  std::vector<double> edges, counts;

  double sum() const { return std::accumulate(counts.begin(), counts.end(), 0.0); }
};

std::size_t place_of(std::vector<std::string>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.emplace_back(name);
  return names.size() - 1;
}

/// Learns of a headed CSV file that holds counts instead of rows: the label, feature, lower, upper, count, a row for
/// each bin. Throws InputError with file, line, column and value where bins leave a gap, and for a class or a feature
/// without counts.
TableModel of_counts(const TrainOptions& options, Result& result) {
  CsvReader reader = open_csv(options.file);
  const std::size_t label = reader.column(options.data.label), feature = reader.column("feature");
  const std::size_t lower = reader.column("lower"), upper = reader.column("upper"), count = reader.column("count");
  std::vector<std::string> classes, names;
  std::map<std::pair<std::size_t, std::size_t>, Bins> all;  // by class and feature
  for (CsvRow row; reader.next(row);) {
    const std::string_view name = trimmed(row[feature]);
    if (std::ranges::find(options.data.ignore, name) != options.data.ignore.end()) continue;
    for (const std::size_t column : {label, feature})
      if (row.blank(column)) throw row.error(column, "a name");
    const std::size_t c = place_of(classes, trimmed(row[label]));
    Bins& bins = all[{c, place_of(names, name)}];
    if (row.blank(lower))
      throw row.error(lower, "where the bin begins", fmt::format("leave the feature out: --ignore {}", name));
    const double begin = row.number(lower), end = row.number(upper), times = row.number(count);
    if (bins.edges.empty()) bins.edges.push_back(begin);
    if (bins.edges.back() != begin)
      throw row.error(lower, fmt::format("{}, where the bin before ends", bins.edges.back()));
    if (!(end > begin)) throw row.error(upper, fmt::format("a number above {}", begin));
    if (times < 0.0) throw row.error(count, "a count that is not negative");
    bins.edges.push_back(end);
    bins.counts.push_back(times);
  }
  if (classes.size() < 2)
    throw InputError("{}: found {} classes, expected at least two", reader.file(), classes.size());

  std::vector<TableFeature> features;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& edges = all[{0, i}].edges;
    for (std::size_t c = 0; c < classes.size(); ++c)
      if (all[{c, i}].edges != edges || !(all[{c, i}].sum() > 0.0))
        throw InputError({.where = reader.file(),
                          .what = fmt::format("class {}, feature {}", in_quotes(classes[c]), in_quotes(names[i])),
                          .expected = "counts, in the same bins for every class"});
    features.push_back({.name = names[i], .bins = Discretization{{edges.begin() + 1, edges.end() - 1}}});
  }
  TableModel model{RandomVariable{options.data.label, classes}, std::move(features), options.learning};
  const Readings nothing(names.size(), missing);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    double rows = 0.0;  // as many as the most counted feature tells
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto& counts = all[{c, i}].counts;
      rows = std::max(rows, all[{c, i}].sum());
      for (std::size_t b = 0; b < counts.size(); ++b) model.counts.observe_value(c, i, b, counts[b]);
    }
    model.counts.observe(c, nothing, rows);
    result.say("{}: {}, {} counted", options.file, classes[c], rows);
  }
  return model;
}

void run_train(const TrainOptions& options) {
  refuse_to_overwrite("--model", options.model, {options.file});
  Result result = comparison_result("", options.output);
  const TableModel model = options.counts ? of_counts(options, result) : of_rows(options, result);
  const auto all = classifiers(model, options.kinds);
  write_model({model, options.kinds, options.data.missing}, options.model);
  result.say(described(options.learning));
  result.add(features_table(model), {});
  for (const TableClassifier& one : all) {
    const auto found =
        std::visit([](const auto& classifier) { return dominated_patterns(classifier); }, one.classifier());
    if (found.empty()) continue;
    const auto& pattern = model.counts.pattern();
    result.say(
        "warning: {} can never prefer {}: whatever is read, {} is at least as possible{}", one.name(),
        in_quotes(pattern.label(found[0].pattern)), in_quotes(pattern.label(found[0].dominator)),
        found.size() == 1 ? "" : fmt::format("; so for {} others of {} classes", found.size() - 1, pattern.size()));
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
