#include "support/table.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

namespace sigmax::apps {
namespace {

constexpr std::string_view gap = "  ";

struct Range {
  char32_t first;
  char32_t last;
};

// The blocks that results and names in this program's tables can plausibly hold, not all of Unicode.
constexpr Range zero_wide[] = {{0x0300, 0x036F}, {0x200B, 0x200F}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}};
constexpr Range double_wide[] = {{0x1100, 0x115F}, {0x2E80, 0xA4CF}, {0xAC00, 0xD7A3},
                                 {0xF900, 0xFAFF}, {0xFF00, 0xFF60}, {0x1F300, 0x1FAFF}};

template <std::size_t size>
bool contains(const Range (&ranges)[size], char32_t character) {
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [character](Range range) { return range.first <= character && character <= range.last; });
}

/// Takes the first character off the text; a byte that starts none counts as one.
char32_t take_character(std::string_view& text) {
  const auto byte = [&text](std::size_t index) { return static_cast<std::uint8_t>(text[index]); };
  const std::size_t size = byte(0) >= 0xF0U ? 4 : byte(0) >= 0xE0U ? 3 : byte(0) >= 0xC0U ? 2 : 1;
  char32_t character = size == 1 ? byte(0) : byte(0) & (0xFFU >> (size + 1));
  std::size_t taken = 1;
  for (; taken < size && taken < text.size() && (byte(taken) & 0xC0U) == 0x80U; ++taken)
    character = (character << 6U) | (byte(taken) & 0x3FU);
  text.remove_prefix(taken);
  return character;
}

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

void end_line(std::string& text) {
  text.resize(text.find_last_not_of(' ') + 1);
  text += '\n';
}

}  // namespace

TextTable::TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {
  if (columns_.empty()) throw std::invalid_argument("a table needs a column");
}

void TextTable::row(std::vector<std::string> cells) {
  if (cells.size() != columns_.size())
    throw std::invalid_argument(fmt::format("a row of {} cells in a table of {}", cells.size(), columns_.size()));
  rows_.push_back(std::move(cells));
}

void TextTable::rule() { rows_.emplace_back(); }

std::string TextTable::text() const {
  std::vector<std::size_t> widths;
  std::vector<std::string> headers;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    headers.push_back(columns_[i].header);
    widths.push_back(display_width(headers[i]));
    for (const auto& row : rows_)
      if (!row.empty()) widths[i] = std::max(widths[i], display_width(row[i]));
  }

  std::string text;
  const auto append = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (i > 0) line += gap;
      const std::string cell = cells.empty() ? repeated("─", widths[i]) : cells[i];
      const std::string blanks(widths[i] - display_width(cell), ' ');
      line += columns_[i].align == Align::right ? blanks + cell : cell + blanks;
    }
    end_line(line);
    text += line;
  };
  append(headers);
  append({});
  for (const auto& row : rows_) append(row);
  return text;
}

void TextTable::print(std::FILE* file) const {
  const std::string whole = text();
  std::fwrite(whole.data(), 1, whole.size(), file);
}

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  while (!text.empty()) {
    const char32_t character = take_character(text);
    width += contains(zero_wide, character) ? 0U : contains(double_wide, character) ? 2U : 1U;
  }
  return width;
}

}  // namespace sigmax::apps
