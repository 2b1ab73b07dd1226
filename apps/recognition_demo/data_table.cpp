#include "recognition_demo/data_table.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include <fmt/ranges.h>

#include "support/input.hpp"
#include "support/nines.hpp"
#include "support/numbers.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

/// Words beyond this many are names of things, not values of a feature.
constexpr std::size_t most_values = 4096;

/// Among fewer rows it is no wonder that all values differ.
constexpr std::size_t few_rows = 20;

/// Words numbered as they come.
class Vocabulary {
 public:
  Code code(std::string_view word) {
    const auto found = codes_.find(word);
    if (found != codes_.end()) return found->second;
    return codes_.emplace(std::string(word), static_cast<Code>(codes_.size())).first->second;
  }
  std::size_t size() const { return codes_.size(); }
  bool contains(std::string_view word) const { return codes_.contains(word); }
  std::size_t numbers() const {
    return static_cast<std::size_t>(std::count_if(
        codes_.begin(), codes_.end(), [](const auto& word) { return parse_number(word.first).has_value(); }));
  }
  const std::string& first_in_order() const { return codes_.begin()->first; }

  std::string alike() const {
    std::vector<std::string_view> words;
    for (const auto& [word, code] : codes_) words.push_back(word);
    return apps::alike(words);
  }

  /// The words in order, numbers by their value, and for each code the place of its word.
  std::pair<std::vector<std::string>, std::vector<Code>> sorted() const {
    std::vector<std::string> words(codes_.size());
    for (const auto& [word, code] : codes_) words[code] = word;
    const bool numbers = std::ranges::all_of(words, [](const auto& word) { return parse_number(word).has_value(); });
    std::vector<std::size_t> order(words.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      if (numbers && *parse_number(words[a]) != *parse_number(words[b]))
        return *parse_number(words[a]) < *parse_number(words[b]);
      return words[a] < words[b];
    });
    std::vector<std::string> in_order;
    std::vector<Code> place(words.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      in_order.push_back(words[order[i]]);
      place[order[i]] = static_cast<Code>(i);
    }
    return {std::move(in_order), std::move(place)};
  }

 private:
  std::map<std::string, Code, std::less<>> codes_;
};

bool has_decimal_comma(std::string_view word) {
  std::string number(word);
  const auto comma = number.find(',');
  if (comma != std::string::npos) number[comma] = '.';
  return comma != std::string::npos && parse_number(number);
}

/// The word behind a number, as in "23.93 kg", or before it, as in "$12.50" or "<0.1"; or nothing.
std::string_view unit_of(std::string_view cell) {
  constexpr std::string_view of_numbers = "+-.,0123456789";
  const auto begin = std::min(cell.find_first_of(of_numbers), cell.size());
  const auto end = std::min(cell.find_first_not_of(of_numbers, begin), cell.size());
  const std::string_view before = trimmed(cell.substr(0, begin)), after = trimmed(cell.substr(end));
  const bool is_sign = std::ranges::none_of(before, [](unsigned char letter) { return std::isalpha(letter) != 0; });
  const bool alone = (before.empty() || after.empty()) && is_sign && after.find_first_of("0123456789") == after.npos;
  const std::string_view number = cell.substr(begin, end - begin);
  return alone && (parse_number(number) || has_decimal_comma(number)) ? (before.empty() ? after : before) : "";
}

/// Whether it says that a value is beyond what could be measured.
bool is_limit(std::string_view unit) { return unit == "<" || unit == ">" || unit == "≤" || unit == "≥"; }

/// A word among numbers, where it was found first.
struct Slip {
  std::size_t line;
  std::string word;
};

/// A cell as a number, NaN if it is none, and as a word, `missing_code` if it is none or there are too many.
struct DataCell {
  double number = nan;
  Code code = missing_code;
};

/// A column while it is read: numeric until a cell is not, and then the words are what counts.
class ColumnReader {
 public:
  ColumnReader(std::size_t index, bool categorical) : index_(index), categorical_(categorical) {}

