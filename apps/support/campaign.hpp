#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "support/command_line.hpp"
#include "support/journal.hpp"

namespace sigmax::apps {

/// Work in cells that do not depend on each other; each gives a row of numbers.
struct Campaign {
  std::string name;         ///< of the progress bar
  std::string description;  ///< one line with all that the numbers depend on
  std::size_t cells;
  std::function<std::vector<double>(std::size_t cell)> work;  ///< any thread calls it
};

/// The cells i, i + n, i + 2 n, … of a campaign that several machines share without knowing of each other.
struct Shard {
  std::size_t index = 0;
  std::size_t of = 1;
  bool finished = false;  ///< everything must have been done before

  bool has(std::size_t cell) const { return cell % of == index; }
};

/// The name of the journal in the directory of the results.
inline constexpr const char* journal_name = "cells.journal";

/// Does what is not yet done of a campaign's share, by threads or, under mpirun, by ranks. With --out every finished
/// cell is on the disk at once, and the next call goes on from there. The rows do not depend on threads, ranks, shards
/// or interruptions.
///
/// Throws what work throws, and InputError where the journal is another campaign's. Returns nothing where there is
/// nothing to report: on a rank that is not the first, and for one shard of several.
std::optional<CellRows> run(const Campaign& campaign, Shard shard, int threads, const OutputOptions& options);

/// --shard, "1/4" … "4/4"; and --finished, which help does not show.
void add_shard(CLI::App& app, Shard& shard);

}  // namespace sigmax::apps
