#include "support/campaign.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/output.hpp"
#include "support/parallel.hpp"
#include "support/progress.hpp"
#include "support/ranks.hpp"
#include "support/result_files.hpp"

namespace sigmax::apps {
namespace {

/// "2/4" is the second of four.
std::string read_shard(const std::string& text, Shard& shard) {
  const char* const end = text.data() + text.size();
  std::size_t index = 0;
  std::size_t of = 0;
  const auto first = std::from_chars(text.data(), end, index);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, of) : first;
  if (!slash || second.ec != std::errc{} || second.ptr != end || index < 1 || index > of)
    return fmt::format("found {}, expected I/N with I from 1 to N, as 2/4", in_quotes(text));
  shard.index = index - 1;
  shard.of = of;
  return "";
}

/// The cells of a share that are not in the rows, and how many cells the share has.
std::pair<std::vector<std::size_t>, std::size_t> open_cells(const Campaign& campaign, Shard shard,
                                                            const CellRows& rows) {
  std::vector<std::size_t> open;
  std::size_t share = 0;
  for (std::size_t cell = 0; cell < campaign.cells; ++cell) {
    if (!shard.has(cell)) continue;
    ++share;
    if (!rows.contains(cell)) open.push_back(cell);
  }
  if (shard.finished && !open.empty())
    throw InputError(message({.what = fmt::format("{} of {} cells are missing, the first is number {}", open.size(),
                                                  campaign.cells, open.front()),
                              .remedy = "finish all shards and give all their directories"}));
  return {open, share};
}

/// Does the open cells by ranks or threads, and keeps what they give.
void do_open(const Campaign& campaign, const std::vector<std::size_t>& open, Ranks* ranks, int threads,
             const std::function<void(Ranks::Finished)>& keep) {
  if (ranks != nullptr) {
    ranks->hand_out(open, keep);
    return;
  }
  std::mutex keeping;
  for_each_run(
      open.size(), threads_or_all(threads),
      [&](std::size_t i) {
        auto row = campaign.work(open[i]);
        const std::lock_guard lock(keeping);
        keep({{open[i], std::move(row)}});
        return 0;
      },
      [](std::size_t, int) {}, open.size() + 1);
}

std::optional<CellRows> run_first(const Campaign& campaign, Shard shard, Ranks* ranks, int threads,
                                  const OutputOptions& options) {
  if (shard.of > 1 && options.out.empty())
    throw UsageError(
        message({.what = "--shard without --out would leave nothing to merge", .remedy = "give --out DIR"}));
  if (shard.of > 1 && !options.report.empty())
    throw UsageError(message({.what = "--report shows all shards, and this is one", .remedy = "give it to merge"}));
  { const ResultFiles trial(options); }  // refuses a place that cannot be written before the work
  std::unique_ptr<Journal> journal;
  if (!options.out.empty())
    journal = std::make_unique<Journal>(OutputDirectory(options.out).path() / journal_name, campaign.description);
  CellRows rows = journal ? journal->rows() : CellRows();
  const auto [open, share] = open_cells(campaign, shard, rows);
  Progress progress(campaign.name, share, options.quiet);
  progress.advance(share - open.size());
  do_open(campaign, open, ranks, threads, [&](const Ranks::Finished& finished) {
    for (const auto& [cell, row] : finished) {
      if (journal) journal->append(cell, row);
      rows.insert_or_assign(cell, row);
      progress.advance();
    }
    if (journal) journal->store();
  });
  progress.finish();
  if (journal) journal->finish();
  if (shard.of == 1) return rows;
  fmt::print("Finished shard {}/{}, {} of {} cells; himm_demo merge puts all shards together\n", shard.index + 1,
             shard.of, share, campaign.cells);
  return std::nullopt;
}

}  // namespace

std::optional<CellRows> run(const Campaign& campaign, Shard shard, int threads, const OutputOptions& options) {
  const auto ranks = shard.of == 1 && !shard.finished ? Ranks::join("use --shard I/N and merge") : nullptr;
  try {
    if (!ranks || ranks->first()) return run_first(campaign, shard, ranks.get(), threads, options);
    ranks->serve(campaign.work);
    return std::nullopt;
  } catch (const std::exception& error) {
    if (ranks) ranks->abort(error);
    throw;
  }
}

void add_shard(CLI::App& app, Shard& shard) {
  app.add_option_function<std::string>(
         "--shard",
         [&shard](const std::string& text) {
           if (const std::string complaint = read_shard(text, shard); !complaint.empty())
             throw CLI::ValidationError("--shard", complaint);
         },
         "Only a share of the work, 1/N … N/N, for N machines; see merge")
      ->type_name("I/N");
  app.add_flag("--finished", shard.finished)->group("");
}

}  // namespace sigmax::apps
