#include "recognition_demo/data_table.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <sigmax/recognition/report.hpp>

#include "support/input.hpp"
#include "support/progress.hpp"

namespace sigmax::apps {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Words beyond this many are names of things, not values of a feature.
constexpr std::size_t most_values = 4096;

/// Words numbered as they come.
class Words {
 public:
  std::size_t code(std::string_view word) {
    const auto found = codes_.find(word);
    if (found != codes_.end()) return found->second;
    return codes_.emplace(std::string(word), codes_.size()).first->second;
  }
  std::size_t size() const { return codes_.size(); }

  /// The words in order, numbers by their value, and renumbers the codes accordingly.
  std::vector<std::string> sorted(std::vector<std::size_t>& codes) const {
    std::vector<std::string> words(codes_.size());
    for (const auto& [word, code] : codes_) words[code] = word;
    const bool numbers = std::all_of(words.begin(), words.end(), [](const auto& word) { return parse_number(word); });
    std::vector<std::size_t> order(words.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (numbers && *parse_number(words[a]) != *parse_number(words[b]))
        return *parse_number(words[a]) < *parse_number(words[b]);
      return words[a] < words[b];
    });
    std::vector<std::string> result;
    std::vector<std::size_t> rank(words.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      result.push_back(words[order[i]]);
      rank[order[i]] = i;
    }
    for (std::size_t& code : codes)
      if (code != missing) code = rank[code];
    return result;
  }

 private:
  std::map<std::string, std::size_t, std::less<>> codes_;
};

/// A column while it is read: numeric until a cell is not, and then the words so far are what counts.
class ColumnReader {
 public:
  ColumnReader(std::size_t index, bool categorical) : index_(index), numeric_(!categorical) {}

  void take(const CsvRow& row) {
    const std::string_view cell = trimmed(row[index_]);
    const bool empty = is_missing(cell);
    if (numeric_) {
      const auto number = empty ? std::optional(nan) : parse_number(cell);
      if (number) {
        numbers_.push_back(*number);
      } else {
        if (too_many_words_)
          throw row.error(index_, fmt::format("a number, as in the {} rows before", numbers_.size()),
                          "leave the cell empty where there is none");
        numeric_ = false;
        numbers_ = {};
      }
    }
    if (too_many_words_) return;
    codes_.push_back(empty ? missing : words_.code(cell));
    if (words_.size() <= most_values) return;
    if (!numeric_)
      throw row.error(index_, fmt::format("one of at most {} different values", most_values),
                      "leave the column out by --ignore");
    too_many_words_ = true;
    codes_ = {};
  }

  DataColumn column(const CsvReader& reader, std::size_t first_line) && {
    const std::string& name = reader.names()[index_];
    const std::size_t rows = std::max(numbers_.size(), codes_.size());
    const auto useless = [&](std::string_view found) {
      return InputError(message({.where = fmt::format("{}:{}", reader.file(), first_line),
                                 .what = fmt::format("column {}", in_quotes(name)),
                                 .found = found,
                                 .expected = "at least two different values",
                                 .remedy = fmt::format("leave the column out by --ignore {}", name)}));
    };
    if (!too_many_words_ && words_.size() == 0) throw useless(fmt::format("no value in any of {} rows", rows));
    if (!too_many_words_ && words_.size() == 1) {
      std::vector<std::size_t> one = {0};
      throw useless(fmt::format("{} in all of {} rows", in_quotes(words_.sorted(one).front()), rows));
    }
    DataColumn result{name, numeric_, {}, {}, {}};
    if (numeric_) {
      result.numbers = std::move(numbers_);
    } else {
      result.codes = std::move(codes_);
      result.values = words_.sorted(result.codes);
    }
    return result;
  }

 private:
  std::size_t index_;
  bool numeric_;
  bool too_many_words_ = false;
  Words words_;
  std::vector<std::size_t> codes_;
  std::vector<double> numbers_;
};

}  // namespace

bool is_missing(std::string_view cell) {
  const std::string_view text = trimmed(cell);
  return text.empty() || text == "?";
}

DataTable read_data(const std::filesystem::path& path, const DataOptions& options) {
  CsvReader reader{path};
  const std::size_t label = reader.column(options.label);
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
    throw InputError(message({.where = reader.file(),
                              .what = fmt::format("there is no column beside {}", in_quotes(options.label)),
                              .expected = "one with a feature"}));

  DataTable table;
  table.file = reader.file();
  table.label = options.label;
  Words classes;
  Progress progress("reading", reader.bytes_total().value_or(0), options.quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row);) {
    progress.advance(reader.bytes_read() - progress.done());
    if (is_missing(row[label])) throw row.error(label, "the name of a class", "fill the cell or remove the row");
    table.labels.push_back(classes.code(trimmed(row[label])));
    if (classes.size() > most_values)
      throw row.error(label, fmt::format("one of at most {} classes", most_values), "choose another --label");
    table.lines.push_back(row.line());
    for (auto& column : columns) column.take(row);
  }
  progress.finish();
  if (table.labels.empty())
    throw InputError(message({.where = reader.file(), .what = "there is no row below the header"}));
  table.classes = classes.sorted(table.labels);
  if (table.classes.size() == 1)
    throw InputError(
        message({.where = fmt::format("{}:{}", reader.file(), table.lines.front()),
                 .what = fmt::format("column {}", in_quotes(options.label)),
                 .found = fmt::format("{} in all of {} rows", in_quotes(table.classes.front()), table.labels.size()),
                 .expected = "at least two classes"}));
  for (auto& column : columns) table.columns.push_back(std::move(column).column(reader, table.lines.front()));
  return table;
}

}  // namespace sigmax::apps
