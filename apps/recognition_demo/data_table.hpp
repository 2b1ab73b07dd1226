#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "support/csv.hpp"

namespace sigmax::apps {

/// One feature of labelled data.
struct DataColumn {
  std::string name;
  bool numeric = false;
  std::vector<std::string> values;  ///< of a categorical column, sorted
  std::vector<std::size_t> codes;   ///< of a categorical column: for each row an index into `values`, or `missing`
  std::vector<double> numbers;      ///< of a numeric column: for each row the number, NaN where it is missing
};

/// Labelled data in memory: the classes sorted, and of each row its class and its features.
struct DataTable {
  std::string file;
  std::string label;
  std::vector<std::string> classes;
  std::vector<std::size_t> labels;
  std::vector<std::size_t> lines;  ///< of the file
  std::vector<DataColumn> columns;
};

struct DataOptions {
  std::string label;                     ///< the column with the class
  std::vector<std::string> categorical;  ///< columns to take as words although they hold numbers, or "all"
  std::vector<std::string> ignore;       ///< columns to leave out
  bool quiet = false;                    ///< no progress bar
};

/// Whether a cell holds nothing: it is empty or "?".
bool is_missing(std::string_view cell);

/// Reads a headed CSV file. A column is numeric if all its cells are numbers, else categorical; see `is_missing` for
/// cells without a value. Throws InputError with file, line, column and value for a row without a class, a column that
/// has the same value everywhere or none at all, and data of a single class.
DataTable read_data(const std::filesystem::path& path, const DataOptions& options);

}  // namespace sigmax::apps
