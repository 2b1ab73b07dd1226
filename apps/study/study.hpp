#pragma once

#include <cstddef>

#include "shell/command_line.hpp"

namespace sigmax::apps {

struct OutputOptions;

/// Work in cells that do not depend on each other, each of which gives a row of numbers.
///
///     const Study study{"runs", 100, [&](std::size_t run) { return figures_of(drawn(seed, run)); }};
///     if (run(study, {.threads = 4}, options, [&](std::size_t, const Row& row) { sums.add(row); })) report(sums);
struct Study {
  using Row = std::vector<double>;

  std::string name;  ///< of its cells, for the progress bar
  std::size_t cells;
  std::function<Row(std::size_t cell)> work;  ///< any thread calls it
  /// One line with all that the numbers depend on, if finished cells are to be kept in a journal.
  std::string description{};
};

/// Who does a study: threads, or the cells i, i + n, i + 2 n, … by one of several machines that know nothing of each
/// other.
struct Sharing {
  int threads = 0;  ///< 0: as many as the machine has
  std::size_t shard = 0, shards = 1;
  std::vector<std::string> merged{};  ///< directories of shards, which have done everything before
};

/// The name of the journal in the directory of the results.
inline constexpr const char* journal_name = "cells.journal";

/// Does what is not yet done of a study, by threads or, under mpirun, by ranks, and calls add(cell, row) in the order
/// of the cells; add keeps of it what it needs. With --out and a description every finished cell is on the disk at
/// once, and the next call goes on from there. What is added does not depend on threads, ranks, shards or
/// interruptions.
///
/// Throws what work throws, of the earliest cell, and InputError where the journal is another study's. Returns false
/// where there is nothing to report: on a rank that is not the first, and for one shard of several, which adds nothing.
bool run(const Study& study, const Sharing& sharing, const OutputOptions& options,
         const std::function<void(std::size_t cell, const Study::Row& row)>& add);

/// --shard, "1/4" … "4/4", and --merge.
void add_shard(Subcommand app, Sharing& sharing);

}  // namespace sigmax::apps
