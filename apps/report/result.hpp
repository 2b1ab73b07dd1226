#pragma once

#include <list>
#include <memory>

#include "report/report.hpp"
#include "shell/command_line.hpp"
#include "shell/files.hpp"

namespace sigmax::apps {

/// Where results go, and how they look; the same for every subcommand.
struct OutputOptions {
  std::string out;      ///< a directory for files, or empty
  std::string report;   ///< the file of the report, or empty: that of the directory, if there is one
  std::string summary;  ///< the same of the summary
  bool quiet = false;   ///< no progress bar
  bool wide = false;    ///< rows of tables are not broken
  std::string command;  ///< as typed, for the record

  /// Of tables: that of the terminal, if it has more than 80 columns.
  std::size_t width() const;
};

/// --out, --quiet, --wide and --report, and the command for the record.
void add_results(Subcommand app, OutputOptions& options, const std::string& command);
void add_quiet(Subcommand app, bool& quiet);
void add_wide(Subcommand app, bool& wide);

/// The result files of a run. Without --out nothing is written but the report, if --report asks for it. Directory and
/// report are begun first, so that a bad place is known before the work; the files appear
/// together at the end.
///
///     ResultFiles files(options);
///     …
///     files.write("curves.csv", curves.csv());
///     files.write("summary.json", summary);
///     if (files.report_wanted()) files.write_report({.title = "…"});
///     files.commit();
class ResultFiles {
 public:
  /// Throws UsageError if --report asks for what this program was built without.
  explicit ResultFiles(const OutputOptions& options);

  /// Whether there is a directory to write to.
  bool wanted() const { return !directory_.empty(); }

  /// A file to be filled bit by bit, or null where nothing is wanted. It stays valid as long as this.
  AtomicFile* open(const std::string& name);

  void write(const std::string& name, std::string_view text);

  /// Whether there is to be a report: with a directory, unless this program was built without charts, or where --report
  /// says.
  bool report_wanted() const;

  void write_summary(std::string_view text);

  /// Writes the page, and beside the other files its data, `report_data_name`, which the summary should name.
  void write_report(const Report& report);

  /// Puts all files into their place and prints "Wrote a.csv and summary.json to DIR".
  void commit();

 private:
  std::filesystem::path directory_;  // empty: none
  bool wide_;
  std::list<AtomicFile> files_;
  std::vector<std::string> names_;
  std::optional<AtomicFile> report_, summary_;  // where they are not in the directory
};

/// Rows that are too many to keep: a CSV file that is filled as they come, or nothing where no files are wanted.
class RowFile {
 public:
  RowFile(ResultFiles& files, const std::string& name, const std::vector<std::string>& keys);

  explicit operator bool() const { return file_ != nullptr; }
  void write(const std::vector<Cell>& cells) {
    if (file_) file_->write(table_.csv_line(cells));
  }

 private:
  ResultTable table_;
  AtomicFile* file_;
};

/// Where something stands in a summary: keys, and places in lists.
using Path = std::vector<std::variant<std::string, std::size_t>>;

/// The places of a table in a result.
struct Places {
  bool printed = true;    ///< on the terminal, after an empty line
  std::string heading{};  ///< printed above it
  std::string csv{};      ///< a file of its rows
  Path summary{};         ///< what has it as an object
  std::string title{};    ///< above it in the last part of the page; without one it is not there
  std::string note{};     ///< below it in the page
};

/// What a command found: it is built once, and then printed, written and drawn.
///
///     ResultFiles files(options);      // a bad place is known before the work
///     Result result(options);
///     result.fact({"runs"}, 100);
///     result.say("100 runs");
///     result.add(table, {.csv = "filters.csv", .summary = {"filters"}, .title = "The filters"});
///     result.page.views = {…};
///     result.publish(files);
class Result {
 public:
  explicit Result(const OutputOptions& options);

  /// Prints words, broken to `words_width`.
  void say(std::string_view words);
  template <class First, class... Rest>
  void say(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) {
    say(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
  }

  /// Prints those words whose condition holds.
  void say(const std::vector<std::pair<bool, std::string>>& notes);

  /// Puts a table into all its places.
  void add(const ResultTable& table, const Places& places);

  /// Puts a value into the summary.
  void fact(const Path& path, const Cell& value);
  void fact(const Path& path, const std::vector<std::string>& words);
  /// Keys and values by turns, in one place.
  template <class Value, class... Rest>
  void facts_at(Path place, const std::string& key, const Value& value, const Rest&... rest) {
    place.emplace_back(key);
    fact(place, value);
    place.pop_back();
    if constexpr (sizeof...(rest) > 0) facts_at(std::move(place), rest...);
  }
  template <class... KeysAndValues>
  void facts(const KeysAndValues&... all) {
    facts_at({}, all...);
  }

  std::size_t words_width;  ///< that of the tables, unless another one is set
  std::string text;         ///< what was said and added so far, for the terminal
  Report page;              ///< with the command, and the tables that have a title

  /// Prints all, and writes tables, summary and page as far as they are wanted.
  void publish(ResultFiles& files);

 private:
  nlohmann::ordered_json& at(const Path& path);

  const OutputOptions& options_;
  std::vector<std::pair<std::string, std::string>> tables_;  // names of files, and what they hold
  std::shared_ptr<nlohmann::ordered_json> summary_;          // shared, as its type is not whole here
};

/// Throws UsageError if the file that an option names is an input, by whatever name; "-" is the standard input.
void refuse_to_overwrite(const std::string& option, const std::string& file, const std::vector<std::string>& inputs);

/// The same of all that ResultFiles writes: these files beside summary and report in the directory, and the report.
void refuse_to_overwrite(const OutputOptions& options, const std::vector<std::string>& inputs,
                         std::vector<std::string> names = {});

}  // namespace sigmax::apps
