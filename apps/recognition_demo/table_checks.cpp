#include "recognition_demo/learning.hpp"

#include <map>
#include <set>

#include <boost/functional/hash.hpp>

namespace sigmax::apps {
namespace {

constexpr std::size_t few_rows = 20;  ///< among fewer it is no wonder that all values differ

template <class... Words>
std::string of_column(const std::string& name, fmt::format_string<Words...> format, Words&&... words) {
  return "column " + in_quotes(name) + fmt::format(format, std::forward<Words>(words)...);
}

/// How often each cell is there that is not missing.
std::map<double, std::size_t> times_of(const TableColumn& column) {
  std::map<double, std::size_t> times;
  for (const double cell : column.cells)
    if (!std::isnan(cell)) ++times[cell];
  return times;
}

/// Whether numbers rise from row to row, as whole numbers or by even steps.
bool count_rows(const std::vector<double>& numbers) {
  const bool whole = std::ranges::all_of(numbers, [](double number) { return number == std::floor(number); });
  const double step = numbers[1] - numbers[0];
  for (std::size_t row = 1; row < numbers.size(); ++row) {
    const double by = numbers[row] - numbers[row - 1];  // NaN where a number is missing
    if (!(by > 0.0 && (whole || std::abs(by - step) <= 1e-6 * step))) return false;
  }
  return true;
}

/// A column that names the rows, or counts them.
std::string names_rows(const LabelledTable& table, const TableColumn& column) {
  if (table.size() < few_rows) return "";
  if (column.numeric())
    return !count_rows(column.cells)
               ? ""
               : of_column(column.name, " counts the rows; leave it out by --ignore {}", typed(column.name));
  const auto blank = std::ranges::count_if(column.cells, [](double cell) { return std::isnan(cell); });
  const std::size_t cells = table.size() - static_cast<std::size_t>(blank), words = column.words.size();
  if (cells < few_rows || 3 * words <= 2 * cells) return "";
  return of_column(column.name, " names the rows ({} words in {} cells); leave it out by --ignore {}", words, cells,
                   typed(column.name));
}

/// A column that alone tells the class, by few values, each of one class.
std::string determines_class(const LabelledTable& table, const TableColumn& column) {
  constexpr std::size_t few_values = 8;
  std::map<double, std::size_t> class_of;
  std::size_t rows = 0;
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (std::isnan(column.cells[row])) continue;
    ++rows;
    const auto found = class_of.try_emplace(column.cells[row], table.labels[row]).first;
    if (found->second != table.labels[row] || class_of.size() >= few_values) return "";
  }
  if (rows < few_rows || class_of.size() < table.classes.size() || rows < 2 * class_of.size()) return "";
  return of_column(column.name,
                   " alone tells the class of all {} rows that have a value; if it is not known before the class, "
                   "leave it out by --ignore {}",
                   rows, typed(column.name));
}

/// Whether a number is 99, -999, -99.9 or 8888, the least or greatest of an integer type, or beyond all sense.
bool is_code(double number) {
  constexpr std::array ends = {-2147483648.0, -32768.0, 32767.0, 65535.0, 2147483647.0, 4294967295.0};
  if (std::ranges::find(ends, number) != ends.end() || std::abs(number) >= 1e20) return true;
  std::string digits = shortest(std::abs(number));
  std::erase(digits, '.');
  return std::abs(number) >= 77.0 && digits[0] >= '7' && digits.find_first_not_of(digits[0]) == digits.npos;
}

/// A number at one end of a column that is a code, or comes again, farther from the others than these are from each
/// other.
std::string far_number(const TableColumn& column) {
  constexpr std::size_t again = 3, few_values = 8;
  for (const bool above : {false, true}) {
    std::map<double, std::size_t> rest = times_of(column);
    if (rest.size() < 2) break;
    const auto [number, times] = above ? *rest.rbegin() : *rest.begin();
    rest.erase(number);
    const double low = rest.begin()->first, high = rest.rbegin()->first, next = above ? high : low;
    const double gap = std::abs(number - next);
    if (gap > high - low && gap > 0.05 * std::abs(next) &&
        (is_code(number) || (times >= again && rest.size() >= few_values)) &&
        column.cells.size() >= few_rows + 2 * times)
      return of_column(column.name, ": {} {} {}, far from the others; if that stands for no value, give --missing={}",
                       times, times == 1 ? "cell is" : "cells are", shortest(number), shortest(number));
  }
  return "";
}

/// Numbers or words that may stand for no value.
std::string sentinels(const LabelledTable& table, const TableColumn& column) {
  if (column.numeric()) return far_number(column);
  const auto unknown = std::ranges::find_if(column.words, means_unknown);
  if (unknown == column.words.end()) return "";
  return of_column(column.name,
                   ": {} of {} rows hold {}, a value among words; if it stands for none, give --missing={}",
                   std::ranges::count(column.cells, static_cast<double>(unknown - column.words.begin())), table.size(),
                   in_quotes(*unknown), typed(*unknown));
}

/// What stands behind a number, as in "23.93 kg", or before it, as in "$12.50" and "EUR 5"; nothing of other words, and
/// of names, as A5.
std::optional<std::string_view> unit_of(std::string_view word) {
  constexpr std::string_view digits = "0123456789";
  const auto begin = std::min(word.find_first_of("+-.0123456789"), word.size());
  const auto end = std::min(word.find_first_not_of("+-., '0123456789", begin), word.size());
  const std::string_view before = word.substr(0, begin), after = word.substr(end);
  std::string bare(trimmed(word.substr(begin, end - begin)));
  std::erase_if(bare, [](char c) { return c == ',' || c == ' ' || c == '\''; });
  const bool is_name = begin > 0 && std::isalpha(static_cast<unsigned char>(word[begin - 1])) != 0;
  if (is_name || !parse_number(bare) || after.find_first_of(digits) != after.npos) return std::nullopt;
  return before.empty() ? after : before;
}

/// Numbers that count as words, for how they are written or for a word among them.
std::string written_numbers(const TableColumn& column) {
  constexpr std::size_t few = 8, few_words = 4;
  std::set<std::string_view> units;
  std::string example;
  std::vector<std::string> others;
  for (const std::string& word : column.words)
    if (const auto unit = unit_of(word); !unit)
      others.push_back(typed(word));
    else if (units.insert(*unit); !parse_number(word) && example.empty())
      example = word;
  const std::size_t numbers = column.words.size() - others.size();
  if (numbers <= few || others.size() >= numbers || units.size() > few_words) return "";
  if (!example.empty())
    return of_column(column.name, " holds numbers as words, as {}; write plain numbers, all in one unit",
                     in_quotes(example));
  if (others.empty() || others.size() > few_words) return "";
  return of_column(column.name, " holds {} numbers as words, because of {}; if there is no value, give --missing={}",
                   numbers, fmt::join(others, " and "), fmt::join(others, ","));
}

std::vector<std::string> of_classes(const LabelledTable& table) {
  const auto& classes = table.classes;
  std::vector<std::string> found;
  if (std::ranges::find(classes, table.label) != classes.end())
    found.push_back(fmt::format("the first row looks like data, since {} is also a class; put a row of names above it",
                                in_quotes(table.label)));
  if (2 * classes.size() > table.size() && table.size() >= few_rows)
    found.push_back(of_column(table.label, " names the rows ({} classes in {} rows); give another --label",
                              classes.size(), table.size()));
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const std::string name = lower_case(classes[c]);
    if (means_unknown(name) || name == "--" || name == "unknown")
      found.push_back(of_column(table.label,
                                ": {} of {} rows hold {}, which counts as a class; if their class is not "
                                "known, remove these rows",
                                table.rows_of_class[c], table.size(), in_quotes(classes[c])));
  }
  return found;
}

