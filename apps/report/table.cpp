#include "report/table.hpp"

#include <cmath>

#include "table/csv.hpp"

namespace sigmax::apps {
namespace {

constexpr std::string_view gap = "  ";

using Lines = std::vector<std::string>;

/// A column as it is laid out in one block: header and cells are broken to widths of their own.
struct Laid {
  std::string header;
  Lines cells;  // by row
  Align align;
  std::size_t header_width = any_width, cell_width = any_width;
  std::size_t width = 0;

  void fit() {
    width = widest(lines_of(header, header_width));
    for (const std::string& cell : cells) width = std::max(width, widest(lines_of(cell, cell_width)));
  }
};
using Block = std::vector<Laid>;

std::size_t total(const Block& block) {
  std::size_t width = (block.size() - 1) * gap.size();
  for (const Laid& column : block) width += column.width;
  return width;
}

/// Gives what is left of the width to the headers with the most lines.
void relax_headers(Block& block, std::size_t width) {
  const auto height = [](const Laid& column, std::size_t at) { return lines_of(column.header, at).size(); };
  for (;;) {
    Laid& highest = *std::ranges::max_element(
        block, [&](const Laid& a, const Laid& b) { return height(a, a.header_width) < height(b, b.header_width); });
    const std::size_t lines = height(highest, highest.header_width), most = highest.width + width - total(block);
    std::size_t wider = highest.width + 1;
    while (wider <= most && height(highest, wider) == lines) ++wider;
    if (lines < 2 || wider > most) return;
    highest.header_width = wider;
    highest.fit();
  }
}

/// Breaks headers where the cells below are narrower, and then, from the widest on, cells of words.
void squeeze(Block& block, std::size_t width) {
  constexpr std::size_t least_text = 20;
  if (total(block) <= width) return;
  for (Laid& column : block) {
    column.header_width = std::max({std::size_t{1}, widest(column.cells), widest(words_of(column.header))});
    column.fit();
  }
  for (std::size_t tries = 0; tries < block.size() && total(block) > width; ++tries) {
    Laid* text = nullptr;
    for (Laid& column : block)
      if (column.align == Align::left && (!text || column.width > text->width)) text = &column;
    const std::size_t excess = total(block) - width;
    if (!text || text->width < excess + least_text) break;
    text->header_width = text->cell_width = text->width - excess;
    text->fit();
  }
  if (total(block) <= width) relax_headers(block, width);
}

/// The lines of one row, or of the headers, which stand at its bottom.
void append(std::string& text, const Block& block, const std::vector<Lines>& cells, bool at_the_bottom) {
  const std::size_t height = cells.empty() ? 0 : std::ranges::max(each(cells, &Lines::size));
  for (std::size_t k = 0; k < height; ++k) {
    std::string line;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::size_t above = at_the_bottom ? height - cells[i].size() : 0;
      const std::string cell = k >= above && k - above < cells[i].size() ? cells[i][k - above] : "";
      const std::string blanks(block[i].width - display_width(cell), ' ');
      line.append(i > 0 ? gap : "").append(block[i].align == Align::right ? blanks + cell : cell + blanks);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
}

std::string text_of(const Block& block, const std::vector<std::vector<Cell>>& rows) {
  std::string text, rule;
  std::vector<Lines> cells;
  for (const Laid& column : block) {
    cells.push_back(lines_of(column.header, column.header_width));
    rule += rule.empty() ? "" : gap;
    for (std::size_t i = 0; i < column.width; ++i) rule += "─";
  }
  append(text, block, cells, true);
  text += rule + '\n';
  for (std::size_t row = 0; row < rows.size(); ++row) {
    cells.clear();
    for (const Laid& column : block) cells.push_back(lines_of(column.cells[row], column.cell_width));
    if (rows[row].empty())
      text += rule + '\n';
    else
      append(text, block, cells, false);
  }
  return text;
}

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::string csv_number(double value) { return std::isfinite(value) ? shortest(value) : ""; }

std::string csv_of(const Cell& cell, const ResultColumn& column) {
  const char* const no_bounds = column.interval ? ",," : "";
  return std::visit(Overloaded{[&](std::monostate) { return std::string(no_bounds); },
                               [&](const std::string& words) { return csv_field(words) + no_bounds; },
                               [&](double value) { return csv_number(value) + no_bounds; },
                               [&](auto whole) { return fmt::format("{}", whole) + no_bounds; },
                               [&](const Interval& interval) {
                                 if (!column.interval || without_bounds(interval))
                                   return csv_number(interval.mean) + no_bounds;
                                 return fmt::format("{},{},{}", shortest(interval.mean), shortest(interval.lower()),
                                                    shortest(interval.upper()));
                               }},
                    cell.value());
}

/// Throws unless there is a cell for each column, and a column.
template <class Columns, class Cells>
void check(const Columns& columns, const Cells& cells) {
  if (cells.size() != columns.size() || columns.empty())
    throw std::invalid_argument(fmt::format("a row of {} cells in a table of {}", cells.size(), columns.size()));
}

}  // namespace

std::string number_text(double value, int digits, bool sign) {
  constexpr double greatest = 1e9;  // longer numbers are unreadable
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0.0 ? (sign ? "+∞" : "∞") : "−∞";
  if (std::abs(value) >= greatest) return sign ? fmt::format("{:+.3g}", value) : fmt::format("{:.3g}", value);
  return sign ? fmt::format("{:+.{}f}", value, digits) : fmt::format("{:.{}f}", value, digits);
}

std::string sized_text(double value, int digits, bool sign) {
  const double size = std::abs(value);
  const bool legible = size >= 0.5 * std::pow(10.0, -digits) && size < 1e6;
  if (value == 0.0 || !std::isfinite(value) || legible) return number_text(value, digits, sign);
  return sign ? fmt::format("{:+.2g}", value) : fmt::format("{:.2g}", value);
}

bool without_bounds(const Interval& interval) {
  return std::isinf(interval.half_width) || (interval.mean == 0.0 && interval.half_width == 0.0);
}

std::string shown_in(const ResultColumn& column, const Cell& cell) {
  if (!cell.shown().empty()) return cell.shown();
  const auto shown = [&](double value, bool sign) {
    return (column.sized ? sized_text : number_text)(column.scale * value, column.digits, sign);
  };
  return std::visit(
      Overloaded{[](std::monostate) { return std::string(); }, [](const std::string& words) { return words; },
                 [&](double value) { return shown(value, column.sign); },
                 [](auto whole) { return fmt::format("{}", whole); },
                 [&](const Interval& interval) {
                   if (column.sign && interval.mean == 0.0 && interval.half_width == 0.0)
                     return std::string("none differs");
                   return shown(interval.mean, column.sign) + " ± " + shown(interval.half_width, false);
                 }},
      cell.value());
}

ResultTable::ResultTable(std::vector<ResultColumn> columns) : columns_(std::move(columns)) {
  check(columns_, columns_);
}

ResultTable ResultTable::of_keys(const std::vector<std::string>& keys) {
  ResultTable table;
  for (const std::string& key : keys) table.columns_.push_back({.key = key});
  return table;
}

void ResultTable::row(std::vector<Cell> cells) {
  check(columns_, cells);
  rows_.push_back(std::move(cells));
}

void ResultTable::row_of(const std::vector<Field>& fields) {
  std::vector<Cell> cells;
  for (const Field& field : fields) {
    if (rows_.empty()) columns_.push_back(field.column);
    cells.push_back(field.cell);
  }
  row(std::move(cells));
}

ResultTable ResultTable::part(unsigned part, const std::string& header, std::size_t first_row, std::size_t rows) const {
  const auto chosen = [&](const auto& all) {
    std::decay_t<decltype(all)> some;
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((columns_[i].parts & part) != 0) some.push_back(all[i]);
    return some;
  };
  ResultTable table(chosen(columns_));
  table.columns_.front().header = header;
  for (std::size_t row = first_row; row < rows_.size() && row - first_row < rows; ++row)
    table.rows_.push_back(chosen(rows_[row]));
  return table;
}

std::string ResultTable::text(std::size_t width) const {
  Block columns;
  Lines groups;  // of the columns
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].header.empty()) continue;
    groups.push_back(printable(columns_[i].group));
    Laid& own = columns.emplace_back(Laid{printable(columns_[i].full_header()), {}, columns_[i].align});
    for (const auto& row : rows_) own.cells.push_back(row.empty() ? "" : printable(shown_in(columns_[i], row[i])));
  }
  check(columns, columns);
  // The first column and those from `begin` to `end`, as they stand in one block.
  const auto laid = [&](std::size_t begin, std::size_t end) {
    Block block;
    for (std::size_t i = 0; i < end; i = i == 0 ? begin : i + 1) {
      Laid& column = block.emplace_back(columns[i]);
      const bool first_of_group = !groups[i].empty() && (i == begin || groups[i - 1] != groups[i]);
      if (first_of_group) column.header = groups[i] + " " + column.header;
      column.fit();
    }
    if (width != any_width) squeeze(block, width);
    return block;
  };
  const auto end_of_group = [&](std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < columns.size() && !groups[begin].empty() && groups[end] == groups[begin]) ++end;
    return end;
  };

  const Block whole = laid(1, columns.size());
  if (width == any_width || total(whole) <= width || columns.size() == 1) return text_of(whole, rows_);
  std::string text;
  for (std::size_t begin = 1; begin < columns.size();) {
    std::size_t end = end_of_group(begin);
    while (end > begin + 1 && total(laid(begin, end)) > width) --end;  // a group that is too wide for one block
    const bool whole_groups = end == end_of_group(begin);
    while (whole_groups && end < columns.size() && total(laid(begin, end_of_group(end))) <= width)
      end = end_of_group(end);
    text += (text.empty() ? "" : "\n") + text_of(laid(begin, end), rows_);
    begin = end;
  }
  return text;
}

std::string ResultTable::csv() const {
  std::string text = csv_header();
  for (const auto& row : rows_)
    if (!row.empty()) text += csv_line(row);
  return text;
}

std::string ResultTable::csv_header() const {
  std::string text;
  for (const ResultColumn& column : columns_) {
    if (column.key.empty()) continue;
    text += (text.empty() ? "" : ",") + csv_field(column.key);
    if (column.interval) text += "," + csv_field(column.key + "_lower") + "," + csv_field(column.key + "_upper");
  }
  return text + "\n";
}

std::string ResultTable::csv_line(const std::vector<Cell>& cells) const {
  check(columns_, cells);
  std::string text;
  bool first = true;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (!columns_[i].key.empty()) text += (std::exchange(first, false) ? "" : ",") + csv_of(cells[i], columns_[i]);
  return text + "\n";
}

}  // namespace sigmax::apps
