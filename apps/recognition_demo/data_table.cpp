#include "recognition_demo/data_table.hpp"

#include <array>
#include <map>
#include <set>
#include <tuple>

#include "shell/progress.hpp"
#include "shell/text.hpp"

namespace sigmax::apps {
namespace {

/// Words beyond this many are names of things, not values of a feature.
constexpr std::size_t most_values = 4096;

/// Words numbered as they come.
struct Vocabulary {
  std::map<std::string, Code, std::less<>> codes;

  Code code(std::string_view word) {
    const auto found = codes.find(word);
    if (found != codes.end()) return found->second;
    return codes.emplace(std::string(word), static_cast<Code>(codes.size())).first->second;
  }
  std::size_t size() const { return codes.size(); }
  std::size_t numbers() const {
    const auto is_number = [](const auto& word) { return parse_number(word.first).has_value(); };
    return static_cast<std::size_t>(std::ranges::count_if(codes, is_number));
  }

  /// The words in order, numbers first and by their value, and for each code the place of its word.
  std::pair<std::vector<std::string>, std::vector<Code>> sorted() const {
    std::vector<std::tuple<double, std::string, Code>> order;  // by value, words behind all numbers
    for (const auto& [word, code] : codes) order.emplace_back(parse_number(word).value_or(infinity), word, code);
    std::ranges::sort(order);
    std::vector<std::string> words;
    std::vector<Code> places(order.size());
    for (const auto& [number, word, code] : order) {
      places[code] = static_cast<Code>(words.size());
      words.push_back(word);
    }
    return {std::move(words), std::move(places)};
  }
};

/// A column while it is read: numeric until a cell is not, and then the words are what counts.
class ColumnReader {
 public:
  /// The column with this place in the file.
  ColumnReader(std::size_t index, DataColumn column, bool categorical)
      : index_(index), column_(std::move(column)), categorical_(categorical) {}

  void take(const CsvRow& row, MissingWords& missing) {
    const std::string_view cell = trimmed(row[index_]);
    const bool empty = missing(cell);
    const auto number = empty ? std::nullopt : parse_number(cell);
    const bool is_word = !empty && !number && !missing.among_numbers(cell);
    cells_ += number || is_word ? 1U : 0U;
    numeric_cells_ += number ? 1U : 0U;
    comma_cells_ += is_word && has_decimal_comma(cell) ? 1U : 0U;
    if (is_word && !slip_) slip_ = Slip{row.line(), std::string(cell)};
    column_.numbers.push_back(number.value_or(nan));
    if (too_many_words_) return;
    column_.codes.push_back(empty ? missing_code : words_.code(cell));
    too_many_words_ = words_.size() > most_values;
    if (too_many_words_ && !could_be_numeric() && !nearly_all_numbers())
      throw row.error(index_, fmt::format("one of at most {} different values", most_values),
                      "leave the column out by --ignore " + typed(column_.name));
  }

  /// The column with its cells. Throws if these are neither numbers nor words.
  DataColumn finished(const std::string& file) {
    refuse_slip(file);
    column_.numeric = could_be_numeric() && numeric_cells_ > 0;
    if (column_.numeric) {
      column_.codes = {};
      return std::move(column_);
    }
    column_.numbers = {};
    std::vector<Code> places;
    std::tie(column_.values, places) = words_.sorted();
    for (Code& code : column_.codes)
      if (code != missing_code) code = places[code];
    return std::move(column_);
  }

  const std::string& name() const { return column_.name; }

  /// What there is to see, if it is the same everywhere: "'red'", or "no value".
  std::string lone_value() const {
    const bool has_gaps = column_.missing_is_value && cells_ < column_.numbers.size();
    if (too_many_words_ || words_.size() + (has_gaps ? 1U : 0U) > 1) return "";
    return words_.size() == 0 ? "no value" : in_quotes(words_.codes.begin()->first);
  }

 private:
  bool could_be_numeric() const { return !categorical_ && !slip_; }

