#include "study/ranks.hpp"

#include <csignal>
#include <cstdlib>
#include <deque>

#include "support/command_line.hpp"
#include "support/error.hpp"

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
constexpr int tag_told = 3;  // from a worker: bytes
constexpr long none = -1;
constexpr std::size_t most_under_way = 1000;               // messages of bytes
constexpr std::size_t most_bytes = std::size_t{1} << 30U;  // of a message, whose size is an int; a full one goes on

class MpiRanks : public Ranks {
 public:
  MpiRanks() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (rank_ != 0) std::signal(SIGTERM, SIG_DFL);  // what ends all is the first one's to tell
  }
  ~MpiRanks() override {
    for (auto& [bytes, request] : under_way_) MPI_Wait(&request, MPI_STATUS_IGNORE);
    MPI_Barrier(MPI_COMM_WORLD);  // mpirun may crash or stay if the first aborts while others finalize
    MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void hand_out(std::span<const std::size_t> cells, const std::function<void(CellRows)>& take) override {
    std::size_t next = 0;
    for (int workers = size_ - 1; workers > 0;) {
      CellRows came;
      MPI_Status status;
      MPI_Probe(MPI_ANY_SOURCE, tag_row, MPI_COMM_WORLD, &status);
      for (int more = 1; more != 0; MPI_Iprobe(MPI_ANY_SOURCE, tag_row, MPI_COMM_WORLD, &more, &status)) {
        auto row = receive<std::vector<double>>(status, MPI_DOUBLE);
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

  void tell(std::string bytes) override {
    for (; bytes.size() >= most_bytes; bytes.erase(0, most_bytes)) send(bytes.substr(0, most_bytes));
    send(std::move(bytes));
  }

  std::string hear(int rank) override {
    std::string all, part;
    do {
      MPI_Status status;
      MPI_Probe(rank, tag_told, MPI_COMM_WORLD, &status);
      part = receive<std::string>(status, MPI_BYTE);
      all += part;
    } while (part.size() == most_bytes);
    return all;
  }

  void abort(const std::exception& error) override {
    complain(error);
    MPI_Abort(MPI_COMM_WORLD, exit_code(error));
    std::abort();
  }

 private:
  void send(std::string bytes) {
    auto& [kept, request] = under_way_.emplace_back(std::move(bytes), MPI_REQUEST_NULL);
    MPI_Isend(kept.data(), static_cast<int>(kept.size()), MPI_BYTE, 0, tag_told, MPI_COMM_WORLD, &request);
    if (under_way_.size() > most_under_way) MPI_Wait(&under_way_.front().second, MPI_STATUS_IGNORE);
    for (int arrived = 1; !under_way_.empty();) {
      MPI_Test(&under_way_.front().second, &arrived, MPI_STATUS_IGNORE);
      if (arrived == 0) return;
      under_way_.pop_front();
    }
  }

  template <class Values>
  static Values receive(const MPI_Status& status, MPI_Datatype type) {
    int count = 0;
    MPI_Get_count(&status, type, &count);
    Values values;
    values.resize(static_cast<std::size_t>(count));
    MPI_Recv(values.data(), count, type, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return values;
  }

  int rank_ = 0, size_ = 1;
  std::deque<std::pair<std::string, MPI_Request>> under_way_;
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
