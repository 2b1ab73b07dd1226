#include "recognition_demo/learned_model.hpp"

#include <array>
#include <map>

namespace sigmax::apps {
namespace {

/// A column with its bins, if it is numeric, of some rows.
FeatureCode fitted(const DataColumn& column, const RowChoice& chosen, const LearningOptions& options) {
  FeatureCode code{.name = column.name, .values = column.values, .missing_is_value = column.missing_is_value};
  if (!column.numeric) return code;
  EqualFrequencyFit fit(options.equal_width ? 1 : options.bins);  // for the ends alone, one bin will do
  do {
    for (std::size_t row = 0; row < column.numbers.size(); ++row)
      if (chosen(row)) fit.see(column.numbers[row]);
  } while (fit.wants_another_pass());
  const bool wide = options.equal_width && fit.least() < fit.greatest();
  code.bins = wide ? equal_width(std::array{fit.least(), fit.greatest()}, options.bins) : fit.discretization();
  return code;
}

/// A classifier by relations that were learned. A feature that may be misread has p(reading|feature) as its sensor, in
/// the form that `as_sensor` gives it.
template <Uncertainty Kind, class AsSensor>
Contestant classifier(const LearnedModel& model, std::string name, const Distribution<Kind>& prior,
                      std::vector<Relation<Kind, Kind>> relations, const AsSensor& as_sensor) {
  const double misread = model.options.misread;
  std::vector<FeatureModel<Kind, Kind>> features;
  for (auto& relation : relations) {
    const RandomVariable feature = as_random(relation.to());
    if (misread > 0.0 && feature.size() > 1)
      features.emplace_back(relation, as_sensor(mostly_right(feature, feature, 1.0 - misread, misread)));
    else
      features.emplace_back(std::move(relation));
  }
  return {std::move(name), Classifier<Kind, Kind>{prior, std::move(features)}};
}

template <PossibilityTransform Method>
Contestant fuzzy(const LearnedModel& model, const std::string& name, const Method& method, bool random_sensor) {
  const auto prior = model.options.equal_prior ? uninformative(as_fuzzy(model.counts.pattern()))
                                               : to_possibility(pattern_prior(model.counts), method);
  auto relations = learned_relations(model.counts, model.options.smoothing, method);
  if (random_sensor)
    return classifier(model, name, prior, std::move(relations),
                      [](const auto& sensor) { return with_fuzzy_condition(sensor); });
  return classifier(model, name, prior, std::move(relations),
                    [&](const auto& sensor) { return with_fuzzy_condition(to_possibility(sensor, method)); });
}

/// Where the bins of a feature begin and end, and how often one class was seen in each.
struct Bins {
  std::vector<double> edges, counts;
};

std::size_t place_of(std::vector<std::string>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.emplace_back(name);
  return names.size() - 1;
}

/// A model that has counted nothing yet. Throws UsageError where a feature would be misread more often than read.
LearnedModel begun(const std::string& label, const std::vector<std::string>& classes, std::vector<FeatureCode> codes,
                   const LearningOptions& options) {
  std::vector<RandomVariable> variables;
  for (const FeatureCode& code : codes) {
    variables.emplace_back(code.name, code.labels());
    const auto n = static_cast<double>(variables.back().size());
    if (n > 1.0 && n * options.misread > n - 1.0)
      throw UsageError(
          "--misread {0}: feature {1} has {2} values, so that each other one would be read more often than the right "
          "one: give at most {3:.2f}",
          options.misread, in_quotes(code.name), n, std::floor(100.0 * (n - 1.0) / n) / 100.0);
  }
  Counts counts{RandomVariable{label, classes}, std::move(variables)};
  return {label, {}, std::move(codes), std::move(counts), options};
}

}  // namespace

LearnedModel learn(const DataTable& data, const LearningOptions& options, const RowChoice& chosen) {
  auto codes = each(data.columns, [&](const DataColumn& one) { return fitted(one, chosen, options); });
  LearnedModel model = begun(data.label, data.classes, std::move(codes), options);
  Readings readings;
  for (std::size_t row = 0; row < data.size(); ++row) {
    if (!chosen(row)) continue;
    read(model, data, row, readings);
    model.counts.observe(data.labels[row], readings);
  }
  return model;
}

LearnedModel learn_counts(const std::string& file, const DataOptions& data, const LearningOptions& options) {
  CsvReader reader = open_csv(file);
  const std::size_t label = reader.column(data.label), feature = reader.column("feature");
  const std::size_t lower = reader.column("lower"), upper = reader.column("upper"), count = reader.column("count");
  std::vector<std::string> classes, names;
  std::map<std::pair<std::size_t, std::size_t>, Bins> all;  // by class and feature
  for (CsvRow row; reader.next(row);) {
    const std::string_view name = trimmed(row[feature]);
    if (std::ranges::find(data.ignore, name) != data.ignore.end()) continue;
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

  std::vector<FeatureCode> codes;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& edges = all[{0, i}].edges;
    for (std::size_t c = 0; c < classes.size(); ++c)
      if (all[{c, i}].edges != edges || !(sum_of(all[{c, i}].counts) > 0.0))
        throw InputError({.where = reader.file(),
                          .what = fmt::format("class {}, feature {}", in_quotes(classes[c]), in_quotes(names[i])),
                          .expected = "counts, in the same bins for every class"});
    codes.push_back({.name = names[i], .bins = Discretization{{edges.begin() + 1, edges.end() - 1}}});
  }
  LearnedModel model = begun(data.label, classes, std::move(codes), options);
  const Readings nothing(names.size(), missing);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    double rows = 0.0;  // as many as the most counted feature tells
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto& counts = all[{c, i}].counts;
      rows = std::max(rows, sum_of(counts));
      for (std::size_t b = 0; b < counts.size(); ++b) model.counts.observe_value(c, i, b, counts[b]);
    }
    model.counts.observe(c, nothing, rows);
  }
  return model;
}