  DataCell take(const CsvRow& row, const MissingWords& missing, Code its_class) {
    const std::string_view cell = trimmed(row[index_]);
    const bool empty = missing(cell);
    const auto number = empty ? std::nullopt : parse_number(cell);
    const bool is_word = !empty && !number && !missing.among_numbers(cell);
    if (number || is_word) ++cells_;
    if (number) {
      ++numeric_cells_;
      nines_.see(cell, *number);
      see_whole(*number);
      see_writing(cell);
    } else if (lower_case(cell) == "none" && !is_word) {
      ++nothings_;
    }
    counts_ = counts_ && number && *number == std::floor(*number) && *number > last_;
    last_ = number.value_or(last_);
    if (is_word && !slip_) slip_ = Slip{row.line(), std::string(cell)};
    if (is_word && has_decimal_comma(cell)) ++comma_cells_;
    if (const auto unit = is_word ? unit_of(cell) : ""; !unit.empty()) {
      ++(is_limit(unit) ? limit_cells_ : unit_cells_);
      if (!is_limit(unit) && units_.size() <= most_units) units_.code(unit);
    }
    DataCell result{number.value_or(nan)};
    if (too_many_words_) return result;
    if (!empty) {
      result.code = words_.code(cell);
      if (result.code == classes_.size()) classes_.push_back({its_class});
      ++(classes_[result.code].first == its_class ? classes_[result.code].same : classes_[result.code].others);
    }
    if (words_.size() <= most_values) return result;
    too_many_words_ = true;
    if (!could_be_numeric() && !nearly_all_numbers())
      throw row.error(index_, fmt::format("one of at most {} different values", most_values),
                      holds_units() ? "write the numbers without their unit" : "leave the column out by --ignore");
    return result;
  }

  /// Throws if the column is neither numbers nor words.
  void refuse_slip(const CsvReader& reader) const {
    if (categorical_ || !slip_ || !(too_many_words_ || nearly_all_numbers())) return;
    const std::string& name = reader.names()[index_];
    if (comma_cells_ > numeric_cells_)
      throw InputError(
          message({.where = fmt::format("{}:{}", reader.file(), slip_->line),
                   .what = fmt::format("column {}", in_quotes(name)),
                   .found = in_quotes(slip_->word),
                   .expected = fmt::format("no comma in a number, as {} of {} cells have", comma_cells_, cells_),
                   .remedy = "write a decimal comma as a point, and leave out one between thousands"}));
    if (is_limit(unit_of(slip_->word)))
      throw InputError(
          message({.where = fmt::format("{}:{}", reader.file(), slip_->line),
                   .what = fmt::format("column {}", in_quotes(name)),
                   .found = in_quotes(slip_->word),
                   .expected = fmt::format("a number, as {} of {} cells have", numeric_cells_, cells_),
                   .remedy = "write one for what is beyond a limit, as the limit itself; as a missing value it would "
                             "tell nothing"}));
    throw InputError(message(
        {.where = fmt::format("{}:{}", reader.file(), slip_->line),
         .what = fmt::format("column {}", in_quotes(name)),
         .found = in_quotes(slip_->word),
         .expected = fmt::format("a number with a decimal point, as {} of {} cells have", numeric_cells_, cells_),
         .remedy = fmt::format("correct it, name it by --missing={}, or take the column as words "
                               "by --categorical {}",
                               typed(slip_->word), typed(name))}));
  }

  /// Whether the name of the column looks like one of its cells.
  bool contains(std::string_view name) const {
    return is_numeric() ? parse_number(name).has_value() : words_.contains(trimmed(name));
  }

  /// What there is to see, if it is not two different values: "'red'", or "no value".
  std::string lone_value() const {
    if (too_many_words_ || words_.size() > 1) return "";
    return words_.size() == 0 ? "no value" : in_quotes(words_.first_in_order());
  }

  std::size_t filled() const { return cells_; }

  /// Whether it seems to name the rows: by words most of which stand once, or by whole numbers that rise.
  bool names_rows() const {
    if (cells_ < few_rows) return false;
    return is_numeric() ? counts_ || is_run()
                        : !too_many_words_ && !holds_units() && limit_cells_ == 0 && 2 * words_.size() > cells_;
  }

