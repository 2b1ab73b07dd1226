#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <sigmax/recognition/classifier.hpp>
#include <sigmax/recognition/explanation.hpp>
#include <sigmax/recognition/table_model.hpp>

namespace sigmax {

/// A cell of a row to classify: a number or a word; NaN or the empty word if it is missing.
using TableCell = std::variant<double, std::string>;

/// A classifier, or a belief, of either kind.
using AnyClassifier = std::variant<Classifier<Random, Random>, Classifier<Fuzzy, Fuzzy>>;
using AnyBelief = std::variant<Belief<Random>, Belief<Fuzzy>>;

/// Probability or possibility of each pattern.
std::vector<double> degrees_of(const AnyBelief& belief);

/// By which of the inferences a table classifies; possibilities are made of the counts by a transform. Sigma-max
/// inference is max inference but where readings may be wrong.
enum class TableInference { sigma, max_by_ratio, max_by_dubois_prade, sigma_max_by_ratio, sigma_max_by_dubois_prade };

/// "sigma", "max, ratio scale", "max, Dubois-Prade", "sigma-max, ratio scale", "sigma-max, Dubois-Prade".
std::string_view name_of(TableInference inference);

/// What a row is taken for: the most likely class, of those that tie the first.
struct TablePrediction : Decision {
  std::string label;
  AnyBelief belief;       ///< the prior if the row excludes every class
  bool excluded = false;  ///< whether it does
};

/// Learns a table of numbers and words, and classifies rows: fit, predict, explain.
///
///     const std::vector<TableColumn> columns{{"height", {12, 31, 9}}, {"leaf", {"broad", "needle", "broad"}}};
///     const TableClassifier trees = TableClassifier::fit(columns, {"tree", {"oak", "pine", "oak"}});
///     trees.predict({30.0, "needle"}).label;                       // "pine"
///     trees.explain({30.0, "needle"}).contributions[1].equation;   // "p(leaf = needle|tree = pine) = …"
///
/// Numbers become bins, words values, missing cells are skipped. A word that no row had is missing, too.
class TableClassifier {
 public:
  /// Learns the columns; rows whose label is missing teach nothing. Throws std::invalid_argument if the label has no
  /// words, or a column has not as many rows.
  static TableClassifier fit(const std::vector<TableColumn>& columns, const TableColumn& label,
                             const TableOptions& options = {}, TableInference inference = TableInference::sigma);

  /// Classifies by what was learned. Throws std::invalid_argument if there is neither a row nor smoothing for a class.
  explicit TableClassifier(TableModel model, TableInference inference = TableInference::sigma);

  /// The same by another inference; they share the model.
  TableClassifier by(TableInference inference) const { return {model_, inference}; }

  /// What a row is taken for. Throws std::invalid_argument if it has not a cell for each feature, or a word among
  /// numbers, or a number among words.
  TablePrediction predict(const std::vector<TableCell>& row) const { return predict(readings(row)); }
  TablePrediction predict(std::span<const std::size_t> readings) const;

  /// Why it is the class rather than the next one. Throws as `predict` does.
  PatternExplanation explain(const std::vector<TableCell>& row) const { return explain(readings(row)); }
  PatternExplanation explain(std::span<const std::size_t> readings) const;

  /// The reading of each feature of a row, or of a row of columns with the words of the model.
  std::vector<std::size_t> readings(const std::vector<TableCell>& row) const;
  std::vector<std::size_t> readings(std::span<const TableColumn> columns, std::size_t row) const;

  const TableModel& model() const { return *model_; }
  const AnyClassifier& classifier() const { return classifier_; }
  std::string_view name() const { return name_of(inference_); }

 private:
  TableClassifier(std::shared_ptr<const TableModel> model, TableInference inference);
  std::size_t reading(std::size_t feature, double cell) const;

  std::shared_ptr<const TableModel> model_;
  TableInference inference_;
  AnyClassifier classifier_;
};

}  // namespace sigmax
