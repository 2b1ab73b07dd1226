#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "support/csv.hpp"

namespace sigmax::apps {

/// An index into the values of a column, in two bytes: tables are long.
using Code = std::uint16_t;
inline constexpr Code missing_code = 0xFFFF;

/// One feature of labelled data.
struct DataColumn {
  std::string name;
  bool numeric = false;
  std::vector<std::string> values;  ///< of a categorical column, sorted
  std::vector<Code> codes;          ///< of a categorical column: for each row an index into `values`, or `missing_code`
  std::vector<double> numbers;      ///< of a numeric column: for each row the number, NaN where it is missing
};

/// Labelled data in memory, two bytes a word and eight a number: the classes sorted, and of each row its class and its
/// features.
struct DataTable {
  std::string file;
  std::string label;
  std::vector<std::string> classes;
  std::vector<Code> labels;
  std::vector<std::uint32_t> lines;  ///< of the file
  std::vector<DataColumn> columns;
  std::vector<std::string> warnings;  ///< what the reader of the results should know
};

struct DataOptions {
  std::string label;                     ///< the column with the class
  std::vector<std::string> categorical;  ///< columns to take as words although they hold numbers, or "all"
  std::vector<std::string> ignore;       ///< columns to leave out
  std::vector<std::string> missing;      ///< words that stand for nothing, beside the usual ones
};

/// Which cells hold nothing.
class MissingWords {
 public:
  explicit MissingWords(std::vector<std::string> more = {});

  /// An empty cell, "?", and the words that were added.
  bool operator()(std::string_view cell) const;

  /// Besides, in a column of numbers: "-", "NA", "N/A", "nan", "null", "none", "inf" and the like, in any case.
  bool among_numbers(std::string_view cell) const;

 private:
  std::vector<std::string> more_;
};

/// Opens a file, or the standard input for "-".
CsvReader open_csv(const std::string& file);

/// Reads a headed CSV file. A column is numeric if all its cells are numbers, else categorical. A cell without a value
/// is missing. Throws InputError with file, line, column and value for a row without a class, a column that is nearly
/// all numbers, columns that have the same value everywhere or none at all, and data of a single class.
DataTable read_data(const std::string& file, const DataOptions& options, bool quiet);

}  // namespace sigmax::apps