  /// Whether most cells, of more than a few different ones, are a number and one of few words.
  bool holds_units() const {
    constexpr std::size_t few_words = 8;
    return !categorical_ && words_.size() > few_words && 2 * unit_cells_ > cells_ && units_.size() <= most_units;
  }
  /// What the classes are of the rows that have the same value.
  struct ByValue {
    std::size_t values = 0, rows = 0, others = 0;  ///< rows of another class than the first of their value
    std::size_t changes = 0;                       ///< of the class, in the order of the values
    double log_chance = 0.0;                       ///< that so many rows are of one class with theirs
    bool numeric = false, whole = false;

    bool tells_all(std::size_t classes) const {
      const bool few = values < fewest_groups && rows >= 2 * values;
      return others == 0 && rows >= few_rows && values >= classes && (few || (numeric && changes + 1 == classes));
    }
    bool may_be_groups(std::size_t classes) const {
      constexpr double by_no_chance = -14.0;
      if (values < fewest_groups || values < 2 * classes || rows < 2 * values || log_chance > by_no_chance)
        return false;
      if (numeric && (!whole || 4 * changes < values)) return false;
      return others == 0 || (20 * others < rows && rows < 30 * values);
    }
    static constexpr std::size_t fewest_groups = 8;
  };
  ByValue by_value(const std::vector<std::size_t>& rows_of_class) const {
    if (too_many_words_) return {};
    ByValue result{.values = classes_.size(), .numeric = is_numeric(), .whole = whole_};
    const auto places = words_.sorted().second;
    std::vector<Code> in_order(classes_.size());
    const double all = std::accumulate(rows_of_class.begin(), rows_of_class.end(), 0.0);
    for (std::size_t code = 0; code < classes_.size(); ++code) {
      const auto& [first, same, others] = classes_[code];
      in_order[places[code]] = first;
      result.rows += same + others;
      result.others += others;
      double alike = 0.0;
      for (const std::size_t rows : rows_of_class)
        alike += std::pow(static_cast<double>(rows) / all, static_cast<double>(same));
      result.log_chance += std::log(alike);
    }
    for (std::size_t k = 1; k < in_order.size(); ++k) result.changes += in_order[k] != in_order[k - 1] ? 1U : 0U;
    return result;
  }

  /// A number with a point that may part thousands, since all others with a point have three digits behind it, and none
  /// without is a thousand or more; or nothing.
  std::string thousands() const {
    return is_numeric() && below_a_thousand_ > 0 && numeric_cells_ >= few_rows && !other_writing_ ? three_digits_ : "";
  }
  /// A number as 0387 of a column in which all are as long; or nothing.
  std::string code_with_zeros() const { return is_numeric() && lengths_.size() == 1 ? with_zeros_ : ""; }
  /// In how many cells "none" counts as missing, if in one of twenty.
  std::size_t nothings() const { return is_numeric() && 20 * nothings_ >= cells_ ? nothings_ : 0; }

  std::size_t limits() const { return limit_cells_; }
  std::string units() const { return fmt::format("{}", fmt::join(units_.sorted().first, ", ")); }

  const Nines& nines() const { return nines_; }

  bool is_numeric() const { return could_be_numeric() && numeric_cells_ > 0; }
  const Vocabulary& words() const { return words_; }
  std::size_t index() const { return index_; }

 private:
  static constexpr std::size_t most_units = 3;

  void see_whole(double number) {
    if (numeric_cells_ == 1) first_ = low_ = high_ = number;
    low_ = std::min(low_, number);
    high_ = std::max(high_, number);
    sum_ += number - first_;
    squares_ += (number - first_) * (number - first_);
    whole_ = whole_ && number == std::floor(number);
  }
  /// Whether the cells are whole numbers one after another, each once, in any order, by their sum and squares.
  bool is_run() const {
    const auto n = static_cast<double>(cells_);
    const double a = low_ - first_, sum = n * a + n * (n - 1) / 2;
    const double squares = n * a * a + a * n * (n - 1) + (n - 1) * n * (2 * n - 1) / 6;
    return whole_ && numeric_cells_ == cells_ && high_ - low_ + 1 == n &&
           std::abs(sum_ - sum) <= 1e-9 * std::abs(sum) && std::abs(squares_ - squares) <= 1e-9 * squares;
  }

