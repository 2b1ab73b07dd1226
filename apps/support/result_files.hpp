#pragma once

#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "support/command_line.hpp"
#include "support/gnuplot.hpp"
#include "support/output.hpp"
#include "support/report.hpp"

namespace sigmax::apps {

/// The result files of a run. Without --out nothing is written but the report and its pictures, if --report and --plots
/// ask for them. Directories and report are begun first, so that a bad place is known before the work; the files appear
/// together at the end.
///
///     ResultFiles files(options);
///     …
///     files.write("curves.csv", curves.csv());
///     files.write_json("summary.json", summary);
///     if (files.report_wanted()) files.write_report({.title = "…"});
///     files.commit();
class ResultFiles {
 public:
  /// Throws UsageError if --report asks for what this program was built without, or --plots for gnuplot and it is not
  /// there.
  explicit ResultFiles(const OutputOptions& options);

  /// Whether there is a directory to write to.
  bool wanted() const { return directory_.has_value(); }

  /// A file to be filled bit by bit, or null where nothing is wanted. It stays valid as long as this.
  AtomicFile* open(const std::string& name);

  void write(const std::string& name, std::string_view text);
  void write_json(const std::string& name, const nlohmann::ordered_json& json);

  /// Whether there is to be a report: with a directory, unless this program was built without charts, or where --report
  /// says, or as pictures.
  bool report_wanted() const;

  /// Writes the page, and beside the other files its data, `report_data_name`, which the summary should name; and the
  /// pictures if they are wanted.
  void write_report(const Report& report);

  /// Puts all files into their place and prints "Wrote a.csv and summary.json to DIR".
  void commit();

 private:
  std::optional<OutputDirectory> directory_;
  std::list<AtomicFile> files_;
  std::vector<std::string> names_;
  std::optional<AtomicFile> report_;  // where it is not in the directory
  std::optional<OutputDirectory> plots_;
  std::optional<Gnuplot> gnuplot_;
  std::vector<std::pair<std::string, std::string>> pictures_;  // names and contents: more than are open at a time
};

/// Throws UsageError if the file that an option names is an input, by whatever name; "-" is the standard input.
void refuse_to_overwrite(const std::string& option, const std::string& file, const std::vector<std::string>& inputs);

/// The same of all that ResultFiles writes: these files beside summary and report in the directory, the report, and the
/// charts, whose names are known late, so that no SVG or PDF file among them may be an input.
void refuse_to_overwrite(const OutputOptions& options, const std::vector<std::string>& inputs,
                         std::vector<std::string> names = {});

/// What every summary begins with: the version and the command.
nlohmann::ordered_json summary_of(const OutputOptions& options);

}  // namespace sigmax::apps
