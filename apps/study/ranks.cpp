#include "study/ranks.hpp"

#include <csignal>
#include <cstdlib>

#include "shell/command_line.hpp"
#include "shell/error.hpp"

#ifdef SIGMAX_MPI
#include <mpi.h>
#endif

namespace sigmax::apps {
namespace {

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

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (rank_ != 0) std::signal(SIGTERM, SIG_DFL);  // what ends all is the first one's to tell
  }
  ~MpiRanks() override {
    MPI_Barrier(MPI_COMM_WORLD);  // mpirun may crash or stay if the first aborts while others finalize
    MPI_Finalize();
  }

  bool first() const override { return rank_ == 0; }

  void hand_out(std::span<const std::size_t> cells, const std::function<void(CellRows)>& take) override {
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

  void serve(const std::function<std::vector<double>(std::size_t)>& work) override {
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

  void abort(const std::exception& error) override {
    complain(error);
    MPI_Abort(MPI_COMM_WORLD, exit_code(error));
    std::abort();
  }

 private:
  int rank_ = 0, size_ = 1;
};

#endif

}  // namespace

std::unique_ptr<Ranks> Ranks::join([[maybe_unused]] std::string_view instead) {
  if (!among_others()) return nullptr;
#ifdef SIGMAX_MPI
  return std::make_unique<MpiRanks>();
#else
  throw UsageError(
      "this build has no MPI, so mpirun would do the same work in every rank; {}, or configure with libopenmpi-dev "
      "installed",
      instead);
#endif
}

}  // namespace sigmax::apps