  void see_writing(std::string_view cell) {
    const auto point = cell.find('.');
    const std::size_t digits = point == cell.npos ? cell.size() : point;
    const bool is_plain = cell.find_first_not_of(".0123456789") == cell.npos;
    const bool parts = point != cell.npos && cell.size() - point == 4 && digits <= 3 && cell[0] != '0';
    if (parts && three_digits_.empty()) three_digits_ = cell;
    if (point == cell.npos && digits <= 3) ++below_a_thousand_;
    other_writing_ = other_writing_ || !is_plain || !(parts || (point == cell.npos && digits <= 3));
    if (lengths_.size() < 2) lengths_.insert(is_plain && point == cell.npos ? cell.size() : 0);
    if (with_zeros_.empty() && digits >= 3 && cell[0] == '0') with_zeros_ = cell;
  }

  bool could_be_numeric() const { return !categorical_ && !slip_; }
  /// Nine of ten cells, be it with a decimal comma, or half of them where there are more numbers than words would have.
  bool nearly_all_numbers() const {
    constexpr std::size_t most_words = 20;
    if (10 * (numeric_cells_ + comma_cells_) >= 9 * cells_) return true;
    return 2 * numeric_cells_ >= cells_ && words_.numbers() > most_words;
  }

  std::size_t index_;
  bool categorical_;
  std::optional<Slip> slip_;
  std::size_t cells_ = 0;  // with a number, or a word that does not stand for a missing one
  std::size_t numeric_cells_ = 0;
  std::size_t comma_cells_ = 0;
  std::size_t unit_cells_ = 0, limit_cells_ = 0;
  bool whole_ = true;  // all numbers are
  double first_ = 0.0, low_ = 0.0, high_ = 0.0;
  double sum_ = 0.0, squares_ = 0.0;  // of the distances from the first
  Nines nines_;
  std::string three_digits_, with_zeros_;  // the first of these
  std::size_t below_a_thousand_ = 0, nothings_ = 0;
  bool other_writing_ = false;
  std::set<std::size_t> lengths_;  // of whole numbers, 0 of others, up to two
  struct ClassesOfValue {
    Code first;
    std::size_t same = 0, others = 0;  // rows of that class, and of others
  };
  std::vector<ClassesOfValue> classes_;  // by code
  bool counts_ = true;                   // so far, in whole numbers upwards
  double last_ = -std::numeric_limits<double>::infinity();
  bool too_many_words_ = false;
  Vocabulary words_, units_;
};

/// Columns with their lone values, all at once: throws if there is such a one.
void refuse_useless(const CsvReader& reader, const std::vector<ColumnReader>& columns, std::size_t rows) {
  std::vector<std::string> found, names;
  bool gaps = false;
  for (const ColumnReader& column : columns) {
    const std::string value = column.lone_value();
    if (value.empty()) continue;
    names.push_back(typed(reader.names()[column.index()]));
    const std::size_t empty = rows - column.filled();
    gaps = gaps || (0 < empty && empty < rows);
    found.push_back(fmt::format("{} in column {}{}", value, in_quotes(reader.names()[column.index()]),
                                empty > 0 && empty < rows ? fmt::format(" (and no value in {} rows)", empty) : ""));
  }
  if (names.empty()) return;
  throw InputError(
      message({.where = reader.file(),
               .found = fmt::format("{}, in all of {} rows", fmt::join(found, ", "), rows),
               .expected = "at least two different values",
               .remedy = fmt::format("{}leave out what never changes by --ignore {}",
                                     gaps ? "if an empty cell says no, write no; else " : "", fmt::join(names, ","))}));
}

