#include <map>

#include "recognition_demo/learned_model.hpp"

namespace sigmax::apps {
namespace {

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

}  // namespace

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
    codes.push_back({.name = names[i],
                     .bins = Discretization{{edges.begin() + 1, edges.end() - 1}},
                     .least = edges.front(),
                     .greatest = edges.back()});
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

}  // namespace sigmax::apps
