#include <sstream>

#include "himm_demo/subcommands.hpp"
#include "report/result.hpp"
#include "study/journal.hpp"
#include "study/study.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  OutputOptions output;
};

/// The cells of all parts, which must be of one campaign and agree where they have the same cell.
Journaled joined(const std::vector<std::string>& parts) {
  Journaled all;
  for (const std::filesystem::path part : parts) {
    const auto path = part / journal_name;
    const Journaled own = read_journal(path);
    if (all.study.empty()) all.study = own.study;
    require_study(path, own.study, all.study, "this is a shard of another campaign");
    for (const auto& [cell, row] : own.rows) {
      const auto [there, added] = all.rows.emplace(cell, row);
      if (!added && journal_line(cell, there->second) != journal_line(cell, row))
        throw InputError(
            "{}: cell {} is another one than in a shard before; do all shards by the same build of the program",
            path.native(), cell);
    }
  }
  return all;
}

/// The words of the command that the journal is of, without program and version.
std::vector<std::string> command_of(const std::string& campaign) {
  std::istringstream words(campaign);
  std::string program, made_by;
  words >> program >> made_by;
  if (program != "himm_demo" || made_by != version)
    throw InputError("the shards: found {}, expected himm_demo {}; merge them by the version that made them",
                     in_quotes(program + " " + made_by), version);
  return {std::istream_iterator<std::string>(words), {}};
}

void merge(const MergeOptions& options) {
  refuse_to_overwrite(options.output, each(options.parts, [](const std::filesystem::path& part) {
                        return (part / journal_name).string();
                      }));
  const Journaled all = joined(options.parts);
  std::vector<std::string> arguments = command_of(all.study);
  Journal(output_directory(options.output.out) / journal_name, all.study).append(all.rows);
  arguments.insert(arguments.end(), {"--finished", "--out", options.output.out});
  if (options.output.wide) arguments.emplace_back("--wide");
  if (!options.output.report.empty()) arguments.insert(arguments.end(), {"--report", options.output.report});
  if (options.output.quiet) arguments.emplace_back("--quiet");
  run_again(subcommands, "himm_demo", arguments);
}

}  // namespace

void add_merge(CLI::App& program, const std::string& command) {
  Subcommand app(program, "merge", "The results of reproduce or sweep out of their shards.");
  const auto options = std::make_shared<MergeOptions>();
  app.option("parts", options->parts, "Directories that --shard … --out wrote").required().type("DIR");
  add_results(app, options->output, command);
  app.option("--out").required();
  app.run([options] { merge(*options); });
}

}  // namespace sigmax::apps
