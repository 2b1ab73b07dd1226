#include "checks/table_checks.hpp"

#include <array>
#include <map>
#include <set>

#include "shell/command_line.hpp"
#include "shell/text.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t few_rows = 20;  ///< among fewer it is no wonder that all values differ

template <class... Words>
std::string of_column(const std::string& name, fmt::format_string<Words...> format, Words&&... words) {
  return "column " + in_quotes(name) + fmt::format(format, std::forward<Words>(words)...);
}

std::size_t rows_with(const TableColumn& column, std::size_t word) {
  return static_cast<std::size_t>(std::ranges::count(column.cells, static_cast<double>(word)));
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
  if (std::ranges::all_of(column.words, [](const auto& word) { return parse_number(word).has_value(); }))
    return of_column(column.name, ": {} numbers in {} cells count as words by --categorical; take them as numbers",
                     words, cells);
  return of_column(column.name, " names the rows ({} words in {} cells); leave it out by --ignore {}", words, cells,
                   typed(column.name));
}

/// A column that alone tells the class: by few values, each of one class, or by numbers between which limits lie.
std::string tells_class(const LabelledTable& table, const TableColumn& column) {
  constexpr std::size_t few_values = 8;
  std::map<double, std::size_t> class_of;
  std::vector<std::pair<double, double>> ranges(table.classes.size(), {infinity, -infinity});
  bool by_value = true;
  std::size_t rows = 0;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const double value = column.cells[row];
    if (std::isnan(value)) continue;
    ++rows;
    const std::size_t its_class = table.labels[row];
    auto& [low, high] = ranges[its_class];
    low = std::min(low, value), high = std::max(high, value);
    by_value =
        by_value && class_of.size() < few_values && class_of.try_emplace(value, its_class).first->second == its_class;
  }
  by_value = by_value && class_of.size() >= ranges.size() && rows >= 2 * class_of.size();
  std::ranges::sort(ranges);
  bool by_limits = column.numeric() && ranges.back().first < infinity;
  for (std::size_t k = 1; k < ranges.size(); ++k) by_limits = by_limits && ranges[k - 1].second < ranges[k].first;
  if (rows < few_rows || !(by_value || by_limits)) return "";
  return of_column(
      column.name,
      " alone tells the class of all {} rows that have a value; if it is not known before the class, leave "
      "it out by --ignore {}",
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

/// Numbers at one end of a column that are codes, or come again, farther from the others than these are from each
/// other; or a code of which there are no others below 0.
std::string far_numbers(const TableColumn& column) {
  constexpr std::size_t again = 3, few_values = 8, most_codes = 3;
  std::map<double, std::size_t> all;
  for (const double number : column.cells)
    if (!std::isnan(number)) ++all[number];
  for (const bool above : {false, true}) {
    std::map<double, std::size_t> rest = all;
    std::vector<std::string> words;
    std::size_t cells = 0;
    while (words.size() < most_codes && rest.size() > 1) {
      const auto [number, times] = above ? *rest.rbegin() : *rest.begin();
      if (times < again && !is_code(number)) break;
      rest.erase(number);
      words.push_back(shortest(number));
      cells += times;
      const double low = rest.begin()->first, high = rest.rbegin()->first, next = above ? high : low;
      const bool lone = words.size() == 1 && times >= again && low >= 0.0 && rest.size() > few_values &&
                        std::set{-1.0, -9.0, -99.0, -999.0}.contains(number);
      const double gap = std::abs(number - next);
      const bool far =
          gap > high - low && gap > 0.05 * std::abs(next) && (rest.size() >= few_values || is_code(number));
      if ((lone || far) && column.cells.size() >= few_rows + 2 * cells)
        return of_column(column.name, ": {} {} {}, far from the others; if {} for no value, give --missing={}", cells,
                         cells == 1 ? "cell is" : "cells are", fmt::join(words, " or "),
                         words.size() == 1 ? "that stands" : "these stand", fmt::join(words, ","));
    }
  }
  return "";
}

/// Numbers or words that may stand for no value.
std::string sentinels(const LabelledTable& table, const TableColumn& column) {
  if (column.numeric()) return far_numbers(column);
  const auto unknown = std::ranges::find_if(column.words, says_unknown);
  if (unknown == column.words.end()) return "";
  return of_column(column.name,
                   ": {} of {} rows hold {}, a value among words; if it stands for none, give --missing={}",
                   rows_with(column, static_cast<std::size_t>(unknown - column.words.begin())), table.size(),
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

/// Cells that are missing because of the class.
std::string gaps(const LabelledTable& table, const TableColumn& column) {
  std::vector<double> shares(table.classes.size());
  for (std::size_t row = 0; row < table.size(); ++row)
    if (std::isnan(column.cells[row]))
      shares[table.labels[row]] += 1.0 / static_cast<double>(table.rows_of_class[table.labels[row]]);
  std::vector<std::size_t> known;  // classes of which one can tell
  for (std::size_t c = 0; c < shares.size(); ++c)
    if (table.rows_of_class[c] >= few_rows) known.push_back(c);
  if (column.missing_is_value || known.empty()) return "";
  const auto [least, most] = std::ranges::minmax(known, {}, [&](std::size_t c) { return shares[c]; });
  if (shares[most] - shares[least] < 0.5) return "";
  return of_column(
      column.name,
      ": {:.0f} % of the cells of class {} are missing, {:.0f} % of {}; if that is known before the class, "
      "give --missing-value {}",
      100.0 * shares[most], in_quotes(table.classes[most]), 100.0 * shares[least], in_quotes(table.classes[least]),
      typed(column.name));
}

std::string written_otherwise(const std::string& column, const std::vector<std::string>& words) {
  const std::string two = alike({words.begin(), words.end()});
  return two.empty() ? "" : of_column(column, ": {} differ in writing only, and count as two; write them alike", two);
}

std::vector<std::string> of_classes(const LabelledTable& table) {
  const auto& classes = table.classes;
  std::vector<std::string> found = {written_otherwise(table.label, classes)};
  if (std::ranges::find(classes, table.label) != classes.end())
    found.push_back(fmt::format("the first row looks like data, since {} is also a class; put a row of names above it",
                                in_quotes(table.label)));
  if (2 * classes.size() > table.size() && table.size() >= few_rows)
    found.push_back(of_column(table.label, " names the rows ({} classes in {} rows); give another --label",
                              classes.size(), table.size()));
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const std::string name = lower_case(classes[c]);
    const bool is_minus = name == "-" && std::ranges::find(classes, "+") == classes.end();
    if (says_unknown(name) || is_minus || name == "--" || name == "unknown")
      found.push_back(of_column(table.label,
                                ": {} of {} rows hold {}, which counts as a class; if their class is not "
                                "known, remove these rows",
                                table.rows_of_class[c], table.size(), in_quotes(classes[c])));
  }
  return found;
}

/// How often two rows have the same in a column, and how many different cells there are.
std::pair<double, std::size_t> sameness(const LabelledTable& table, const TableColumn& column) {
  auto cells = each_below(table.size(), [&](std::size_t row) {
    const double value = column.cells[row];
    return std::isnan(value) ? infinity : value;
  });
  std::ranges::sort(cells);
  double squares = 0.0;
  std::size_t different = 0;
  for (auto first = cells.begin(); first != cells.end(); ++different) {
    const auto last = std::upper_bound(first, cells.end(), *first);
    squares += std::pow(static_cast<double>(last - first) / static_cast<double>(cells.size()), 2);
    first = last;
  }
  return {squares, different};
}

/// Rows, of all or of a class, that repeat another, and not by chance.
std::string copies(const LabelledTable& table) {
  std::vector<std::pair<std::size_t, std::size_t>> rows;  // class and hash
  for (std::size_t row = 0; row < table.size(); ++row) {
    std::size_t hash = 0;
    for (const TableColumn& column : table.columns) {
      const double value = column.cells[row];
      hash = (hash ^ std::hash<double>{}(std::isnan(value) ? infinity : value)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32U;
    }
    rows.emplace_back(table.labels[row], hash);
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::vector<std::size_t> differ(table.classes.size());
  for (const auto& [its_class, hash] : rows) ++differ[its_class];
  std::size_t all = table.size(), different = rows.size(), c = 0;
  std::string which = fmt::format("{} rows", all);
  while (c < differ.size() && (table.rows_of_class[c] < few_rows || 2 * differ[c] > table.rows_of_class[c])) ++c;
  if (c < differ.size() && 2 * different > all) {
    which = "the rows of class " + in_quotes(table.classes[c]);
    all = table.rows_of_class[c], different = differ[c];
  }
  // Where two columns tell most rows apart none is the same by chance; else if half of the columns hang on the others.
  std::size_t fine = 0;
  const auto n = static_cast<double>(all);
  double pairs = n * n / 2.0;
  for (const TableColumn& column : table.columns) {
    const auto [same, values] = sameness(table, column);
    fine += 2 * values > rows.size() ? 1U : 0U;
    pairs *= std::sqrt(same);
  }
  if (10 * (all - different) < all || all < few_rows) return "";
  if (fine < 2 && 10.0 * pairs >= static_cast<double>(all - different)) return "";
  return fmt::format(
      "{:.0f} % of {} repeat another, label included, so that too many answers are right; drop the copies",
      100.0 * (1.0 - static_cast<double>(different) / n), which);
}

}  // namespace

std::vector<std::string> findings_of(const LabelledTable& table) {
  std::vector<std::string> found = of_classes(table);
  found.push_back(copies(table));
  for (const TableColumn& column : table.columns) {
    const std::string written = column.numeric() ? "" : written_numbers(column);
    found.push_back(written.empty() ? names_rows(table, column) : written);
    if (!found.back().empty()) continue;  // the cause of what else there is to see
    for (std::string& more : std::vector{tells_class(table, column), sentinels(table, column), gaps(table, column),
                                         written_otherwise(column.name, column.words)})
      found.push_back(std::move(more));
  }
  std::erase(found, "");
  return found;
}

void print_findings(const LabelledTable& table) {
  for (const auto& note : table.notes) complain(fmt::format("recognition_demo: note: {}: {}", table.file, note));
  for (const auto& finding : findings_of(table))
    complain(fmt::format("recognition_demo: warning: {}: {}", table.file, finding));
}

}  // namespace sigmax::apps