/// What a reader of the results should know of the file.
std::vector<std::string> warnings_of(const CsvReader& reader, const std::vector<ColumnReader>& columns,
                                     const DataTable& table, const Vocabulary& classes) {
  std::vector<std::string> warnings;
  const auto warn_of_alike = [&](const std::string& column, const Vocabulary& words) {
    if (const std::string alike = words.alike(); !alike.empty())
      warnings.push_back(fmt::format(
          "{}: column {}: {} differ in case, blanks or the writing of a number only, and count as two; write "
          "them alike, if they are the same",
          reader.file(), in_quotes(column), alike));
  };
  warn_of_alike(table.label, classes);
  for (const ColumnReader& column : columns)
    if (!column.is_numeric()) warn_of_alike(reader.names()[column.index()], column.words());
  if (2 * table.classes.size() > table.size() && table.size() >= few_rows)
    warnings.push_back(
        fmt::format("{}: column {} has {} classes in {} rows: of most there is a single row, from which nothing can be "
                    "learned; is it the right --label?",
                    reader.file(), in_quotes(table.label), table.classes.size(), table.size()));
  std::vector<std::string> lone;
  for (std::size_t k = 0; k < table.classes.size(); ++k)
    if (table.rows_of_class[k] == 1) lone.push_back(table.classes[k]);
  if (!lone.empty() && table.size() >= few_rows && 2 * table.classes.size() <= table.size())
    warnings.push_back(
        fmt::format("{}: column {}: a single row is of {}: is it a slip of writing? From one row nothing "
                    "can be learned",
                    reader.file(), in_quotes(table.label), listed(lone, 12)));
  for (std::size_t k = 0; k < table.classes.size(); ++k)
    if (constexpr std::array words = {"-", "--", "na", "n/a", "#n/a", "nan", "null", "unknown"};
        std::ranges::find(words, lower_case(table.classes[k])) != words.end())
      warnings.push_back(fmt::format(
          "{}: column {}: {} of {} rows hold {}, which counts as a class: if their class is not known, remove them",
          reader.file(), in_quotes(table.label), table.rows_of_class[k], table.size(), in_quotes(table.classes[k])));
  for (const ColumnReader& column : columns)
    if (column.holds_units())
      warnings.push_back(
          fmt::format("{}: column {} holds numbers with a unit ({}), which count as words: write the numbers alone, "
                      "all in one unit, and the unit into the name of the column",
                      reader.file(), in_quotes(reader.names()[column.index()]), column.units()));
  for (const ColumnReader& column : columns)
    if (column.limits() > 0 && !column.is_numeric() && column.words().numbers() > 1)
      warnings.push_back(fmt::format(
          "{}: column {} holds numbers and {} limits, as <0.1, and all count as words: write a number for what is "
          "beyond a limit, as the limit itself",
          reader.file(), in_quotes(reader.names()[column.index()]), column.limits()));
  for (const ColumnReader& column : columns)
    if (const std::string nines = column.nines().doubt(reader.names()[column.index()]);
        !nines.empty() && column.is_numeric())
      warnings.push_back(reader.file() + ": " + nines);
  for (const ColumnReader& column : columns)
    if (column.names_rows())
      warnings.push_back(fmt::format(
          "{0}: column {1} seems to name the rows, or to count them, and tells nothing of others, unless they "
          "are in its order; leave it out by --ignore {2}",
          reader.file(), in_quotes(reader.names()[column.index()]), typed(reader.names()[column.index()])));
  std::vector<std::string> like_cells;
  for (const ColumnReader& column : columns)
    if (column.contains(reader.names()[column.index()]))
      like_cells.push_back(in_quotes(reader.names()[column.index()]));
  if (2 * like_cells.size() > columns.size() && classes.contains(table.label))
    warnings.push_back(
        fmt::format("{}: the first row looks like data ({}): it was taken for the names of the columns, "
                    "and is not counted; put a row of names above it",
                    reader.file(), fmt::join(like_cells, ", ")));
  for (std::size_t i = 0; i < reader.names().size(); ++i)
    if (reader.names()[i].empty())
      warnings.push_back(fmt::format("{}: column {} has no name and is left out", reader.file(), i + 1));
  return warnings;
}

/// The rows that differ, of long tables some chosen by hash, and how many rows they are with their copies.
struct DistinctRows {
  /// Of each the number or code by column, NaN where it is missing, and the class.
  std::vector<std::vector<double>> cells;
  std::size_t with_copies = 0;
  std::map<double, std::pair<std::size_t, std::size_t>> of_class;  ///< how many differ, and with their copies

