#include "recognition_demo/learned_model.hpp"

#include <cmath>
#include <map>
#include <numeric>

#include <sigmax/recognition/discretization.hpp>

namespace sigmax::apps {
namespace {

/// The columns with the bins of numeric ones, of some rows; several passes over long tables.
std::vector<FeatureCode> fitted(const DataTable& data, const RowChoice& chosen, const LearningOptions& options) {
  std::map<std::size_t, EqualFrequencyFit> fits;         // by column
  for (std::size_t i = 0; i < data.columns.size(); ++i)  // for the ends alone, one bin will do
    if (data.columns[i].numeric) fits.emplace(i, options.equal_width ? 1 : options.bins);
  for (bool another_pass = !fits.empty(); another_pass;) {
    data.for_each([&](const DataRow& row) {
      if (!chosen(row)) return;
      for (auto& [column, fit] : fits) fit.see(row.number(column));
    });
    another_pass = false;
    for (auto& [column, fit] : fits) another_pass |= fit.wants_another_pass();
  }
  std::vector<FeatureCode> codes;
  for (const DataColumn& column : data.columns) codes.push_back({column.name, column.values, std::nullopt});
  for (const auto& [column, fit] : fits) {
    FeatureCode& code = codes[column];
    code.least = fit.least();
    code.greatest = fit.greatest();
    const bool wide = options.equal_width && code.least < code.greatest;
    code.bins = wide ? equal_width(std::array{code.least, code.greatest}, options.bins) : fit.discretization();
  }
  return codes;
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

}  // namespace

LearnedModel learn(const DataTable& data, const LearningOptions& options, const RowChoice& chosen) {
  auto codes = fitted(data, chosen, options);
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
  Counts counts{RandomVariable{data.label, data.classes}, std::move(variables)};
  LearnedModel model{data.label, {}, std::move(codes), std::move(counts), options};
  Readings readings;
  data.for_each([&](const DataRow& row) {
    if (!chosen(row)) return;
    read(model, row, readings);
    model.counts.observe(row.label(), readings);
  });
  return model;
}

void read(const LearnedModel& model, const DataRow& row, Readings& readings) {
  readings.clear();
  for (std::size_t i = 0; i < model.features.size(); ++i) {
    if (const auto& bins = model.features[i].bins) {
      readings.push_back(bins->bin(row.number(i)));
    } else {
      const Code code = row.code(i);
      readings.push_back(code == missing_code ? missing : code);
    }
  }
}

void add_learning(CLI::App& program, std::string& file, DataOptions& data, LearningOptions& learning) {
  Subcommand app(program);
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
  app.option("--bins", learning.bins, "Bins of a numeric column").in(1, 1000).shows_default();
  app.flag("--equal-width", learning.equal_width, "Bins of equal width instead of equal frequency");
  app.option("--smoothing", learning.smoothing, "What is added to every count; 1 is Laplace's rule")
      .number_in(0.0, 1e9)
      .shows_default();
  app.option("--misread", learning.misread,
             "Probability that a reading is not the feature's value but one of the others")
      .number_in(0.0, 0.999)
      .shows_default();
  app.flag("--equal-prior", learning.equal_prior,
           "Every class is equally plausible before, whatever its share of the rows");
}

void print_warnings(const DataTable& data, const LearningOptions& options) {
  const auto warn = [](const std::string& warning) { complain("recognition_demo: warning: " + warning); };
  for (const auto& warning : data.warnings) warn(warning);
  if (!options.equal_width || options.bins < 3) return;
  const LearnedModel model = learn(data, options);
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    if (!data.columns[i].numeric) continue;
    std::vector<double> in_bin(model.features[i].labels().size());
    for (std::size_t c = 0; c < data.classes.size(); ++c)
      for (std::size_t bin = 0; bin < in_bin.size(); ++bin) in_bin[bin] += model.counts.of(i, c)[bin];
    const double all = std::accumulate(in_bin.begin(), in_bin.end(), 0.0), most = std::ranges::max(in_bin);
    if (most > 0.95 * all)
      warn(
          fmt::format("{}: column {}: {:.3g} % of the numbers are in one of {} bins of equal width, since few are far "
                      "from all others: leave out --equal-width, or those if they are slips or stand for none",
                      data.file, in_quotes(data.columns[i].name), 100.0 * most / all, in_bin.size()));
  }
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
    if (!wanted(kind)) continue;
    all.push_back(fuzzy(model, kind + ", ratio scale", RatioScale{}, random_sensor));
    all.push_back(fuzzy(model, kind + ", Dubois-Prade", DuboisPrade{}, random_sensor));
  }
  return all;
}

}  // namespace sigmax::apps
