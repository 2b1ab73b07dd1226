#include "study/study.hpp"

#include <charconv>
#include <csignal>
#include <cstdlib>
#include <numeric>

#include <boost/math/distributions/students_t.hpp>

#ifdef SIGMAX_MPI
#include <mpi.h>
#endif

#include "report/result.hpp"
#include "shell/progress.hpp"

namespace sigmax::apps {
namespace {

using Add = std::function<void(std::size_t cell, const Study::Row& row)>;

/// Whether a launcher says that there are several of us. MPI itself is not asked, since that takes a while.
bool among_others() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* const size = std::getenv(variable))
      if (std::atoi(size) > 1) return true;
  return false;
}

#ifdef SIGMAX_MPI

constexpr int tag_row = 1;   // from a worker: the cell and its row, or nothing at first
constexpr int tag_cell = 2;  // to a worker: the next cell, or none
constexpr long none = -1;

/// The same program started many times by mpirun. The first rank hands out cells of work and takes what they give; the
/// others do the work, one cell at a time.
class Ranks {
 public:
  Ranks() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (rank_ != 0) std::signal(SIGTERM, SIG_DFL);  // what ends all is the first one's to tell
  }
  ~Ranks() {
    MPI_Barrier(MPI_COMM_WORLD);  // mpirun may crash or stay if the first aborts while others finalize
    MPI_Finalize();
  }

  bool first() const { return rank_ == 0; }

  /// Gives each cell to the next rank that is free; take(rows) gets what has come in meanwhile.
  void hand_out(std::span<const std::size_t> cells, const std::function<void(CellRows)>& take) {
    std::size_t next = 0;
    for (int workers = size_ - 1; workers > 0;) {
      CellRows came;
      MPI_Status status;
      MPI_Probe(MPI_ANY_SOURCE, tag_row, MPI_COMM_WORLD, &status);
      for (int more = 1; more != 0; MPI_Iprobe(MPI_ANY_SOURCE, tag_row, MPI_COMM_WORLD, &more, &status)) {
        int size = 0;
        MPI_Get_count(&status, MPI_DOUBLE, &size);
        std::vector<double> row(static_cast<std::size_t>(size));
        MPI_Recv(row.data(), size, MPI_DOUBLE, status.MPI_SOURCE, tag_row, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        const long cell = next < cells.size() ? static_cast<long>(cells[next++]) : none;
        MPI_Send(&cell, 1, MPI_LONG, status.MPI_SOURCE, tag_cell, MPI_COMM_WORLD);
        if (cell == none) --workers;
        if (row.empty()) continue;
        const auto of = static_cast<std::size_t>(row.front());
        row.erase(row.begin());
        came.emplace(of, std::move(row));
      }
      if (!came.empty()) take(std::move(came));
    }
  }

  /// Does what the first rank hands out, until nothing is left.
  void serve(const std::function<std::vector<double>(std::size_t)>& work) {
    std::vector<double> message;
    for (;;) {
      MPI_Send(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, 0, tag_row, MPI_COMM_WORLD);
      long cell = none;
      MPI_Recv(&cell, 1, MPI_LONG, 0, tag_cell, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      if (cell == none) return;
      message = {static_cast<double>(cell)};
      const auto row = work(static_cast<std::size_t>(cell));
      message.insert(message.end(), row.begin(), row.end());
    }
  }

  /// Prints what happened and ends all ranks: a single one cannot leave.
  [[noreturn]] void abort(const std::exception& error) {
    complain(error);
    MPI_Abort(MPI_COMM_WORLD, exit_code(error));
    std::abort();
  }

 private:
  int rank_ = 0, size_ = 1;
};

#else

/// A build without MPI has one rank.
struct Ranks {
  bool first() const { return true; }
  void hand_out(const std::vector<std::size_t>&, const std::function<void(CellRows)>&) {}
  void serve(const std::function<Study::Row(std::size_t)>&) {}
  void abort(const std::exception&) {}
};

#endif

/// Joins the other ranks; null where the program runs alone. Throws UsageError, with what to do instead, if mpirun
/// started a build without MPI.
std::unique_ptr<Ranks> joined([[maybe_unused]] std::string_view instead) {
  if (!among_others()) return nullptr;
#ifdef SIGMAX_MPI
  return std::make_unique<Ranks>();
#else
  throw UsageError(
      "this build has no MPI, so mpirun would do the same work in every rank; {}, or configure with libopenmpi-dev "
      "installed",
      instead);
#endif
}

/// The cells of shards, which must be of this study and agree where they have the same cell.
CellRows cells_of(const std::vector<std::string>& shards, const Study& study) {
  CellRows all;
  for (const std::filesystem::path shard : shards) {
    const auto path = shard / journal_name;
    const Journaled own = read_journal(path);
    require_study(path, own.study, study.description, "this is a shard of another campaign",
                  "give the options of the shards");
    for (const auto& [cell, row] : own.rows) {
      const auto [there, added] = all.emplace(cell, row);
      if (!added && journal_line(cell, there->second) != journal_line(cell, row))
        throw InputError(
            "{}: cell {} is another one than in a shard before; do all shards by the same build of the program",
            path.native(), cell);
    }
  }
  return all;
}

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
  const bool merges = !sharing.merged.empty();
  if ((sharing.shards > 1 || merges) && options.out.empty())
    throw UsageError("{} without --out has no place for the finished cells; give --out DIR",
                     merges ? "--merge" : "--shard");
  if (sharing.shards > 1 && (merges || !options.report.empty()))
    throw UsageError("{} is of all shards, and this is one; leave out --shard", merges ? "--merge" : "--report");
  refuse_to_overwrite(options, each(sharing.merged, [](const std::filesystem::path& shard) {
                        return (shard / journal_name).string();
                      }));
  const CellRows merged = cells_of(sharing.merged, study);
  { const ResultFiles trial(options); }  // refuses a place that cannot be written before the work
  std::optional<Journal> journal;
  if (!options.out.empty() && !study.description.empty()) {
    const auto path = output_directory(options.out) / journal_name;
    journal.emplace(path, study.description);
    report_interruption(fmt::format("{} stays, and the same command goes on from there", printable(path.native())));
  }
  if (merges) journal->append(merged);
  CellRows waiting = journal ? journal->rows() : CellRows();  // until all before them are added
  std::vector<std::size_t> open;
  std::size_t share = 0, next = 0;
  for (std::size_t cell = 0; cell < study.cells; ++cell) {
    if (cell % sharing.shards != sharing.shard) continue;
    ++share;
    if (!waiting.contains(cell)) open.push_back(cell);
  }
  if (merges && !open.empty())
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
  fmt::print("Finished shard {}/{}, {} of {} cells; the same command with --merge puts all shards together\n",
             sharing.shard + 1, sharing.shards, share, study.cells);
  return false;
}

}  // namespace

