#include <sigmax/recognition/table_model.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace sigmax {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The value of a word that is a finite number, else infinity.
double value_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = error == std::errc{} && end == word.data() + word.size();
  return whole && std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

std::pair<Vocabulary, std::vector<double>> numbered(const std::vector<std::string>& words) {
  Vocabulary vocabulary;
  std::vector<double> numbers;
  for (const std::string& word : words)
    numbers.push_back(word.empty() ? nan : static_cast<double>(vocabulary.number(word)));
  return {std::move(vocabulary), std::move(numbers)};
}

/// A column with its bins, if it is numeric, of some rows.
TableFeature fitted(const TableColumn& column, const TableOptions& options, const auto& chosen) {
  TableFeature feature{.name = column.name, .words = column.words, .missing_is_value = column.missing_is_value};
  if (!column.numeric()) return feature;
  std::vector<double> numbers;
  for (std::size_t row = 0; row < column.cells.size(); ++row)
    if (chosen(row) && !std::isnan(column.cells[row])) numbers.push_back(column.cells[row]);
  const auto [least, greatest] = std::minmax_element(numbers.begin(), numbers.end());
  if (numbers.empty() || *least == *greatest)
    feature.bins = Discretization{{}};
  else
    feature.bins = options.equal_width ? equal_width(numbers, options.bins) : equal_frequency(numbers, options.bins);
  return feature;
}

std::vector<RandomVariable> variables_of(const std::vector<TableFeature>& features) {
  std::vector<RandomVariable> variables;
  for (const TableFeature& feature : features) variables.emplace_back(feature.name, feature.labels());
  return variables;
}

}  // namespace

std::size_t Vocabulary::number(std::string_view word) {
  const auto found = numbers_.find(word);
  return found != numbers_.end() ? found->second : numbers_.emplace(std::string(word), numbers_.size()).first->second;
}

std::pair<std::vector<std::string>, std::vector<std::size_t>> Vocabulary::sorted() const {
  std::vector<std::tuple<double, std::string, std::size_t>> order;  // by value, words behind all numbers
  for (const auto& [word, number] : numbers_) order.emplace_back(value_of(word), word, number);
  std::sort(order.begin(), order.end());
  std::vector<std::string> words;
  std::vector<std::size_t> places(order.size());
  for (const auto& [value, word, number] : order) {
    places[number] = words.size();
    words.push_back(word);
  }
  return {std::move(words), std::move(places)};
}

TableColumn::TableColumn(std::string its_name, std::vector<double> numbers)
    : name(std::move(its_name)), cells(std::move(numbers)) {}

TableColumn::TableColumn(std::string its_name, const std::vector<std::string>& its_words) : name(std::move(its_name)) {
  auto [vocabulary, numbers] = numbered(its_words);
  *this = TableColumn(std::move(name), vocabulary, std::move(numbers));
}

TableColumn::TableColumn(std::string its_name, const Vocabulary& vocabulary, std::vector<double> numbers)
    : name(std::move(its_name)), cells(std::move(numbers)) {
  std::vector<std::size_t> places;
  std::tie(words, places) = vocabulary.sorted();
  for (double& cell : cells)
    if (!std::isnan(cell)) cell = static_cast<double>(places.at(static_cast<std::size_t>(cell)));
}

std::vector<std::string> TableFeature::labels() const {
  std::vector<std::string> all = bins ? bins->labels() : words;
  if (missing_is_value) all.emplace_back("missing");
  return all;
}

std::size_t TableFeature::reading(double cell) const {
  if (std::isnan(cell)) return missing_is_value ? size() - 1 : missing;
  return bins ? bins->bin(cell) : static_cast<std::size_t>(cell);
}

std::optional<std::size_t> TableFeature::find(std::string_view word) const {
  const auto found = std::find(words.begin(), words.end(), word);
  return found == words.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - words.begin()));
}

TableModel::TableModel(RandomVariable pattern, std::vector<TableFeature> its_features, const TableOptions& its_options)
    : features(std::move(its_features)), counts(std::move(pattern), variables_of(features)), options(its_options) {}

TableModel TableModel::fit(std::span<const TableColumn> columns, const RandomVariable& pattern,
                           std::span<const std::size_t> classes, const TableOptions& options,
                           const std::function<bool(std::size_t row)>& chosen) {
  std::vector<TableFeature> features;
  for (const TableColumn& column : columns) {
    if (column.cells.size() != classes.size())
      throw std::invalid_argument("column '" + column.name + "' has " + std::to_string(column.cells.size()) +
                                  " rows, but there are " + std::to_string(classes.size()) + " labels");
    features.push_back(fitted(column, options, chosen));
  }
  TableModel model{pattern, std::move(features), options};
  std::vector<std::size_t> readings(columns.size());
  for (std::size_t row = 0; row < classes.size(); ++row) {
    if (!chosen(row)) continue;
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = model.features[i].reading(columns[i].cells[row]);
    model.counts.observe(classes[row], readings);
  }
  return model;
}

}  // namespace sigmax
