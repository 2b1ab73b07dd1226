#include "recognition_demo/learned_model.hpp"

#include <map>

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
      for (auto& [column, fit] : fits) fit.see(row.value(column));
    });
    another_pass = false;
    for (auto& [column, fit] : fits) another_pass |= fit.wants_another_pass();
  }
  auto codes = each(data.columns, [](const DataColumn& one) { return FeatureCode{one.name, one.values, {}}; });
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

/// Σ n log(n/Σ n): where counts are parted, the sum of these grows by what that tells.
double knowledge(const std::vector<double>& counts) {
  double sum = 0.0, result = 0.0;
  for (const double n : counts) {
    sum += n;
    result += n > 0.0 ? n * std::log(n) : 0.0;
  }
  return sum > 0.0 ? result - sum * std::log(sum) : 0.0;
}

using BinCounts = std::vector<std::vector<double>>;

/// How often each class stands in each bin of a column.
BinCounts classes_of_bins(const LearnedModel& model, std::size_t column) {
  const std::size_t classes = model.counts.pattern().size();
  BinCounts found(model.features[column].labels().size(), std::vector<double>(classes));
  for (std::size_t c = 0; c < classes; ++c)
    for (std::size_t bin = 0; bin < found.size(); ++bin) found[bin][c] = model.counts.of(column, c)[bin];
  return found;
}

/// How often one class stands in each bin, and all others.
BinCounts against_others(const BinCounts& bins, std::size_t its_class) {
  return each(bins, [&](const std::vector<double>& counts) {
    return std::vector{counts[its_class], sum_of(counts) - counts[its_class]};
  });
}

/// How often each class stands in all bins together.
std::vector<double> joined(const BinCounts& bins) {
  std::vector<double> all(bins.front().size());
  for (const auto& counts : bins)
    for (std::size_t c = 0; c < all.size(); ++c) all[c] += counts[c];
  return all;
}

double knowledge_by(const BinCounts& bins) { return sum_of(bins, knowledge); }

/// What is known from the one of the limits between bins that tells most, more than from none.
double told_by_a_limit(const BinCounts& bins) {
  const auto all = joined(bins);
  std::vector<double> below(all.size()), above = all;
  double most = 0.0;
  for (const auto& counts : bins) {
    for (std::size_t c = 0; c < all.size(); ++c) below[c] += counts[c], above[c] -= counts[c];
    most = std::max(most, knowledge(below) + knowledge(above) - knowledge(all));
  }
  return most;
}

/// The greatest share of the numbers that is in one bin.
double fullest(const BinCounts& bins) {
  return std::ranges::max(each(bins, [](const auto& own) { return sum_of(own); })) / sum_of(joined(bins));
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
    const double value = row.value(i);
    const auto& bins = model.features[i].bins;
    readings.push_back(bins ? bins->bin(value) : std::isnan(value) ? missing : static_cast<std::size_t>(value));
  }
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

double told_of_class(const LearnedModel& model, std::size_t column) {
  const auto bins = classes_of_bins(model, column);
  const auto all = joined(bins);
  const double by_chance = static_cast<double>((bins.size() - 1) * (all.size() - 1)) / 2.0;
  return (knowledge_by(bins) - knowledge(all) - by_chance) / -knowledge(all);
}

std::vector<std::string> warn_of_bins(const DataTable& data, const LearningOptions& options) {
  constexpr std::size_t many_bins = 64, most_bins = 1000;
  if (std::ranges::none_of(data.columns, &DataColumn::numeric) || options.bins < 3) return {};
  LearningOptions other = options;
  other.equal_width = false;
  other.bins = std::max(options.bins, std::min(std::max(many_bins, 4 * options.bins), most_bins));
  const LearnedModel model = learn(data, options), fine = learn(data, other);
  std::vector<std::string> coarse;  // columns whose bins put together what is different
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    if (!data.columns[i].numeric) continue;
    const auto warn = [&](bool holds, std::string_view format, const auto&... words) {
      if (holds)
        complain(fmt::format("recognition_demo: warning: {}: column {}: {}", data.file, in_quotes(data.columns[i].name),
                             fmt::format(fmt::runtime(format), words...)));
    };
    const auto bins = classes_of_bins(model, i), fine_bins = classes_of_bins(fine, i);
    const double share = fullest(bins);
    warn(options.equal_width && share > 0.95 && fullest(fine_bins) < 0.9,
         "{:.3g} % of the numbers are in one of {} bins of equal width, since few are far from all others: leave out "
         "--equal-width, or those if they are slips or stand for none",
         100.0 * share, bins.size());
    if (fine_bins.size() <= bins.size()) continue;
    const double freedom = static_cast<double>((fine_bins.size() - bins.size()) * (data.classes.size() - 1));
    const double by_bins = knowledge_by(bins), lost = knowledge_by(fine_bins) - by_bins;
    const double chance = freedom / 2.0 + 5.0 * std::sqrt(freedom / 2.0);
    // A class of few rows is lost where one limit would tell more of it than all bins; one of 64 does by chance.
    constexpr double by_chance = 10.0;
    bool loses_one = false;
    for (std::size_t c = 0; c < data.classes.size(); ++c) {
      const auto own = against_others(bins, c);
      const double by_its_bins = knowledge_by(own) - knowledge(joined(own));
      loses_one |= told_by_a_limit(against_others(fine_bins, c)) > 1.1 * by_its_bins + by_chance;
    }
    if (!(lost > chance) && !loses_one) continue;
    const bool are_zeros = !options.equal_width && share > 0.5 && bins.size() < 4;
    warn(are_zeros,
         "{:.3g} % of the numbers are in one bin, as where most are 0, and the others in {} of {}: give more --bins",
         100.0 * share, bins.size() - 1, options.bins);
    if (!are_zeros && (loses_one || lost > 0.3 * (by_bins - knowledge(joined(bins)))))
      coarse.push_back(typed(data.columns[i].name));
  }
  return coarse;
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
