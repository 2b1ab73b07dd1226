#include "arrays.hpp"
#include "kinds.hpp"
#include "rooms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <variant>
#include <vector>

#include <pybind11/stl.h>

#include <sigmax/core/tie.hpp>
#include <sigmax/recognition/discretization.hpp>
#include <sigmax/recognition/table_classifier.hpp>

namespace sigmax::python {
namespace {

/// How a column of numbers becomes readings: name, cuts of its bins, and the label of each bin if it is a word.
using Features = std::vector<std::tuple<std::string, std::vector<double>, std::vector<std::string>>>;

/// The reading of a number; that of NaN is one more than there are bins.
std::size_t reading(const std::vector<double>& cuts, double cell) {
  if (std::isnan(cell)) return cuts.size() + 1;
  if (cuts.size() > 16)
    return static_cast<std::size_t>(std::upper_bound(cuts.begin(), cuts.end(), cell) - cuts.begin());
  std::size_t bin = 0;  // without a branch that is hard to predict
  for (const double cut : cuts) bin += cell >= cut ? 1 : 0;
  return bin;
}

/// How many numbers a class has in `count_rows`.
std::size_t columns_of(const Features& features) {
  std::size_t columns = 1;
  for (const auto& feature : features) columns += std::get<1>(feature).size() + 2;
  return columns;
}

/// How often: for each class (a row) that of its rows, then for each feature that of its readings, the missing last.
Array count_rows(std::size_t classes, const Features& features, const Array& labels, const Array& rows,
                 const Array& weights) {
  expect_shape(rows, "rows", labels.size(), features.size());
  expect_shape(weights, "weights", labels.size());
  Table counts(classes, columns_of(features), 0.0);
  const double* cell = rows.data();
  for (py::ssize_t row = 0; row < labels.size(); ++row) {
    const double label = labels.data()[row], weight = weights.data()[row];
    if (!(label >= 0.0 && label < static_cast<double>(classes) && weight >= 0.0 && std::isfinite(weight)))
      throw std::invalid_argument("row " + std::to_string(row) + ": class " + std::to_string(label) + ", weight " +
                                  std::to_string(weight));
    double* to = counts.row(static_cast<std::size_t>(label)).data();
    *to++ += weight;
    for (const auto& [name, cuts, words] : features) {
      to[reading(cuts, *cell++)] += weight;
      to += cuts.size() + 2;
    }
  }
  return Array({counts.rows(), counts.columns()}, counts.data());
}

Counts counts_of(const RandomVariable& pattern, const Features& features, const Array& counted) {
  expect_shape(counted, "counts", pattern.size(), columns_of(features));
  std::vector<RandomVariable> variables;
  for (const auto& [name, cuts, words] : features) {
    if (!words.empty() && words.size() != cuts.size() + 1)
      throw std::invalid_argument("feature '" + name + "': " + std::to_string(words.size()) + " words for " +
                                  std::to_string(cuts.size() + 1) + " bins");
    variables.emplace_back(name, words.empty() ? Discretization(cuts).labels() : words);
  }
  Counts counts(pattern, variables);
  const double* from = counted.data();
  for (std::size_t c = 0; c < pattern.size(); ++c) {
    counts.observe(c, std::vector<std::size_t>(features.size(), missing), *from++);
    for (std::size_t i = 0; i < features.size(); ++i, ++from)
      for (std::size_t f = 0; f < variables[i].size(); ++f) counts.observe_value(c, i, f, *from++);
  }
  return counts;
}

using AnyKinds = std::variant<Classifier<Random, Random>, Classifier<Random, Fuzzy>, Classifier<Fuzzy, Random>,
                              Classifier<Fuzzy, Fuzzy>>;

using Transform = std::variant<RatioScale, DuboisPrade>;

template <Uncertainty Pattern, Uncertainty Feature>
AnyKinds learned(const Counts& counts, const Transform& transform, double smoothing, bool equal_prior) {
  const auto as = [&]<class Kind>(Kind /*kind*/, const auto& random) {
    if constexpr (std::same_as<Kind, Random>)
      return random;
    else
      return std::visit([&](const auto& method) { return to_possibility(random, method); }, transform);
  };
  std::vector<Relation<Feature, Pattern>> relations;
  for (const auto& frequencies : learned_relations(counts, smoothing)) {
    if constexpr (std::same_as<Pattern, Random>)
      relations.push_back(as(Feature{}, frequencies));
    else
      relations.push_back(with_fuzzy_condition(as(Feature{}, frequencies)));
  }
  const auto shares = equal_prior ? uninformative(counts.pattern()) : pattern_prior(counts);
  return Classifier<Pattern, Feature>{as(Pattern{}, shares), relations};
}

/// Classifies rows of numbers by what was counted. It never changes, so threads may share it.
struct RowClassifier {
  RowClassifier(const RandomVariable& pattern, Features of, const Array& counted, bool fuzzy_pattern,
                bool fuzzy_features, const Transform& transform, double smoothing, bool equal_prior)
      : features(std::move(of)), classifier([&] {
          const auto make = fuzzy_pattern ? (fuzzy_features ? &learned<Fuzzy, Fuzzy> : &learned<Fuzzy, Random>)
                                          : (fuzzy_features ? &learned<Random, Fuzzy> : &learned<Random, Random>);
          return make(counts_of(pattern, features, counted), transform, smoothing, equal_prior);
        }()) {
    const auto take = [this](const auto& of_kinds) {
      for (std::size_t c = 0; c < of_kinds.prior().size(); ++c) prior.push_back(std::log(of_kinds.prior()[c]));
      for (const auto& feature : of_kinds.features()) {
        Table& table = logs.emplace_back(feature.readings().size() + 1, prior.size(), 0.0);  // the last: missing
        for (std::size_t f = 0; f < feature.readings().size(); ++f)
          std::ranges::copy(feature.log_likelihoods(f), table.row(f).begin());
      }
    };
    std::visit(take, classifier);
  }

