#include "support/table.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/error.hpp"

namespace sigmax::apps {
namespace {

constexpr std::string_view gap = "  ";

struct Characters {
  char32_t first;
  char32_t last;
};

// The blocks that results and names in this program's tables can plausibly hold, not all of Unicode.
constexpr Characters zero_wide[] = {{0x0300, 0x036F}, {0x200B, 0x200F}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}};
constexpr Characters double_wide[] = {{0x1100, 0x115F}, {0x2E80, 0xA4CF}, {0xAC00, 0xD7A3},
                                      {0xF900, 0xFAFF}, {0xFF00, 0xFF60}, {0x1F300, 0x1FAFF}};

template <std::size_t size>
bool contains(const Characters (&ranges)[size], char32_t character) {
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [character](Characters range) { return range.first <= character && character <= range.last; });
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

using Lines = std::vector<std::string>;

std::size_t widest(const Lines& lines) {
  std::size_t width = 0;
  for (const std::string& line : lines) width = std::max(width, display_width(line));
  return width;
}

/// The words of a line; a sign alone is no word.
Lines words_of(std::string_view line) {
  Lines words;
  bool joined = false;
  while (!line.empty()) {
    const auto blank = std::min(line.find(' '), line.size());
    const std::string_view word = line.substr(0, blank);
    line.remove_prefix(std::min(blank + 1, line.size()));
    const bool sign = word == "±" || word == "−" || word == "=";
    if (!words.empty() && (joined || word == "±" || word == "="))
      words.back().append(" ").append(word);
    else
      words.emplace_back(word);
    joined = sign;
  }
  return words;
}

/// A column as it is laid out in one block.
struct Laid {
  Lines header;
  std::vector<Lines> cells;  // by row; a rule has no line
  std::size_t width = 0;
  Align align = Align::right;

  void fit() {
    width = widest(header);
    for (const Lines& cell : cells) width = std::max(width, widest(cell));
  }
};

std::size_t total(const std::vector<Laid>& block) {
  std::size_t width = (block.size() - 1) * gap.size();
  for (const Laid& column : block) width += column.width;
  return width;
}

/// Gives what is left of the width to the headers with the most lines.
void relax_headers(std::vector<Laid>& block, std::size_t width) {
  for (bool changed = true; changed;) {
    changed = false;
    const auto highest = std::max_element(
        block.begin(), block.end(), [](const Laid& a, const Laid& b) { return a.header.size() < b.header.size(); });
    if (highest->header.size() < 2) return;
    const std::string header = fmt::format("{}", fmt::join(highest->header, " "));
    const std::size_t most = highest->width + width - total(block);
    for (std::size_t wider = highest->width + 1; wider <= most && !changed; ++wider) {
      Lines lines = lines_of(header, wider);
      if (lines.size() == highest->header.size()) continue;
      highest->header = std::move(lines);
      highest->fit();
      changed = true;
    }
  }
}

/// Breaks headers where the cells below are narrower, and then, from the widest on, cells of words.
void squeeze(std::vector<Laid>& block, std::size_t width) {
  constexpr std::size_t least_text = 20;
  if (total(block) <= width) return;
  for (Laid& column : block) {
    std::size_t needed = 1;
    for (const Lines& cell : column.cells) needed = std::max(needed, widest(cell));
    for (const std::string& word : words_of(column.header.front())) needed = std::max(needed, display_width(word));
    column.header = lines_of(column.header.front(), needed);
    column.fit();
  }
  for (std::size_t tries = 0; tries < block.size() && total(block) > width; ++tries) {
    Laid* widest_text = nullptr;
    for (Laid& column : block)
      if (column.align == Align::left && (!widest_text || column.width > widest_text->width)) widest_text = &column;
    const std::size_t excess = total(block) - width;
    if (!widest_text || widest_text->width < excess + least_text) break;
    for (Lines& cell : widest_text->cells)
      if (!cell.empty()) cell = lines_of(cell.front(), widest_text->width - excess);
    widest_text->header = lines_of(widest_text->header.front(), widest_text->width - excess);
    widest_text->fit();
  }
  if (total(block) <= width) relax_headers(block, width);
}

void append_lines(std::string& text, const std::vector<Laid>& block, const std::vector<const Lines*>& cells,
                  bool at_the_bottom) {
  std::size_t height = 0;
  for (const Lines* cell : cells) height = std::max(height, cell->size());
  for (std::size_t k = 0; k < height; ++k) {
    std::string line;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::size_t before = at_the_bottom ? height - cells[i]->size() : 0;
      const std::string cell = k >= before && k - before < cells[i]->size() ? (*cells[i])[k - before] : "";
      const std::string blanks(block[i].width - display_width(cell), ' ');
      if (i > 0) line += gap;
      line += block[i].align == Align::right ? blanks + cell : cell + blanks;
    }
    end_line(line);
    text += line;
  }
}

