#include "study/study.hpp"

#include <charconv>

#include "report/result.hpp"
#include "shell/parallel.hpp"
#include "shell/progress.hpp"
#include "study/ranks.hpp"

namespace sigmax::apps {
namespace {

using Add = std::function<void(std::size_t cell, const Study::Row& row)>;

/// "2/4" is the second of four.
void read_shard(const std::string& text, Sharing& sharing) {
  const char* const end = text.data() + text.size();
  std::size_t index = 0;
  const auto first = std::from_chars(text.data(), end, index);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, sharing.shards) : first;
  if (!slash || second.ec != std::errc{} || second.ptr != end || index < 1 || index > sharing.shards)
    throw std::invalid_argument(fmt::format("found {}, expected I/N with I from 1 to N, as 2/4", in_quotes(text)));
  sharing.shard = index - 1;
}

bool run_first(const Study& study, const Sharing& sharing, Ranks* ranks, const OutputOptions& options, const Add& add) {
  if (sharing.shards > 1 && options.out.empty())
    throw UsageError({.what = "--shard without --out would leave nothing to merge", .remedy = "give --out DIR"});
  if (sharing.shards > 1 && !options.report.empty())
    throw UsageError("--report shows all shards, and this is one; give it to merge");
  { const ResultFiles trial(options); }  // refuses a place that cannot be written before the work
  std::optional<Journal> journal;
  if (!options.out.empty() && !study.description.empty()) {
    const auto path = output_directory(options.out) / journal_name;
    journal.emplace(path, study.description);
    say_when_interrupted(fmt::format("{} stays, and the same command goes on from there", printable(path.native())));
  }
  CellRows waiting = journal ? journal->rows() : CellRows();  // until all before them are added
  std::vector<std::size_t> open;
  std::size_t share = 0, next = 0;
  for (std::size_t cell = 0; cell < study.cells; ++cell) {
    if (cell % sharing.shards != sharing.shard) continue;
    ++share;
    if (!waiting.contains(cell)) open.push_back(cell);
  }
  if (sharing.finished && !open.empty())
    throw InputError(
        "{} of {} cells are missing, the first is number {}; finish all shards and give all their directories",
        open.size(), study.cells, open.front());
  Progress progress(study.name, share, options.quiet);
  progress.advance(share - open.size());
  const auto take = [&](CellRows rows) {
    if (journal) journal->append(rows);
    progress.advance(rows.size());
    waiting.merge(rows);
    for (; sharing.shards == 1 && waiting.begin() != waiting.end() && waiting.begin()->first == next; ++next)
      add(next, waiting.extract(waiting.begin()).mapped());
  };
  take({});
  std::mutex taking;
  if (ranks != nullptr)
    ranks->hand_out(open, take);
  else
    in_parallel(open.size(), threads_or_all(sharing.threads), [&](std::size_t i) {
      Study::Row row = study.work(open[i]);
      const std::lock_guard lock(taking);
      take({{open[i], std::move(row)}});
    });
  progress.finish();
  if (journal) journal->finish();
  if (sharing.shards == 1) return true;
  fmt::print("Finished shard {}/{}, {} of {} cells; himm_demo merge puts all shards together\n", sharing.shard + 1,
             sharing.shards, share, study.cells);
  return false;
}

}  // namespace

bool run(const Study& study, const Sharing& sharing, const OutputOptions& options, const Add& add) {
  const char* const instead = study.description.empty() ? "run it without mpirun" : "use --shard I/N and merge";
  const auto ranks = sharing.shards == 1 && !sharing.finished ? Ranks::join(instead) : nullptr;
  try {
    if (!ranks || ranks->first()) return run_first(study, sharing, ranks.get(), options, add);
    ranks->serve(study.work);
    return false;
  } catch (const std::exception& error) {
    if (ranks) ranks->abort(error);
    throw;
  }
}

void add_shard(Subcommand app, Sharing& sharing) {
  app.option(
         "--shard", [&sharing](const std::string& text) { read_shard(text, sharing); },
         "Only a share of the work, 1/N … N/N, for N machines; see merge")
      .type("I/N");
  app.flag("--finished", sharing.finished, "").hidden();
}

}  // namespace sigmax::apps
