#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sigmax::apps {

/// The same program started many times by mpirun. The first rank hands out cells of work and takes what they give; the
/// others do the work, one cell at a time.
class Ranks {
 public:
  /// Joins the other ranks; null where the program runs alone. Throws UsageError if mpirun started a build without MPI.
  static std::unique_ptr<Ranks> join();

  virtual ~Ranks() = default;

  /// Whether this rank is the one that hands out.
  virtual bool first() const = 0;

  using Finished = std::vector<std::pair<std::size_t, std::vector<double>>>;

  /// Gives each cell to the next rank that is free; finished(cells) gets what has come in meanwhile.
  virtual void hand_out(std::span<const std::size_t> cells, const std::function<void(Finished)>& finished) = 0;

  /// Does what the first rank hands out, until nothing is left.
  virtual void serve(const std::function<std::vector<double>(std::size_t)>& work) = 0;

  /// Prints the message and ends all ranks: a single one cannot leave.
  [[noreturn]] virtual void abort(const std::string& message) = 0;
};

}  // namespace sigmax::apps
