#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace sigmax::apps {

enum class Align { left, right };

/// A table as aligned text:
///
///     filter  RMSE x, m
///     ──────  ─────────
///     IMM         12.30
class TextTable {
 public:
  struct Column {
    std::string header;
    Align align = Align::right;
  };

  explicit TextTable(std::vector<Column> columns);

  /// Adds a row with a cell a column; throws std::invalid_argument for another number.
  void row(std::vector<std::string> cells);

  /// Adds a rule below the rows so far.
  void rule();

  std::string text() const;
  void print(std::FILE* file = stdout) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;  // a rule is a row without cells
};

/// Columns that UTF-8 text takes on a terminal: none for combining marks, two for East Asian and pictographic
/// characters.
std::size_t display_width(std::string_view text);

}  // namespace sigmax::apps
