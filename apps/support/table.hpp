#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace sigmax::apps {

enum class Align { left, right };

/// Columns of a terminal that nobody has widened.
inline constexpr std::size_t terminal_width = 80;

/// As wide as it takes.
inline constexpr std::size_t any_width = 0;

/// A table as aligned text:
///
///     filter  RMSE x, m
///     ──────  ─────────
///     IMM         12.30
///
/// Where it is wider than it may be, headers are broken into lines, then long words in cells that are aligned left,
/// and then the columns go into blocks, one under the other, each with the first column before it.
class TextTable {
 public:
  struct Column {
    std::string header;
    Align align = Align::right;
    /// Neighbours of one group stand in one block if they can. The first of them has the group before its header.
    std::string group{};
  };

  explicit TextTable(std::vector<Column> columns);

  /// Adds a row with a cell a column; throws std::invalid_argument for another number.
  void row(std::vector<std::string> cells);

  /// Adds a rule below the rows so far.
  void rule();

  std::string text(std::size_t width = any_width) const;
  void print(std::FILE* file = stdout, std::size_t width = any_width) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;  // a rule is a row without cells
};

/// Columns that UTF-8 text takes on a terminal: none for combining marks, two for East Asian and pictographic
/// characters.
std::size_t display_width(std::string_view text);

/// The lines of a text, broken at blanks so that none is wider than this, but for words that are. A sign as in
/// "± 95" or "− sigma's" stays with what follows it. Line breaks in the text are kept.
std::vector<std::string> lines_of(std::string_view text, std::size_t width);

/// The same as one text that no terminal takes for commands, see `printable`; each line ends with a line break.
/// `any_width` breaks none.
std::string wrapped(std::string_view text, std::size_t width = terminal_width);

}  // namespace sigmax::apps
