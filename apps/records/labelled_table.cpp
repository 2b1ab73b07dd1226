#include "records/labelled_table.hpp"

#include <array>
#include <set>
#include <tuple>

#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

/// Words beyond this many are names of things, not values of a feature.
constexpr std::size_t most_values = 4096;

/// A column while it is read: numeric until a cell is not, and then the words are what counts.
class ColumnReader {
 public:
  /// The column with this place in the file.
  ColumnReader(std::size_t index, std::string name, bool categorical, bool missing_is_value)
      : index_(index), name_(std::move(name)), categorical_(categorical), missing_is_value_(missing_is_value) {}

  void take(const CsvRow& row, const MissingWords& missing) {
    const std::string_view cell = trimmed(row[index_]);
    const bool empty = missing(cell);
    const auto number = empty ? std::nullopt : parse_number(cell);
    const bool is_word = !empty && !number && !missing.among_numbers(cell);
    cells_ += number || is_word ? 1U : 0U;
    numeric_cells_ += number ? 1U : 0U;
    comma_cells_ += is_word && has_decimal_comma(cell) ? 1U : 0U;
    if (is_word && !slip_) slip_ = {row.line(), std::string(cell)};
    numbers_.push_back(number.value_or(nan));
    if (too_many_words_) return;
    words_.push_back(empty ? nan : static_cast<double>(vocabulary_.number(cell)));
    too_many_words_ = vocabulary_.size() > most_values;
    if (too_many_words_ && (categorical_ || (slip_ && !nearly_all_numbers())))
      throw row.error(index_, fmt::format("one of at most {} different values", most_values),
                      "leave the column out by --ignore " + typed(name_));
  }

  /// Adds the column to the table, or a note if it is the same everywhere. Throws if its cells are neither numbers nor
  /// words.
  void finish(LabelledTable& table) {
    const bool has_gaps = missing_is_value_ && cells_ < numbers_.size();
    if (!too_many_words_ && vocabulary_.size() + (has_gaps ? 1U : 0U) <= 1) {
      const auto value = vocabulary_.size() == 0 ? "no value" : in_quotes(vocabulary_.sorted().first.front());
      table.notes.push_back(
          fmt::format("column {} holds {} in all of {} rows and is left out", in_quotes(name_), value, table.size()));
      return;
    }
    refuse_slip(table.file);
    TableColumn column = could_be_numeric() && numeric_cells_ > 0 ? TableColumn(name_, std::move(numbers_))
                                                                  : TableColumn(name_, vocabulary_, std::move(words_));
    column.missing_is_value = missing_is_value_;
    if (missing_is_value_ && std::ranges::find(column.words, "missing") != column.words.end())
      throw InputError(
          "{}: column {}: found 'missing' among its words, expected another name of a value beside --missing-value; "
          "give --missing=missing",
          table.file, in_quotes(name_));
    table.columns.push_back(std::move(column));
  }

 private:
  bool could_be_numeric() const { return !categorical_ && !slip_; }

  /// Nine of ten cells, be it with a decimal comma, or half of them where there are more numbers than words would have.
  bool nearly_all_numbers() const {
    constexpr std::ptrdiff_t most_words = 20;
    const auto is_number = [](const std::string& word) { return parse_number(word).has_value(); };
    return 10 * (numeric_cells_ + comma_cells_) >= 9 * cells_ ||
           (2 * numeric_cells_ >= cells_ && std::ranges::count_if(vocabulary_.sorted().first, is_number) > most_words);
  }

  void refuse_slip(const std::string& file) const {
    if (categorical_ || !slip_ || !(too_many_words_ || nearly_all_numbers())) return;
    const auto& [line, word] = *slip_;
    throw InputError(
        {.where = fmt::format("{}:{}", file, line),
         .what = fmt::format("column {}", in_quotes(name_)),
         .found = in_quotes(word),
         .expected = fmt::format("a number with a decimal point, as {} of {} cells have", numeric_cells_, cells_),
         .remedy = comma_cells_ > numeric_cells_
                       ? "write a decimal comma as a point"
                       : fmt::format("correct it, name it by --missing={}, or take the column as words by "
                                     "--categorical {}",
                                     typed(word), typed(name_))});
  }

  std::size_t index_;
  std::string name_;
  bool categorical_, missing_is_value_;
  std::optional<std::pair<std::size_t, std::string>> slip_;  // a word among numbers, where it was found first
  std::size_t cells_ = 0, numeric_cells_ = 0, comma_cells_ = 0;
  bool too_many_words_ = false;
  std::vector<double> numbers_, words_;
  Vocabulary vocabulary_;
};

