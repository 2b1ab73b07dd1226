#pragma once

#include "support/csv.hpp"
#include "support/numbers.hpp"
#include "support/scratch.hpp"

namespace sigmax::apps {

/// An index into the values of a column, in two bytes: tables are long.
using Code = std::uint16_t;
inline constexpr Code missing_code = 0xFFFF;

/// One feature of labelled data.
struct DataColumn {
  std::string name;
  bool numeric = false;
  std::vector<std::string> values{};  ///< of a categorical column, sorted
};

struct DataOptions {
  std::string label;                     ///< the column with the class
  std::vector<std::string> categorical;  ///< columns to take as words although they hold numbers, or "all"
  std::vector<std::string> ignore;       ///< columns to leave out
  std::vector<std::string> missing;      ///< words that stand for nothing, beside the usual ones
  bool grouped = false;                  ///< whether what belongs together is kept so by --groups
};

class DataTable;

/// One row of the data, while it is seen.
struct DataRow {
  const DataTable& table;
  std::size_t index;
  const double* cells;  ///< as the table keeps them

  /// An index into the classes.
  std::size_t label() const;

  /// The line of the file on which the row starts.
  std::size_t line() const { return static_cast<std::size_t>(cells[1]); }

  /// The number in a numeric column, an index into the values of a categorical one; NaN where it is missing.
  double value(std::size_t column) const;
};

/// Labelled data: the classes, sorted, and of each row its class and its features. The rows are in a ScratchArray:
/// memory does not grow with their number.
class DataTable {
 public:
  std::string file, label;
  std::vector<std::string> classes;
  std::vector<std::size_t> rows_of_class;
  std::vector<DataColumn> columns;
  std::vector<std::string> warnings;  ///< what the reader of the results should know
  bool has_copies = false;            ///< whether a tenth of the rows, or half of those of a class, seem to be copies

  /// Adds what a reader of the results should know of the file, if it holds.
  void warn(bool holds, std::string_view format, const auto&... words) {
    if (holds) warnings.push_back(file + ": " + fmt::format(fmt::runtime(format), words...));
  }

  /// The same of a column.
  void warn_of(const std::string& column, bool holds, const std::string& format, const auto&... words) {
    warn(holds, "column {}" + format, in_quotes(column), words...);
  }

  /// The number of rows.
  std::size_t size() const { return cells_.size() / row_size(); }

  /// Calls see(row) for all rows in the order of the file. Several threads may do so at a time.
  template <class See>
  void for_each(const See& see) const {
    const std::size_t most = std::max<std::size_t>(1, block_size / row_size());
    std::vector<double> block;
    for (std::size_t first = 0; first < size(); first += most) {
      const std::size_t count = std::min(most, size() - first);
      block.resize(count * row_size());
      cells_.read(first * row_size(), block);
      for (std::size_t i = 0; i < count; ++i) see(DataRow{*this, first + i, block.data() + i * row_size()});
    }
  }

 private:
  friend struct DataRow;
  friend DataTable read_data(const std::string& file, const DataOptions& options, bool quiet);

  static constexpr std::size_t block_size = std::size_t{1} << 13;

  // A row is the class, the line, and of each column the number and the word: which columns are numeric is known at the
  // end of the file only.
  std::size_t row_size() const { return 2 + 2 * columns.size(); }

  ScratchArray<double> cells_;
  std::vector<Code> class_order_;               // the place, when sorted, of each class as they came
  std::vector<std::vector<Code>> value_order_;  // the same of the values of each categorical column
};

inline std::size_t DataRow::label() const { return table.class_order_[static_cast<std::size_t>(cells[0])]; }
inline double DataRow::value(std::size_t column) const {
  if (table.columns[column].numeric) return cells[2 + 2 * column];
  const auto code = static_cast<Code>(cells[3 + 2 * column]);
  return code == missing_code ? nan : table.value_order_[column][code];
}

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

/// Twice the place of each number when sorted, the same for equal ones; -1 of NaN.
std::vector<double> ranks_of(const std::vector<double>& numbers);

/// Reads a headed CSV file. A column is numeric if all its cells are numbers, else categorical. A cell without a value
/// is missing. Throws InputError with file, line, column and value for a row without a class, a column that is nearly
/// all numbers, columns that have the same value everywhere or none at all, and data of a single class.
DataTable read_data(const std::string& file, const DataOptions& options, bool quiet);

}  // namespace sigmax::apps