  explicit DistinctRows(const DataTable& table) {
    constexpr std::size_t most = 1024;
    std::map<std::size_t, std::pair<std::vector<double>, std::size_t>> found;  // by hash, the least, and how often
    std::vector<double> row_cells;
    table.for_each([&](const DataRow& row) {
      row_cells.clear();
      for (std::size_t i = 0; i < table.columns.size(); ++i)
        row_cells.push_back(table.columns[i].numeric ? row.number(i) : row.code(i) == missing_code ? nan : row.code(i));
      row_cells.push_back(static_cast<double>(row.label()));
      const auto hash = std::hash<std::string_view>{}(
          {reinterpret_cast<const char*>(row_cells.data()), row_cells.size() * sizeof(double)});
      if (found.size() == most && hash > found.rbegin()->first) return;
      ++found.try_emplace(hash, row_cells, 0).first->second.second;
      if (found.size() > most) found.erase(std::prev(found.end()));
    });
    for (auto& [hash, row] : found) {
      auto& [differ, all] = of_class[row.first.back()];
      ++differ, all += row.second;
      cells.push_back(std::move(row.first));
      with_copies += row.second;
    }
  }

  /// Whether each value of one column stands beside one of another only, and the other way.
  bool one_to_one(std::size_t a, std::size_t b) const {
    std::map<double, double> to, from;
    std::size_t known = 0;
    for (const auto& row : cells) {
      if (std::isnan(row[a]) || std::isnan(row[b])) continue;
      ++known;
      if (to.emplace(row[a], row[b]).first->second != row[b] || from.emplace(row[b], row[a]).first->second != row[a])
        return false;
    }
    return known >= few_rows && to.size() > 1 && 3 * to.size() < 2 * known;
  }

  /// Twice the place of each cell of a column when sorted, the same for equal ones; -1 where it is missing.
  std::vector<double> ranks(std::size_t column) const {
    std::vector<double> sorted, result;
    for (const auto& row : cells)
      if (!std::isnan(row[column])) sorted.push_back(row[column]);
    std::ranges::sort(sorted);
    for (const auto& row : cells) {
      const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), row[column]);
      const auto place = static_cast<double>((first - sorted.begin()) + (last - sorted.begin()));
      result.push_back(std::isnan(row[column]) ? -1.0 : place);
    }
    return result;
  }
};

/// Whether two columns put the rows in the same order, or the opposite one, but for what rounding does.
bool same_order(const std::vector<double>& a, const std::vector<double>& b) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] >= 0.0 && b[i] >= 0.0) {
      ++n, x += a[i], y += b[i];
      xx += a[i] * a[i], yy += b[i] * b[i], xy += a[i] * b[i];
    }
  constexpr double nearly_one = 0.999;
  const double both = n * xy - x * y;
  return n >= few_rows && both * both > nearly_one * (n * xx - x * x) * (n * yy - y * y);
}

/// What the rows and the columns tell twice; whether half of the rows do.
bool warn_of_repeats(DataTable& table) {
  const DistinctRows rows(table);
  const std::size_t size = rows.cells.size();
  if (size < few_rows) return false;
  std::vector<std::vector<double>> ranks;
  std::vector<bool> comparable;  // by their order
  std::size_t fine = 0;          // columns that most of these rows differ in, as they would not by chance
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    ranks.push_back(rows.ranks(i));
    const std::size_t different = std::set(ranks[i].begin(), ranks[i].end()).size();
    fine += 2 * different > size ? 1U : 0U;
    comparable.push_back(table.columns[i].numeric && different >= 4);
  }
  const auto warn_of_copies = [&](const std::string& which, std::size_t differ, std::size_t all) {
    table.warnings.push_back(
        fmt::format("{}: {:.0f} % of {} repeat another, label included: what is learned from one is asked of its "
                    "copy, so the shares of right answers are too good; drop the copies",
                    table.file, 100.0 - 100.0 * static_cast<double>(differ) / static_cast<double>(all), which));
  };
  const bool all_of_them = fine >= 2 && rows.with_copies >= 2 * size;
  if (all_of_them) warn_of_copies(fmt::format("{} rows", table.size()), size, rows.with_copies);
  for (const auto& [label, counts] : rows.of_class)
    if (const auto [differ, all] = counts; fine >= 2 && !all_of_them && all >= few_rows && all >= 2 * differ)
      warn_of_copies(fmt::format("the rows of class {}", in_quotes(table.classes[static_cast<std::size_t>(label)])),
                     differ, all);
  std::vector<bool> repeated(ranks.size());  // an earlier column
  const auto says_the_same = [&](std::size_t i, std::size_t j) {
    if (repeated[i] || repeated[j]) return false;
    return comparable[i] && comparable[j] ? same_order(ranks[i], ranks[j]) : rows.one_to_one(i, j);
  };
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    std::vector<std::string> others;
    for (std::size_t j = i + 1; j < ranks.size(); ++j)
      if (says_the_same(i, j)) {
        repeated[j] = true;
        others.push_back(typed(table.columns[j].name));
      }
    if (!others.empty())
      table.warnings.push_back(
          fmt::format("{0}: column {1} says the same as {2}, as if in another unit or in other words: it counts {3} "
                      "times; leave the others out by --ignore {2}",
                      table.file, in_quotes(table.columns[i].name), fmt::join(others, ","), others.size() + 1));
  }
  return all_of_them;
}