/// Rows that repeat another, and not by chance: two columns tell most rows apart.
std::string copies(const LabelledTable& table) {
  std::set<std::pair<std::size_t, std::size_t>> rows;  // class and hash
  for (std::size_t row = 0; row < table.size(); ++row) {
    std::size_t hash = 0;
    for (const TableColumn& column : table.columns)
      boost::hash_combine(hash, std::isnan(column.cells[row]) ? infinity : column.cells[row]);
    rows.emplace(table.labels[row], hash);
  }
  const std::size_t all = table.size(), copied = all - rows.size();
  if (10 * copied < all || all < few_rows) return "";
  const auto is_fine = [&](const TableColumn& column) { return 2 * times_of(column).size() > rows.size(); };
  if (std::ranges::count_if(table.columns, is_fine) < 2) return "";
  return fmt::format(
      "{:.0f} % of {} rows repeat another, label included, so that too many answers are right; drop the copies",
      100.0 * static_cast<double>(copied) / static_cast<double>(all), all);
}

}  // namespace

void print_findings(const LabelledTable& table) {
  for (const auto& note : table.notes) complain(fmt::format("recognition_demo: note: {}: {}", table.file, note));
  std::vector<std::string> found = of_classes(table);
  found.push_back(copies(table));
  for (const TableColumn& column : table.columns) {
    const std::string written = column.numeric() ? "" : written_numbers(column);
    found.push_back(written.empty() ? names_rows(table, column) : written);
    if (!found.back().empty()) continue;  // the cause of what else there is to see
    found.push_back(determines_class(table, column));
    found.push_back(sentinels(table, column));
  }
  for (const auto& finding : found)
    if (!finding.empty()) complain(fmt::format("recognition_demo: warning: {}: {}", table.file, finding));
}

}  // namespace sigmax::apps
