#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/recognition/counts.hpp>
#include <sigmax/recognition/discretization.hpp>

namespace sigmax {

/// Words, numbered as they come.
class Vocabulary {
 public:
  /// The number of a word, which is the next one if it is new.
  std::size_t number(std::string_view word);
  std::size_t size() const { return numbers_.size(); }

  /// The words in order, numbers first and by their value, and for each number the place of its word.
  std::pair<std::vector<std::string>, std::vector<std::size_t>> sorted() const;

 private:
  std::map<std::string, std::size_t, std::less<>> numbers_;
};

/// A column of a table, with a cell a row: a number, or the place of a word among the words; NaN where it is missing.
struct TableColumn {
  TableColumn(std::string its_name, std::vector<double> numbers);
  /// An empty word is missing.
  TableColumn(std::string its_name, const std::vector<std::string>& its_words);
  template <std::convertible_to<std::string> Word>
  TableColumn(std::string its_name, std::initializer_list<Word> its_words)
      : TableColumn(std::move(its_name), std::vector<std::string>(its_words.begin(), its_words.end())) {}
  /// Of words that were numbered; these are the numbers, NaN where one is missing.
  TableColumn(std::string its_name, const Vocabulary& vocabulary, std::vector<double> numbers);

  bool numeric() const { return words.empty(); }

  std::string name;
  std::vector<double> cells;
  std::vector<std::string> words{};  ///< none in a column of numbers
  bool missing_is_value = false;     ///< whether a missing cell is a value of its own, else it says nothing
};

/// How a column becomes readings of a feature: an index into its words, or into bins of its numbers.
struct TableFeature {
  std::string name;
  std::vector<std::string> words{};
  std::optional<Discretization> bins{};  ///< of numbers
  bool missing_is_value = false;         ///< the last value, "missing"

  std::size_t size() const { return (bins ? bins->size() : words.size()) + (missing_is_value ? 1 : 0); }
  std::vector<std::string> labels() const;

  /// Returns the reading of a number, or of the index of a word; NaN is a missing cell.
  std::size_t reading(double cell) const;

  /// Where a word is among the words, or nothing.
  std::optional<std::size_t> find(std::string_view word) const;
};

/// What turns a table into relations, the same for every inference.
struct TableOptions {
  std::size_t bins = 8;      ///< of a column of numbers
  bool equal_width = false;  ///< bins of equal width, else of equal frequency
  double smoothing = 1.0;    ///< added to every count: 1 is Laplace's rule
  double misread = 0.0;      ///< probability that a reading is another than the feature's value, spread evenly
  bool equal_prior = false;  ///< nothing is known of the class, else its share of the rows
};

/// What was learned of a table, as plain data: how rows are read, and the counts.
struct TableModel {
  /// One that has counted nothing. Throws std::invalid_argument without a feature.
  TableModel(RandomVariable pattern, std::vector<TableFeature> its_features, const TableOptions& its_options);

  /// Bins and counts of some rows, or of all; `classes` are the rows' places among the outcomes of the pattern. Throws
  /// std::invalid_argument if a column has not as many rows, and as `Counts` does.
  static TableModel fit(
      std::span<const TableColumn> columns, const RandomVariable& pattern, std::span<const std::size_t> classes,
      const TableOptions& options = {},
      const std::function<bool(std::size_t row)>& chosen = [](std::size_t) { return true; });

  std::vector<TableFeature> features;
  Counts counts;
  TableOptions options;
};

}  // namespace sigmax
