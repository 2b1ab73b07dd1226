#pragma once

#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "support/command_line.hpp"
#include "support/output.hpp"

namespace sigmax::apps {

/// The result files of a run. Without --out nothing is written. The directory is made first, so that a bad one is known
/// before the work; the files appear together at the end.
///
///     ResultFiles files(options);
///     …
///     files.write("curves.csv", curves.csv());
///     files.write_json("summary.json", summary);
///     files.commit();
class ResultFiles {
 public:
  explicit ResultFiles(const OutputOptions& options);

  /// Whether there is a directory to write to.
  bool wanted() const { return directory_.has_value(); }

  /// A file to be filled bit by bit, or null where nothing is wanted. It stays valid as long as this.
  AtomicFile* open(const std::string& name);

  void write(const std::string& name, std::string_view text);
  void write_json(const std::string& name, const nlohmann::ordered_json& json);

  /// Puts all files into their place and prints "Wrote a.csv and summary.json to DIR".
  void commit();

 private:
  std::optional<OutputDirectory> directory_;
  std::list<AtomicFile> files_;
  std::vector<std::string> names_;
};

/// What every summary begins with: the version and the command.
nlohmann::ordered_json summary_of(const OutputOptions& options);

}  // namespace sigmax::apps