/// Whether a row holds the names of the columns, the first one perhaps behind a byte order mark, as where files were
/// joined.
bool is_header(const CsvRow& row, const CsvReader& reader) {
  for (std::size_t i = 1; i < row.size(); ++i)
    if (trimmed(row[i]) != reader.names()[i]) return false;
  return trimmed(row[0]).ends_with(reader.names()[0]);
}

/// What the values of a column tell, and how they are written.
void warn_of_values(const std::vector<ColumnReader>& columns, bool copies, DataTable& table) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& name = table.columns[i].name;
    const auto by_value = columns[i].by_value(table.rows_of_class);
    if (by_value.tells_all(table.classes.size()))
      table.warnings.push_back(
          fmt::format("{}: column {} alone tells the class of each row: if it is not known before the class is, leave "
                      "it out by --ignore {}",
                      table.file, in_quotes(name), typed(name)));
    else if (!copies && by_value.may_be_groups(table.classes.size()))
      table.warnings.push_back(fmt::format(
          "{0}: each of {1} values of column {2}, of {3:.2g} rows on the average, is of one class only{5}: if it "
          "names what rows are of, as a patient or a session, these are parted by the folds, and the shares of "
          "right answers are too good for others; leave it out by --ignore {4}, and ask of others by classify",
          table.file, by_value.values, in_quotes(name),
          static_cast<double>(by_value.rows) / static_cast<double>(by_value.values), typed(name),
          by_value.others == 0 ? "" : fmt::format(", but for {} of them", by_value.others)));
    if (const std::string thousands = columns[i].thousands(); !thousands.empty())
      table.warnings.push_back(
          fmt::format("{}: column {}: every number with a point has three digits behind it, as {}, and all others are "
                      "below a thousand: if the point parts thousands, leave it out",
                      table.file, in_quotes(name), thousands));
    if (const std::string code = columns[i].code_with_zeros(); !code.empty())
      table.warnings.push_back(
          fmt::format("{}: column {} holds codes, as {}, that are read as numbers: if their order tells "
                      "nothing, give --categorical {}",
                      table.file, in_quotes(name), code, typed(name)));
    if (const std::size_t cells = columns[i].nothings(); cells > 0)
      table.warnings.push_back(
          fmt::format("{}: column {}: {} cells are 'none', which counts as missing among numbers: if it "
                      "says zero, write 0",
                      table.file, in_quotes(name), cells));
  }
}

std::vector<ColumnReader> columns_of(const CsvReader& reader, const DataOptions& options, std::size_t label) {
  std::set<std::size_t> left_out = {label}, categorical;
  for (const auto& name : options.ignore) left_out.insert(reader.column(name));
  const bool all_categorical = options.categorical == std::vector<std::string>{"all"};
  if (!all_categorical)
    for (const auto& name : options.categorical) categorical.insert(reader.column(name));
  std::vector<ColumnReader> columns;
  for (std::size_t i = 0; i < reader.names().size(); ++i)
    if (!left_out.contains(i) && !reader.names()[i].empty())
      columns.emplace_back(i, all_categorical || categorical.contains(i));
  if (columns.empty())
    throw InputError("{}: there is no column beside {}: expected one with a feature", reader.file(),
                     in_quotes(options.label));
  return columns;
}

}  // namespace