  Features features;
  AnyKinds classifier;
  std::vector<double> prior{};
  std::vector<Table> logs{};
};

/// Logarithms of belief less the greatest; of a row that excludes all, those of the prior.
Array log_degrees(const RowClassifier& self, const Array& rows) {
  expect_shape(rows, "rows", -1, self.features.size());
  Array result({rows.shape(0), static_cast<py::ssize_t>(self.prior.size())});
  const double* cell = rows.data();
  const std::span<double> all(result.mutable_data(), static_cast<std::size_t>(result.size()));
  const py::gil_scoped_release release;
  for (std::size_t first = 0; first < all.size(); first += self.prior.size()) {
    const std::span<double> row = all.subspan(first, self.prior.size());
    std::ranges::copy(self.prior, row.begin());
    for (std::size_t i = 0; i < self.features.size(); ++i) {
      const auto column = self.logs[i].row(reading(std::get<1>(self.features[i]), *cell++));
      for (std::size_t c = 0; c < row.size(); ++c) row[c] += column[c];
    }
    if (*std::ranges::max_element(row) == log_zero) std::ranges::copy(self.prior, row.begin());
    const double greatest = *std::ranges::max_element(row);
    for (double& log : row) log = ties(log, greatest) ? 0.0 : log - greatest;
  }
  return result;
}

py::tuple explain_row(const RowClassifier& self, const Array& row, std::size_t pattern, std::size_t rival) {
  expect_shape(row, "row", self.features.size());
  std::vector<std::size_t> readings;
  for (const auto& [name, cuts, words] : self.features) {
    const std::size_t found = reading(cuts, row.data()[readings.size()]);
    readings.push_back(found > cuts.size() ? missing : found);
  }
  const auto explained = [&](const auto& by) { return explain(by, by.report(InOrder{readings}), pattern, rival); };
  const PatternExplanation why = std::visit(explained, self.classifier);
  py::list rows;
  for (const Contribution& each : why.contributions)
    rows.append(py::make_tuple(std::get<0>(self.features[each.feature]), each.reading, each.log_ratio, each.equation));
  return py::make_tuple(why.log_prior_ratio, rows);
}

/// As `equal_frequency`; few different values are found without sorting all.
py::array cuts_of(const Array& values, std::size_t bins) {
  std::vector<double> different;
  for (const double value : row_of(values)) {
    const auto place = std::lower_bound(different.begin(), different.end(), value);
    if (std::isnan(value) || (place != different.end() && *place == value)) continue;
    if (different.size() == bins || std::isinf(value)) return array_of(equal_frequency(row_of(values), bins).cuts());
    different.insert(place, value);
  }
  if (!different.empty()) different.erase(different.begin());
  return array_of(different);
}

}  // namespace

void bind_recognition(py::module_& module) {
  py::class_<RowClassifier> type(module, "TableClassifier",
                                 "Classifies rows of numbers by counts, (17)–(20), (41)–(46).\n\n"
                                 "A feature is (name, cuts of its bins, words for the bins or none); NaN is missing.");
  type.def(py::init<const RandomVariable&, Features, const Array&, bool, bool, const Transform&, double, bool>());
  method(type, "log_degrees",
         "Logarithms (N, classes) of belief in each class over the greatest: possibilities, (34), (44).", &log_degrees);
  method(type, "explain",
         "What of a row (n,) speaks for a class against a rival: (log prior ratio, [(feature, reading, log ratio, "
         "equation)]).",
         &explain_row);
  function(module, "count_rows(classes, features, labels, rows, weights, /)",
           "Weighted counts of rows (N, n) with labels (N,): a row per class, as TableClassifier takes them.",
           &count_rows);
  function(module, "equal_frequency(values, bins, /)",
           "Cuts of at most so many bins with equal numbers of values (N,), ties apart; NaN are skipped.", &cuts_of);
}

}  // namespace sigmax::python