bool run(const Study& study, const Sharing& sharing, const OutputOptions& options, const Add& add) {
  const char* const instead = study.description.empty() ? "run it without mpirun" : "use --shard I/N and --merge";
  const auto ranks = sharing.shards == 1 && sharing.merged.empty() ? joined(instead) : nullptr;
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
         "Only a share of the work, 1/N … N/N, for N machines; see --merge")
      .type("I/N");
  app.option("--merge", sharing.merged, "The results out of all shards: the directories that --shard … --out wrote")
      .type("DIR");
}

Statistic Statistic::mean(std::span<const double> sums, std::span<const double> counts) {
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  const double count = std::accumulate(counts.begin(), counts.end(), 0.0);
  const double of_a_batch = count / static_cast<double>(counts.size());
  Statistic result;
  result.value_ = sum / count;
  for (std::size_t i = 0; i < sums.size(); ++i)
    result.change_.push_back((sums[i] - result.value_ * counts[i]) / of_a_batch);
  return result;
}

Interval Statistic::interval(std::size_t together) const {
  const auto n = static_cast<double>(change_.size());
  if (n < 2.0) return {value_, std::numeric_limits<double>::infinity()};
  const double squares = std::inner_product(change_.begin(), change_.end(), change_.begin(), 0.0);
  const double student =
      boost::math::quantile(boost::math::students_t(n - 1.0), 1.0 - 0.025 / static_cast<double>(together));
  return {value_, student * std::sqrt(squares / (n - 1.0) / n)};
}

std::vector<double> Statistic::numbers() const {
  std::vector<double> all = change_;
  all.push_back(value_);
  return all;
}

Statistic Statistic::of(std::span<const double> numbers) {
  Statistic result;
  result.value_ = numbers.back();
  result.change_.assign(numbers.begin(), numbers.end() - 1);
  return result;
}

}  // namespace sigmax::apps
