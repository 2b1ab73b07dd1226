#pragma once

#include <cstdint>
#include <limits>
#include <variant>

#include <nlohmann/json_fwd.hpp>

#include <sigmax/core/mean_interval.hpp>

#include "shell/text.hpp"

namespace sigmax::apps {

enum class Align { left, right };

/// A number with so many digits after the point. Great numbers come as 1.5e+150, NaN as "–".
std::string number_text(double value, int digits, bool sign = false);

/// As `number_text`, but what would be 0.00, and millions, have two digits that count: 0.0012, 3.4e-07, 6.4e+07.
std::string sized_text(double value, int digits, bool sign = false);

/// What a cell of a result holds: nothing, words, a number, a count, whether something holds, or a mean with its
/// interval.
class Cell {
 public:
  Cell() = default;
  Cell(std::string words) : value_(std::move(words)) {}
  Cell(std::string_view words) : value_(std::string(words)) {}
  Cell(const char* words) : value_(std::string(words)) {}
  Cell(double number) : value_(number) {}
  /// A number that the terminal and a page show like this, whatever its column says.
  Cell(double number, std::string shown) : value_(number), shown_(std::move(shown)) {}
  Cell(Interval interval) : value_(interval) {}
  template <std::integral Count>
  Cell(Count count) {
    if constexpr (std::is_same_v<Count, bool>)
      value_ = count;
    else if constexpr (std::is_unsigned_v<Count>)
      value_ = std::uint64_t{count};
    else
      value_ = std::int64_t{count};
  }

  /// Nothing is known where there could be something: "–", null in JSON.
  template <class T>
  Cell(const std::optional<T>& value) : value_(std::numeric_limits<double>::quiet_NaN()) {
    if (value) *this = Cell(*value);
  }

  using Value = std::variant<std::monostate, std::string, double, std::int64_t, std::uint64_t, bool, Interval>;
  const Value& value() const { return value_; }
  const std::string& shown() const { return shown_; }

 private:
  Value value_;
  std::string shown_;
};

/// How a column is named, and how its numbers are shown.
struct ResultColumn {
  std::string key{};      ///< in CSV and JSON; empty if the column is for the terminal only
  std::string header{};   ///< on the terminal; empty if the column is for files only
  std::string unit{};     ///< on the terminal, after the header and a comma
  int digits = 2;         ///< after the point, on the terminal
  double scale = 1.0;     ///< the terminal shows scale × the number: 100 for per cent
  bool sign = false;      ///< the terminal shows a + before what is positive
  bool sized = false;     ///< see `sized_text`
  bool interval = false;  ///< its numbers are intervals: three columns in CSV
  Align align = Align::right;
  /// Neighbours of one group stand in one block if they can. The first of them has the group before its header.
  std::string group{};
  unsigned parts = all_parts;  ///< see `ResultTable::part`

  static constexpr unsigned all_parts = ~0U;
  std::string full_header() const { return unit.empty() ? header : header + ", " + unit; }
};

/// A column of words.
inline ResultColumn of_words(std::string key, std::string header, unsigned parts = ResultColumn::all_parts) {
  return {.key = std::move(key), .header = std::move(header), .align = Align::left, .parts = parts};
}

/// What the terminal shows of a cell.
std::string shown_in(const ResultColumn& column, const Cell& cell);

/// Whether nothing is known of the spread: one number alone, or zeros only.
bool without_bounds(const Interval& interval);

/// A cell with its column.
struct Field {
  ResultColumn column;
  Cell cell;
};

/// Results as rows, which print themselves as text, CSV and JSON.
///
///     ResultTable table{{of_words("filter", "filter"), {.key = "rmse_m", .header = "RMSE", .unit = "m"}}};
///     table.row({"IMM", 12.3});
///     result.add(table, {.csv = "filters.csv", .summary = {"filters"}});   // {"filters": {"IMM": {"rmse_m": 12.3}}}
///
/// An interval is "+1.25 ± 0.40" on the terminal; in CSV it takes three columns, key, key_lower and key_upper; in JSON
/// it is {"mean", "lower", "upper"}. If its numbers were all zero there is no spread to judge by: it is "none differs",
/// and has no bounds.
class ResultTable {
 public:
  explicit ResultTable(std::vector<ResultColumn> columns);

  /// Adds a row with a cell a column; throws std::invalid_argument for another number.
  void row(std::vector<Cell> cells);

  /// One whose columns are for files only.
  static ResultTable of_keys(const std::vector<std::string>& keys);

  /// A table to which all rows are added as fields: the columns are those of the first one.
  ResultTable() = default;
  void row_of(const std::vector<Field>& fields);

  /// Adds a rule below the rows so far; it is for the terminal only.
  void rule() { rows_.emplace_back(); }

  bool empty() const { return rows_.empty(); }

  /// Some rows with the columns of a part, a bit of `ResultColumn::parts`, and another first header.
  ResultTable part(unsigned part, const std::string& header, std::size_t first_row = 0,
                   std::size_t rows = std::string::npos) const;

  /// The columns with a header as aligned text:
  ///
  ///     filter  RMSE x, m
  ///     ──────  ─────────
  ///     IMM         12.30
  ///
  /// Where it is wider than it may be, headers are broken into lines, then long words in cells that are aligned left,
  /// and then the columns go into blocks, one under the other, each with the first column before it.
  std::string text(std::size_t width = terminal_width) const;

  /// The columns with a key, below their keys.
  std::string csv() const;

  /// An object of each row by its first cell: those of its other columns that have a key, but for empty cells.
  nlohmann::ordered_json json() const;

  /// The columns with a header as a page shows them: {"columns": [{"header", "group", "left", "key"}], "rows":
  /// [[{"text", "value"}]]}, where a text is what the terminal shows, and a rule is a row without cells.
  nlohmann::ordered_json page() const;

  /// CSV for rows that are too many to keep: the first line, and a line of one row. Both end with a line break.
  std::string csv_header() const;
  std::string csv_line(const std::vector<Cell>& cells) const;

 private:
  std::vector<ResultColumn> columns_;
  std::vector<std::vector<Cell>> rows_;  // a rule is a row without cells
};

/// With its keys in the order in which they were written.
using Json = nlohmann::ordered_json;

/// A cell as JSON; an interval is {"mean", "lower", "upper"}.
Json as_json(const Cell& cell);

/// As text; of what is no UTF-8, a name in Latin-1, each byte stands as U+FFFD. Indented by so many blanks, or one
/// line.
std::string dumped(const Json& json, int indent = -1);

}  // namespace sigmax::apps