  /// Nine of ten cells, be it with a decimal comma, or half of them where there are more numbers than words would have.
  bool nearly_all_numbers() const {
    constexpr std::size_t most_words = 20;
    return 10 * (numeric_cells_ + comma_cells_) >= 9 * cells_ ||
           (2 * numeric_cells_ >= cells_ && words_.numbers() > most_words);
  }

  void refuse_slip(const std::string& file) const {
    if (categorical_ || !slip_ || !(too_many_words_ || nearly_all_numbers())) return;
    const bool commas = comma_cells_ > numeric_cells_;
    throw InputError(
        {.where = fmt::format("{}:{}", file, slip_->line),
         .what = fmt::format("column {}", in_quotes(column_.name)),
         .found = in_quotes(slip_->word),
         .expected = fmt::format("a number with a decimal point, as {} of {} cells have", numeric_cells_, cells_),
         .remedy = commas ? "write a decimal comma as a point"
                          : fmt::format("correct it, name it by --missing={}, or take the column as words by "
                                        "--categorical {}",
                                        typed(slip_->word), typed(column_.name))});
  }

  /// A word among numbers, where it was found first.
  struct Slip {
    std::size_t line;
    std::string word;
  };

  std::size_t index_;
  DataColumn column_;
  bool categorical_;
  std::optional<Slip> slip_;
  std::size_t cells_ = 0, numeric_cells_ = 0, comma_cells_ = 0;
  bool too_many_words_ = false;
  Vocabulary words_;
};

/// Whether a row holds the names of the columns, the first one perhaps behind a byte order mark, as where files were
/// joined.
bool is_header(const CsvRow& row, const CsvReader& reader) {
  for (std::size_t i = 1; i < row.size(); ++i)
    if (trimmed(row[i]) != reader.names()[i]) return false;
  return trimmed(row[0]).ends_with(reader.names()[0]);
}

std::vector<ColumnReader> columns_of(const CsvReader& reader, const DataOptions& options, DataTable& table) {
  const auto places = [&](const std::vector<std::string>& names) {
    const auto all = each(names, [&](const std::string& name) { return reader.column(name); });
    return std::set(all.begin(), all.end());
  };
  const bool all_categorical = options.categorical == std::vector<std::string>{"all"};
  const auto left_out = places(options.ignore), own_value = places(options.missing_value),
             categorical = all_categorical ? std::set<std::size_t>() : places(options.categorical);
  std::vector<ColumnReader> columns;
  for (std::size_t i = 0; i < reader.names().size(); ++i)
    if (const std::string& name = reader.names()[i]; name.empty())
      table.notes.push_back(fmt::format("column {} has no name and is left out", i + 1));
    else if (name != options.label && !left_out.contains(i))
      columns.emplace_back(i, DataColumn{.name = name, .missing_is_value = own_value.contains(i)},
                           all_categorical || categorical.contains(i));
  if (columns.empty())
    throw InputError("{}: there is no column beside {}: expected one with a feature", table.file,
                     in_quotes(table.label));
  return columns;
}

/// The class of a row.
std::string_view class_in(const CsvRow& row, std::size_t label, const CsvReader& reader, MissingWords& missing) {
  if (trimmed(row[label]) == reader.names()[label] && is_header(row, reader))
    throw row.error(label, "the name of a class, and not the header again", "drop the line");
  if (missing(row[label]))
    throw row.error(label, "the name of a class",
                    row.blank(label) ? "fill the cell or remove the row"
                                     : "which --missing says to be none: fill the cell, or remove the row");
  return trimmed(row[label]);
}

/// Takes the columns that were read, but for those with the same value everywhere.
void take_columns(std::vector<ColumnReader>& columns, DataTable& table) {
  for (ColumnReader& column : columns)
    if (const std::string value = column.lone_value(); value.empty())
      table.columns.push_back(column.finished(table.file));
    else
      table.notes.push_back(fmt::format("column {} holds {} in all of {} rows and is left out",
                                        in_quotes(column.name()), value, table.size()));
  if (table.columns.empty())
    throw InputError("{}: found the same value in all {} rows of each column beside {}, expected a column that differs",
                     table.file, table.size(), in_quotes(table.label));
  for (const DataColumn& column : table.columns)
    if (column.missing_is_value && std::ranges::find(column.values, "missing") != column.values.end())
      throw InputError(
          "{}: column {}: found 'missing' among its words, expected another name of a value beside "
          "--missing-value; give --missing=missing",
          table.file, in_quotes(column.name));
}

}  // namespace

bool has_decimal_comma(std::string_view word) {
  std::string number(word);
  const auto comma = number.find(',');
  if (comma != std::string::npos) number[comma] = '.';
  return comma != std::string::npos && parse_number(number);
}

bool says_unknown(std::string_view word) {
  constexpr std::array words = {"na", "n/a", "n.a.", "#n/a", "<na>", "nan", "nat", "null", "(null)", "\\n", "#div/0!"};
  return std::ranges::find(words, lower_case(word)) != words.end();
}

MissingWords::MissingWords(const std::vector<std::string>& more) {
  for (const auto& text : more) more_.push_back({text, parse_number(text)});
}

bool MissingWords::operator()(std::string_view cell) {
  const std::string_view text = trimmed(cell);
  if (text.empty() || text == "?") return true;
  for (Word& word : more_)
    if (word.text == text || (word.number && word.number == parse_number(text))) return word.met = true;
  return false;
}

std::vector<std::string> MissingWords::unmet() const {
  if (std::ranges::any_of(more_, &Word::met)) return {};
  return each(more_, [](const Word& word) { return in_quotes(word.text); });
}

bool MissingWords::among_numbers(std::string_view cell) {
  constexpr std::array words = {"-", "--", ".", "none", "nil", "inf", "-inf", "+inf", "infinity", "-infinity"};
  if (operator()(cell) || says_unknown(trimmed(cell))) return true;
  return std::ranges::find(words, lower_case(trimmed(cell))) != words.end();
}

DataTable read_data(const std::string& file, const DataOptions& options, bool quiet) {
  CsvReader reader = open_csv(file);
  const std::size_t label = reader.column(options.label);
  DataTable table{.file = reader.file(), .label = options.label};
  MissingWords missing(options.missing);
  auto columns = columns_of(reader, options, table);
  Vocabulary classes;
  Progress progress("reading", reader.bytes_total().value_or(0), quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row);) {
    progress.advance(reader.bytes_read() - progress.done());
    table.labels.push_back(classes.code(class_in(row, label, reader, missing)));
    table.lines.push_back(static_cast<std::uint32_t>(row.line()));
    if (classes.size() > most_values)
      throw row.error(label, fmt::format("one of at most {} classes", most_values), "choose another --label");
    for (ColumnReader& column : columns) column.take(row, missing);
  }
  progress.finish();
  if (table.size() == 0) throw InputError("{}: there is no row below the header", table.file);
  std::vector<Code> places;
  std::tie(table.classes, places) = classes.sorted();
  if (table.classes.size() == 1)
    throw InputError({.where = fmt::format("{}:{}", table.file, table.lines.front()),
                      .what = fmt::format("column {}", in_quotes(options.label)),
                      .found = fmt::format("{} in all of {} rows", in_quotes(table.classes.front()), table.size()),
                      .expected = "at least two classes"});
  table.rows_of_class.resize(table.classes.size());
  for (std::size_t& its_class : table.labels) ++table.rows_of_class[its_class = places[its_class]];
  take_columns(columns, table);
  if (const auto unmet = missing.unmet(); !unmet.empty())
    table.notes.push_back(fmt::format("no cell is {}, as --missing says; capitals count", fmt::join(unmet, " or ")));
  return table;
}

}  // namespace sigmax::apps
