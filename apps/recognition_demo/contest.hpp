#pragma once

#include <sigmax/recognition/table_classifier.hpp>

#include "report/result.hpp"

namespace sigmax::apps {

using SigmaClassifier = Classifier<Random, Random>;
using MaxClassifier = Classifier<Fuzzy, Fuzzy>;

/// For every feature the index of what was read, or `missing`.
using Readings = std::vector<std::size_t>;

/// The sum of what a function or a member tells of each of several things, in their order.
template <class Range, class Of = std::identity>
double sum_of(const Range& range, const Of& of = {}) {
  double sum = 0.0;
  for (const auto& one : range) sum += static_cast<double>(std::invoke(of, one));
  return sum;
}

/// One of the classifiers that are compared on the same reports.
struct Contestant {
  std::string name;
  AnyClassifier classifier;
  /// For a sigma classifier of something finer than the pattern: the pattern of each of its outcomes.
  std::optional<Relation<Random, Random>> pattern_given_state = std::nullopt;
  bool has_possibilities = true;  ///< anywhere: of the pattern, of the feature, or of the reading

  bool fuzzy() const { return std::holds_alternative<MaxClassifier>(classifier); }
};

/// What a classifier made of one run.
struct Trace {
  /// After each report: 1 if the truth alone is the most likely pattern, 1/n if it is one of n, else 0.
  std::vector<double> credit;
  /// Probability or possibility of every pattern after the last report.
  std::vector<double> belief;
  /// Reports that would have excluded every pattern; the classifier passed over them.
  std::size_t refused = 0;
};

/// The contestant's classifier, from its prior on, over the reports of one run.
Trace follow(const Contestant& contestant, std::size_t truth, const std::vector<Readings>& reports);

/// Probability or possibility of every pattern after each report.
using Beliefs = std::vector<std::vector<double>>;
Beliefs beliefs_over(const Contestant& contestant, const std::vector<Readings>& reports);

/// Probability or possibility of each pattern.
std::vector<double> numbers_of(const AnyBelief& belief);

/// A column of differences between shares of right decisions, in points.
inline ResultColumn of_points(std::string key, std::string header) {
  return {.key = std::move(key),
          .header = std::move(header),
          .unit = "points",
          .scale = 100.0,
          .sign = true,
          .interval = true};
}

/// A result begun: the page has its title, and the contestants are what it switches on and off.
Result result_of_contest(std::string title, const OutputOptions& output,
                         const std::vector<Contestant>& contestants = {});

template <class Variable>
std::vector<std::string> labels_of(const Variable& variable) {
  return each_below(variable.size(), [&](std::size_t i) { return variable.label(i); });
}

/// A relation as a page shows it, with what text_of(row, column) says beside each number.
template <class Numbers, class TextOf>
HeatMap map_of(const Numbers& relation, const std::string& title, const std::string& value_label,
               const TextOf& text_of) {
  HeatMap map{.title = title,
              .row_label = relation.from().name(),
              .column_label = relation.to().name(),
              .rows = labels_of(relation.from()),
              .columns = labels_of(relation.to()),
              .value_label = value_label};
  map.fill([&](std::size_t row, std::size_t column) {
    return HeatMap::Cell{relation(row, column), text_of(row, column)};
  });
  return map;
}

/// first, first + 1, …: so many numbers.
std::vector<double> counted_from(std::size_t first, std::size_t count);

/// Probability or possibility of each pattern over reports at `x`, a chart for each pattern, from the beliefs of each
/// contestant.
std::vector<Panel> support_charts(const std::vector<std::string>& patterns, const std::vector<Contestant>& contestants,
                                  const std::vector<Beliefs>& beliefs, const std::vector<double>& x,
                                  const std::string& x_label, std::optional<std::size_t> truth = std::nullopt);

/// What was learned of features: p(value|class), and the possibility that it is turned into. Of many values none are
/// shown; the most telling features come first, and no more than `most`.
std::vector<Panel> relation_maps(const std::vector<Relation<Random, Random>>& learned, std::size_t most);

}  // namespace sigmax::apps