/// Whether a row holds the names of the columns, the first one perhaps behind a byte order mark, as where files were
/// joined.
bool is_header(const CsvRow& row, const CsvReader& reader) {
  for (std::size_t i = 1; i < row.size(); ++i)
    if (trimmed(row[i]) != reader.names()[i]) return false;
  return trimmed(row[0]).ends_with(reader.names()[0]);
}

std::vector<ColumnReader> columns_of(const CsvReader& reader, const TableReading& options, LabelledTable& table) {
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
    else if (name != options.label && name != options.groups && !left_out.contains(i))
      columns.emplace_back(i, name, all_categorical || categorical.contains(i), own_value.contains(i));
  if (columns.empty())
    throw InputError("{}: there is no column beside {}: expected one with a feature", table.file,
                     in_quotes(table.label));
  return columns;
}

/// The class of a row.
std::string_view class_in(const CsvRow& row, std::size_t label, const CsvReader& reader, const MissingWords& missing) {
  if (trimmed(row[label]) == reader.names()[label] && is_header(row, reader))
    throw row.error(label, "the name of a class, and not the header again", "drop the line");
  if (missing(row[label]))
    throw row.error(label, "the name of a class",
                    row.blank(label) ? "fill the cell or remove the row"
                                     : "which --missing says to be none: fill the cell, or remove the row");
  return trimmed(row[label]);
}

}  // namespace

bool has_decimal_comma(std::string_view word) {
  std::string number(word);
  const auto comma = number.find(',');
  if (comma != std::string::npos) number[comma] = '.';
  return comma != std::string::npos && parse_number(number);
}

bool means_unknown(std::string_view word) {
  constexpr std::array words = {"na", "n/a", "n.a.", "#n/a", "<na>", "nan", "nat", "null", "(null)", "\\n", "#div/0!"};
  return std::ranges::find(words, lower_case(word)) != words.end();
}

MissingWords::MissingWords(const std::vector<std::string>& more) {
  for (const auto& text : more) more_.emplace_back(text, parse_number(text));
}

bool MissingWords::operator()(std::string_view cell) const {
  const std::string_view text = trimmed(cell);
  if (text.empty() || text == "?") return true;
  return std::ranges::any_of(more_, [&](const auto& word) {
    return word.first == text || (word.second && word.second == parse_number(text));
  });
}

bool MissingWords::among_numbers(std::string_view cell) const {
  constexpr std::array words = {"-", "--", ".", "none", "nil", "inf", "-inf", "+inf", "infinity", "-infinity"};
  if (operator()(cell) || means_unknown(trimmed(cell))) return true;
  return std::ranges::find(words, lower_case(trimmed(cell))) != words.end();
}

LabelledTable read_table(const std::string& file, const TableReading& options, bool quiet) {
  CsvReader reader = open_csv(file);
  const std::size_t label = reader.column(options.label);
  LabelledTable table{.file = reader.file(), .label = options.label};
  const MissingWords missing(options.missing);
  auto columns = columns_of(reader, options, table);
  Vocabulary classes, groups;
  const auto group = options.groups.empty() ? std::nullopt : std::optional(reader.column(options.groups));
  Progress progress("reading", reader.bytes_total().value_or(0), quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row);) {
    progress.advance(reader.bytes_read() - progress.done());
    table.labels.push_back(classes.number(class_in(row, label, reader, missing)));
    table.lines.push_back(static_cast<std::uint32_t>(row.line()));
    if (classes.size() > most_values)
      throw row.error(label, fmt::format("one of at most {} classes", most_values), "choose another --label");
    for (ColumnReader& column : columns) column.take(row, missing);
    if (!group) continue;
    const std::string_view name = trimmed(row[*group]);
    if (missing(name) || means_unknown(name)) throw row.error(*group, "the name of the row's group", "fill the cell");
    table.groups.push_back(groups.number(name));
  }
  progress.finish();
  if (table.size() == 0) throw InputError("{}: there is no row below the header", table.file);
  std::vector<std::size_t> places;
  std::tie(table.classes, places) = classes.sorted();
  if (table.classes.size() == 1)
    throw InputError({.where = fmt::format("{}:{}", table.file, table.lines.front()),
                      .what = fmt::format("column {}", in_quotes(options.label)),
                      .found = fmt::format("{} in all of {} rows", in_quotes(table.classes.front()), table.size()),
                      .expected = "at least two classes"});
  table.rows_of_class.resize(table.classes.size());
  for (std::size_t& its_class : table.labels) ++table.rows_of_class[its_class = places[its_class]];
  for (ColumnReader& column : columns) column.finish(table);
  if (table.columns.empty())
    throw InputError("{}: found the same value in all {} rows of each column beside {}, expected a column that differs",
                     table.file, table.size(), in_quotes(table.label));
  return table;
}

}  // namespace sigmax::apps