std::string text_of(const std::vector<Laid>& block) {
  std::string text, rule;
  for (const Laid& column : block) rule.append(rule.empty() ? "" : gap).append(repeated("─", column.width));
  rule += '\n';
  std::vector<const Lines*> cells;
  for (const Laid& column : block) cells.push_back(&column.header);
  append_lines(text, block, cells, true);
  text += rule;
  for (std::size_t row = 0; row < block.front().cells.size(); ++row) {
    if (block.front().cells[row].empty()) {
      text += rule;
      continue;
    }
    cells.clear();
    for (const Laid& column : block) cells.push_back(&column.cells[row]);
    append_lines(text, block, cells, false);
  }
  return text;
}

}  // namespace

TextTable::TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {
  if (columns_.empty()) throw std::invalid_argument("a table needs a column");
  for (Column& column : columns_) {
    column.header = printable(column.header);
    column.group = printable(column.group);
  }
}

void TextTable::row(std::vector<std::string> cells) {
  if (cells.size() != columns_.size())
    throw std::invalid_argument(fmt::format("a row of {} cells in a table of {}", cells.size(), columns_.size()));
  for (std::string& cell : cells) cell = printable(cell);
  rows_.push_back(std::move(cells));
}

void TextTable::rule() { rows_.emplace_back(); }

std::string TextTable::text(std::size_t width) const {
  // The first column and those from `begin` to `end`, as they stand in one block.
  const auto laid = [&](std::size_t begin, std::size_t end) {
    std::vector<Laid> block;
    for (std::size_t i = 0; i < end; i = i == 0 ? begin : i + 1) {
      const Column& column = columns_[i];
      const bool first_of_group = !column.group.empty() && (i == begin || columns_[i - 1].group != column.group);
      Laid& one = block.emplace_back();
      one.header = {first_of_group ? column.group + " " + column.header : column.header};
      one.align = column.align;
      for (const auto& row : rows_) one.cells.push_back(row.empty() ? Lines{} : Lines{row[i]});
      one.fit();
    }
    if (width != any_width) squeeze(block, width);
    return block;
  };
  const auto end_of_group = [&](std::size_t begin) {
    std::size_t end = begin + 1;
    if (columns_[begin].group.empty()) return end;
    while (end < columns_.size() && columns_[end].group == columns_[begin].group) ++end;
    return end;
  };

  std::vector<Laid> whole = laid(1, columns_.size());
  if (width == any_width || total(whole) <= width || columns_.size() == 1) return text_of(whole);
  std::string text;
  for (std::size_t begin = 1; begin < columns_.size();) {
    std::size_t end = end_of_group(begin);
    while (end > begin + 1 && total(laid(begin, end)) > width) --end;  // a group that is too wide for one block
    const bool whole_groups = end == end_of_group(begin);
    while (whole_groups && end < columns_.size() && total(laid(begin, end_of_group(end))) <= width)
      end = end_of_group(end);
    text += (text.empty() ? "" : "\n") + text_of(laid(begin, end));
    begin = end;
  }
  return text;
}

void TextTable::print(std::FILE* file, std::size_t width) const {
  const std::string whole = text(width);
  std::fwrite(whole.data(), 1, whole.size(), file);
}

std::vector<std::string> lines_of(std::string_view text, std::size_t width) {
  Lines lines;
  for (bool more = true; more;) {
    const auto end = text.find('\n');
    more = end != std::string_view::npos;
    const std::string_view line = text.substr(0, end);
    if (more) text.remove_prefix(end + 1);
    if (width == any_width || display_width(line) <= width) {
      lines.emplace_back(line);
      continue;
    }
    const std::string indent(std::min(line.find_first_not_of(' '), line.size()), ' ');
    std::string current;
    for (const std::string& word : words_of(line.substr(indent.size()))) {
      if (!current.empty() && display_width(current) + 1 + display_width(word) > width)
        lines.push_back(std::exchange(current, {}));
      current += (current.empty() ? indent : " ") + word;
    }
    lines.push_back(current);
  }
  return lines;
}

std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  if (text.ends_with('\n')) text.remove_suffix(1);
  for (const std::string& line : lines_of(printable(text, true), width)) result += line + "\n";
  return result;
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