MissingWords::MissingWords(std::vector<std::string> more) : more_(std::move(more)) {}

bool MissingWords::operator()(std::string_view cell) const {
  const std::string_view text = trimmed(cell);
  return text.empty() || text == "?" || std::ranges::find(more_, text) != more_.end();
}

bool MissingWords::among_numbers(std::string_view cell) const {
  constexpr std::array<std::string_view, 15> words = {"-",    "--",   "na",       "n/a",       "#n/a",
                                                      "nan",  "null", "none",     "nil",       "inf",
                                                      "-inf", "+inf", "infinity", "-infinity", "."};
  if (operator()(cell)) return true;
  const std::string text = lower_case(trimmed(cell));
  return std::ranges::find(words, text) != words.end();
}

DataTable read_data(const std::string& file, const DataOptions& options, bool quiet) {
  CsvReader reader = open_csv(file);
  const std::size_t label = reader.column(options.label);
  const MissingWords missing(options.missing);
  auto columns = columns_of(reader, options, label);

  DataTable table;
  table.file = reader.file();
  table.label = options.label;
  Vocabulary classes;
  std::vector<std::size_t> rows_of, last_line_of;  // by class, as they come
  std::size_t first_line = 0;
  for (const auto& column : columns) table.columns.push_back({.name = reader.names()[column.index()]});
  Progress progress("reading", reader.bytes_total().value_or(0), quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row);) {
    progress.advance(reader.bytes_read() - progress.done());
    if (trimmed(row[label]) == options.label && is_header(row, reader))
      throw row.error(label, "the name of a class, and not the header again", "drop the line");
    if (missing(row[label])) throw row.error(label, "the name of a class", "fill the cell or remove the row");
    const Code code = classes.code(trimmed(row[label]));
    if (classes.size() > most_values)
      throw row.error(label, fmt::format("one of at most {} classes", most_values), "choose another --label");
    rows_of.resize(classes.size());
    last_line_of.resize(classes.size());
    ++rows_of[code];
    last_line_of[code] = row.line();
    if (first_line == 0) first_line = row.line();
    table.cells_.push_back(code);
    table.cells_.push_back(static_cast<double>(row.line()));
    for (ColumnReader& column : columns) {
      const DataCell cell = column.take(row, missing, code);
      table.cells_.push_back(cell.number);
      table.cells_.push_back(cell.code);
    }
  }
  progress.finish();
  if (table.size() == 0) throw InputError("{}: there is no row below the header", reader.file());
  std::tie(table.classes, table.class_order_) = classes.sorted();
  if (table.classes.size() == 1)
    throw InputError(
        message({.where = fmt::format("{}:{}", reader.file(), first_line),
                 .what = fmt::format("column {}", in_quotes(options.label)),
                 .found = fmt::format("{} in all of {} rows", in_quotes(table.classes.front()), table.size()),
                 .expected = "at least two classes"}));
  table.rows_of_class.resize(rows_of.size());
  table.last_line_of_class.resize(rows_of.size());
  for (std::size_t code = 0; code < rows_of.size(); ++code) {
    table.rows_of_class[table.class_order_[code]] = rows_of[code];
    table.last_line_of_class[table.class_order_[code]] = last_line_of[code];
  }
  for (const auto& column : columns) column.refuse_slip(reader);
  refuse_useless(reader, columns, table.size());
  table.warnings = warnings_of(reader, columns, table, classes);
  table.value_order_.resize(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    table.columns[i].numeric = columns[i].is_numeric();
    if (!columns[i].is_numeric())
      std::tie(table.columns[i].values, table.value_order_[i]) = columns[i].words().sorted();
  }
  warn_of_values(columns, warn_of_repeats(table), table);
  return table;
}

}  // namespace sigmax::apps