void read(const LearnedModel& model, const DataTable& data, std::size_t row, Readings& readings) {
  readings.clear();
  for (std::size_t i = 0; i < model.features.size(); ++i)
    readings.push_back(model.features[i].reading(data.columns[i].value(row)));
}

void add_learning(Subcommand app, std::string& file, DataOptions& data, LearningOptions& learning) {
  app.option("data", file, "A headed CSV file, or - for the standard input; empty cells and ? are missing values")
      .required()
      .type("DATA");
  app.option("--label", data.label, "The column with the class").required().type("COLUMN");
  app.list("--categorical", data.categorical, "Columns to take as words although they hold numbers, or all")
      .type("COLUMN,…|all");
  app.list("--ignore", data.ignore, "Columns to leave out").type("COLUMN,…");
  app.list("--missing", data.missing,
           "Words that are missing values; - NA N/A nan null inf are so in columns of numbers")
      .type("WORD,…");
  app.list("--missing-value", data.missing_value, "Columns of which a missing cell is a value of its own")
      .type("COLUMN,…");
  app.option("--bins", learning.bins, "Bins of a numeric column").in(1, 1000);
  app.flag("--equal-width", learning.equal_width, "Bins of equal width instead of equal frequency");
  app.option("--smoothing", learning.smoothing, "What is added to every count; 1 is Laplace's rule")
      .number_in(0.0, 1e9);
  app.option("--misread", learning.misread,
             "Probability that a reading is not the feature's value but one of the others")
      .number_in(0.0, 0.999);
  app.flag("--equal-prior", learning.equal_prior,
           "Every class is equally plausible before, whatever its share of the rows");
}

std::string described(const DataTable& data) {
  const auto features = data.columns.size();
  const auto numeric = std::ranges::count_if(data.columns, [](const auto& c) { return c.numeric; });
  return fmt::format("{} rows, {} classes, {} {} ({} categorical, {} numeric)", data.size(), data.classes.size(),
                     features, features == 1 ? "feature" : "features", static_cast<long>(features) - numeric, numeric);
}

std::string described(const LearningOptions& options) {
  std::string text = options.smoothing == 1.0 ? std::string("counts smoothed by Laplace's rule")
                                              : fmt::format("{} added to every count", options.smoothing);
  text += options.equal_prior ? "; every class equally plausible before" : "; prior by the classes' shares of the rows";
  if (options.misread > 0.0) text += fmt::format("; a reading is wrong with probability {}", options.misread);
  return text;
}

std::vector<Contestant> classifiers(const LearnedModel& model, std::span<const std::string> kinds) {
  const auto wanted = [&](std::string_view kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
  std::vector<Contestant> all;
  if (wanted("sigma"))
    all.push_back(classifier(
        model, "sigma", model.options.equal_prior ? uninformative(model.counts.pattern()) : pattern_prior(model.counts),
        learned_relations(model.counts, model.options.smoothing), std::identity{}));
  for (const bool random_sensor : {false, true}) {
    const std::string kind = random_sensor ? "sigma-max" : "max";
    const bool beside_max = random_sensor && wanted("max");
    if (!wanted(kind) || (beside_max && model.options.misread == 0.0)) continue;
    if (!beside_max) all.push_back(fuzzy(model, kind + ", ratio scale", RatioScale{}, random_sensor));
    all.push_back(fuzzy(model, kind + ", Dubois-Prade", DuboisPrade{}, random_sensor));
  }
  return all;
}

}  // namespace sigmax::apps
