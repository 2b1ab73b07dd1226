#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <span>

#include "study/journal.hpp"

namespace sigmax::apps {

/// The same program started many times by mpirun. The first rank hands out cells of work and takes what they give; the
/// others do the work, one cell at a time.
class Ranks {
 public:
  /// Joins the other ranks; null where the program runs alone. Throws UsageError, with what to do instead, if mpirun
  /// started a build without MPI.
  static std::unique_ptr<Ranks> join(std::string_view instead);

  virtual ~Ranks() = default;

  /// Whether this is the first one.
  virtual bool first() const = 0;

  /// Gives each cell to the next rank that is free; take(rows) gets what has come in meanwhile.
  virtual void hand_out(std::span<const std::size_t> cells, const std::function<void(CellRows)>& take) = 0;

  /// Does what the first rank hands out, until nothing is left.
  virtual void serve(const std::function<std::vector<double>(std::size_t)>& work) = 0;

  /// Prints what happened and ends all ranks: a single one cannot leave.
  [[noreturn]] virtual void abort(const std::exception& error) = 0;
};

}  // namespace sigmax::apps
