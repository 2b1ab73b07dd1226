#pragma once

#include <sigmax/recognition/table_model.hpp>

#include "shell/text.hpp"
#include "table/csv.hpp"

namespace sigmax::apps {

struct TableReading {
  std::string label;                       ///< the column with the class
  std::vector<std::string> categorical;    ///< columns to take as words although they hold numbers, or "all"
  std::vector<std::string> ignore;         ///< columns to leave out
  std::vector<std::string> missing;        ///< words that stand for nothing, beside the usual ones
  std::vector<std::string> missing_value;  ///< columns whose missing cells are a value of their own
  std::string groups;                      ///< a column that names what rows are of, and is no feature; or empty
};

/// Labelled rows, in memory: the classes, sorted, and of each row its class and its features.
struct LabelledTable {
  std::string file, label;
  std::vector<std::string> classes{};
  std::vector<std::size_t> rows_of_class{};
  std::vector<std::size_t> labels{};   ///< of each row, an index into the classes
  std::vector<std::uint32_t> lines{};  ///< of the file, on which each row starts
  std::vector<std::size_t> groups{};   ///< of each row, 0, 1, …; empty where no column names them
  std::vector<TableColumn> columns{};
  std::vector<std::string> notes{};  ///< what was left out, and why

  std::size_t size() const { return labels.size(); }
};

/// Which cells hold nothing.
class MissingWords {
 public:
  explicit MissingWords(const std::vector<std::string>& more = {});

  /// An empty cell, "?", and the words that were added, numbers also as others write them.
  bool operator()(std::string_view cell) const;

  /// Besides, in a column of numbers: "-", "NA", "N/A", "nan", "null", "none", "inf" and the like, in any case.
  bool among_numbers(std::string_view cell) const;

 private:
  std::vector<std::pair<std::string, std::optional<double>>> more_;  // and the number that a word is
};

/// Whether a word says that a value is not known, as NA does.
bool means_unknown(std::string_view word);

/// Whether it would be a number if its comma were a point.
bool has_decimal_comma(std::string_view word);

/// Reads a headed CSV file. A column is numeric if all its cells are numbers, else categorical. A cell without a value
/// is missing. A column with the same value everywhere is left out. Throws InputError with file, line, column and value
/// for a row without a class, a column that is nearly all numbers, and data of a single class or without a feature.
LabelledTable read_table(const std::string& file, const TableReading& options, bool quiet);

}  // namespace sigmax::apps
