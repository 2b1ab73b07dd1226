#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <sigmax/core/relation.hpp>
#include <sigmax/core/transform.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/recognition/report.hpp>

namespace sigmax {

/// How often each value of each feature was seen with each pattern: what relations are learned from.
///
///     Counts counts{animal, {legs, milk}};
///     for (const auto& row : rows) counts.observe(row.animal, row.features);   // `missing` features are skipped
///     Classifier classifier{pattern_prior(counts), learned_relations(counts, 1.0)};
///
/// Rows are not kept: the memory is that of the tables, however many rows there are.
class Counts {
 public:
  /// Throws std::invalid_argument if there is no feature.
  Counts(RandomVariable pattern, std::vector<RandomVariable> features);

  /// Counts one labelled row, an index for each feature in order or `missing`, as often as `times` says. Throws
  /// std::invalid_argument, naming the variable and the index, if a label or a value does not exist or their number is
  /// wrong, or `times` is negative or not finite; nothing is then counted.
  void observe(std::size_t pattern, std::span<const std::size_t> row, double times = 1.0);

  /// Counts one value of one feature only, for data that are counts already. Throws as above.
  void observe_value(std::size_t pattern, std::size_t feature, std::size_t value, double times = 1.0);

  const RandomVariable& pattern() const& { return pattern_; }
  RandomVariable pattern() const&& { return pattern_; }
  const std::vector<RandomVariable>& features() const& { return features_; }
  std::vector<RandomVariable> features() const&& { return features_; }

  /// How many rows there were of a pattern.
  double rows(std::size_t pattern) const { return rows_[pattern]; }

  /// How often each value of a feature was seen with a pattern.
  /// The view lives as long as the counts; of a temporary it is a copy.
  std::span<const double> of(std::size_t feature, std::size_t pattern) const& { return tables_[feature].row(pattern); }
  std::vector<double> of(std::size_t feature, std::size_t pattern) const&& {
    const auto row = of(feature, pattern);
    return {row.begin(), row.end()};
  }

 private:
  RandomVariable pattern_;
  std::vector<RandomVariable> features_;
  std::vector<double> rows_;
  std::vector<Table> tables_;  // for each feature, a row per pattern
};

/// p(c) = (n(c) + α) / (n + α · number of patterns): α = 0 is the share of the rows, the default.
///
/// Throws std::invalid_argument if α is negative or not finite, or if there is neither a row nor an α.
Distribution<Random> pattern_prior(const Counts& counts, double alpha = 0.0);

/// p(f|c) = (n(f, c) + α) / (n(c) + α · number of values), the mean under a symmetric Dirichlet prior; n(c) counts the
/// rows of c that have the feature. α = 1 is Laplace's rule, α = 0 the relative frequency.
///
/// Throws std::invalid_argument, naming the feature and the pattern, if there is neither a row nor an α, and if α is
/// negative or not finite.
Relation<Random, Random> learned_relation(const Counts& counts, std::size_t feature, double alpha);

/// The same for every feature in order: with `pattern_prior`, categorical naive Bayes.
std::vector<Relation<Random, Random>> learned_relations(const Counts& counts, double alpha);

/// π(f|c) for every feature, each row of p(f|c) turned by a method of transform.hpp.
///
///     learned_relations(counts, 1.0, DuboisPrade{})
///
/// `RatioScale{}` divides each count by the greatest of its row: relative frequency to the maximum.
template <PossibilityTransform Method>
std::vector<Relation<Fuzzy, Fuzzy>> learned_relations(const Counts& counts, double alpha, const Method& method) {
  std::vector<Relation<Fuzzy, Fuzzy>> result;
  for (std::size_t i = 0; i < counts.features().size(); ++i)
    result.push_back(with_fuzzy_condition(to_possibility(learned_relation(counts, i, alpha), method)));
  return result;
}

}  // namespace sigmax
