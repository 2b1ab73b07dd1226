#pragma once

#include <cmath>

#include "shell/numbers.hpp"
#include "table/csv.hpp"

namespace sigmax::apps {

/// An index into the values of a column, in two bytes: tables are long.
using Code = std::uint16_t;
inline constexpr Code missing_code = 0xFFFF;

/// One feature of labelled data, with a cell a row.
struct DataColumn {
  std::string name;
  bool missing_is_value = false;  ///< whether a missing cell is a value of its own, else it says nothing
  bool numeric = false;
  std::vector<std::string> values{};  ///< of a categorical column, sorted
  std::vector<double> numbers{};      ///< of a numeric column, NaN where one is missing
  std::vector<Code> codes{};          ///< of a categorical one, indices into its values

  /// The number in a numeric column, an index into the values of a categorical one; NaN where it is missing.
  double value(std::size_t row) const {
    if (numeric) return numbers[row];
    return codes[row] == missing_code ? nan : static_cast<double>(codes[row]);
  }
};

struct DataOptions {
  std::string label;                       ///< the column with the class
  std::vector<std::string> categorical;    ///< columns to take as words although they hold numbers, or "all"
  std::vector<std::string> ignore;         ///< columns to leave out
  std::vector<std::string> missing;        ///< words that stand for nothing, beside the usual ones
  std::vector<std::string> missing_value;  ///< columns whose missing cells are a value of their own
};

/// Labelled data, in memory: the classes, sorted, and of each row its class and its features.
struct DataTable {
  std::string file, label;
  std::vector<std::string> classes{};
  std::vector<std::size_t> rows_of_class{};
  std::vector<std::size_t> labels{};   ///< of each row, an index into the classes
  std::vector<std::uint32_t> lines{};  ///< of the file, on which each row starts
  std::vector<DataColumn> columns{};
  std::vector<std::string> notes{};  ///< what was left out, and why

  std::size_t size() const { return labels.size(); }
};

/// Which cells hold nothing.
class MissingWords {
 public:
  explicit MissingWords(const std::vector<std::string>& more = {});

  /// An empty cell, "?", and the words that were added, numbers also as others write them.
  bool operator()(std::string_view cell);

  /// Besides, in a column of numbers: "-", "NA", "N/A", "nan", "null", "none", "inf" and the like, in any case.
  bool among_numbers(std::string_view cell);

  /// The words that were added, if no cell was one of them.
  std::vector<std::string> unmet() const;

 private:
  struct Word {
    std::string text;
    std::optional<double> number;
    bool met = false;
  };
  std::vector<Word> more_;
};

/// Whether a word says that a value is not known, as NA does.
bool says_unknown(std::string_view word);

/// Whether it would be a number if its comma were a point.
bool has_decimal_comma(std::string_view word);

/// Reads a headed CSV file. A column is numeric if all its cells are numbers, else categorical. A cell without a value
/// is missing. A column with the same value everywhere is left out. Throws InputError with file, line, column and value
/// for a row without a class, a column that is nearly all numbers, and data of a single class or without a feature.
DataTable read_data(const std::string& file, const DataOptions& options, bool quiet);

}  // namespace sigmax::apps
