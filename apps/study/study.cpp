#include "study/study.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "result/result.hpp"
#include "study/journal.hpp"
#include "study/ranks.hpp"
#include "support/error.hpp"
#include "support/parallel.hpp"
#include "support/progress.hpp"

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
    throw CLI::ValidationError("--shard",
                               fmt::format("found {}, expected I/N with I from 1 to N, as 2/4", in_quotes(text)));
  sharing.shard = index - 1;
}

/// What is done with finished cells: they are kept on the disk, and added in their order.
class Finished {
 public:
  Finished(const Study& study, const Sharing& sharing, const OutputOptions& options, const Add& add)
      : sharing_(sharing), add_(add), share_(count_share(study)), progress_(study.name, share_, options.quiet) {
    if (!options.out.empty() && !study.description.empty())
      journal_.emplace(OutputDirectory(options.out).path() / journal_name, study.description);
    if (journal_) waiting_ = journal_->rows();
    for (std::size_t cell = 0; cell < study.cells; ++cell)
      if (sharing.has(cell) && !waiting_.contains(cell)) open_.push_back(cell);
    if (sharing.finished && !open_.empty())
      throw InputError(message({.what = fmt::format("{} of {} cells are missing, the first is number {}", open_.size(),
                                                    study.cells, open_.front()),
                                .remedy = "finish all shards and give all their directories"}));
    progress_.advance(share_ - open_.size());
    add_all();
  }

  const std::vector<std::size_t>& open() const { return open_; }
  std::size_t share() const { return share_; }

  void take(CellRows rows) {
    for (auto& [cell, row] : rows) {
      if (journal_) journal_->append(cell, row);
      progress_.advance();
    }
    if (journal_) journal_->store();
    waiting_.merge(rows);
    add_all();
  }

  void end() {
    progress_.finish();
    if (journal_) journal_->finish();
  }

 private:
  std::size_t count_share(const Study& study) const {
    return (study.cells + sharing_.shards - 1 - sharing_.shard) / sharing_.shards;
  }

  void add_all() {
    for (; sharing_.shards == 1 && !waiting_.empty() && waiting_.begin()->first == next_; ++next_) {
      add_(next_, waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
    }
  }

  const Sharing& sharing_;
  const Add& add_;
  std::size_t share_;
  Progress progress_;
  std::optional<Journal> journal_;
  std::vector<std::size_t> open_;
  CellRows waiting_;  // until all before them are added
  std::size_t next_ = 0;
};

bool run_first(const Study& study, const Sharing& sharing, Ranks* ranks, const OutputOptions& options, const Add& add) {
  if (sharing.shards > 1 && options.out.empty())
    throw UsageError(
        message({.what = "--shard without --out would leave nothing to merge", .remedy = "give --out DIR"}));
  if (sharing.shards > 1 && !options.report.empty())
    throw UsageError(message({.what = "--report shows all shards, and this is one", .remedy = "give it to merge"}));
  { const ResultFiles trial(options); }  // refuses a place that cannot be written before the work
  Finished finished(study, sharing, options, add);
  std::mutex taking;
  if (ranks != nullptr)
    ranks->hand_out(finished.open(), [&](CellRows rows) { finished.take(std::move(rows)); });
  else
    in_parallel(finished.open().size(), threads_or_all(sharing.threads), [&](std::size_t i) {
      const std::size_t cell = finished.open()[i];
      Study::Row row = study.work(cell);
      const std::lock_guard lock(taking);
      finished.take({{cell, std::move(row)}});
    });
  finished.end();
  if (sharing.shards == 1) return true;
  fmt::print("Finished shard {}/{}, {} of {} cells; himm_demo merge puts all shards together\n", sharing.shard + 1,
             sharing.shards, finished.share(), study.cells);
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

void add_shard(CLI::App& app, Sharing& sharing) {
  app.add_option_function<std::string>(
         "--shard", [&sharing](const std::string& text) { read_shard(text, sharing); },
         "Only a share of the work, 1/N … N/N, for N machines; see merge")
      ->type_name("I/N");
  app.add_flag("--finished", sharing.finished)->group("");
}

}  // namespace sigmax::apps
