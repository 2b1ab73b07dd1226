#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/core/mean_interval.hpp>

#include "shell/command_line.hpp"

namespace sigmax::apps {

/// What the cells of a study gave, by the number of the cell.
using CellRows = std::map<std::size_t, std::vector<double>>;

/// A journal as it lies on the disk, which may still be growing: a first line that describes the study, then a line
/// "cell,number,number,…" for each finished cell, each with its checksum. Numbers read back as the same doubles. A line
/// counts when its end is there.
struct Journaled {
  std::string study;
  CellRows rows;
};

/// Throws InputError, with the line, for what is no journal, and where a checksum is not that of its line.
Journaled read_journal(const std::filesystem::path& path);

/// A line of a journal with its checksum, CRC-32, and its end: "0,1.5 #f5fa1db5".
std::string sealed(std::string_view line);

/// The sealed line of a cell.
std::string journal_line(std::size_t cell, const std::vector<double>& row);

/// Throws InputError with the first option that differs unless the journal is of the study that was expected.
void require_study(const std::filesystem::path& journal, std::string_view found, std::string_view expected,
                   std::string_view what, std::string_view remedy = {});

/// The journal of a study that goes on. What a killed program left of its last line is cut off, and damaged lines are
/// taken out with a warning, so that their cells are done again.
///
///     Journal journal("results/cells.journal", "himm_demo sweep {…}");
///     for (…) if (!journal.rows().contains(cell)) journal.append({{cell, work(cell)}});
///     journal.finish();
class Journal {
 public:
  /// Opens the journal of that study or begins it. Throws InputError if the file is of another study, if another
  /// program has it open, or if it cannot be read or written.
  Journal(std::filesystem::path path, std::string study);

  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  const CellRows& rows() const { return all_.rows; }

  /// Brings finished cells to the disk, behind the others.
  void append(const CellRows& rows);

  /// Puts the same cells into their order, so that the file does not tell how often the work was interrupted.
  void finish();

 private:
  explicit Journal(std::filesystem::path path);  // the other one goes on from here, so what it throws closes the file

  [[noreturn]] void fail() const;
  void write(const std::string& text);

  std::filesystem::path path_;
  Journaled all_;
  int descriptor_;
};

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

/// A smooth function of means over independent batches of runs, with its first-order change with each batch (the delta
/// method). Statistics of the same batches are paired: what they share cancels.
///
///     const Statistic imm = sqrt(Statistic::mean(imm_squares, runs));    // sums and counts, by batch
///     const Statistic himm = sqrt(Statistic::mean(himm_squares, runs));
///     (himm / imm - 1.0).interval(9);   // one of nine intervals that hold together with 95 %
class Statistic {
 public:
  /// Σ sums / Σ counts; NaN without counts.
  static Statistic mean(std::span<const double> sums, std::span<const double> counts);

  double value() const { return value_; }

  /// @{
  /// All that it knows, as numbers in a row, and out of them again.
  std::vector<double> numbers() const;
  static Statistic of(std::span<const double> numbers);
  /// @}

  /// value ± t s/√B over B batches, by Student's t with B − 1 degrees of freedom and Bonferroni's share of the 5 % for
  /// one of so many intervals that hold together. Without a second batch the half width is infinite.
  Interval interval(std::size_t together = 1) const;

  friend Statistic sqrt(const Statistic& a) {
    const double root = std::sqrt(a.value_);
    return combined(root, a, root > 0.0 ? 0.5 / root : 0.0, a, 0.0);
  }
  friend Statistic operator+(const Statistic& a, const Statistic& b) {
    return combined(a.value_ + b.value_, a, 1.0, b, 1.0);
  }
  friend Statistic operator-(const Statistic& a, const Statistic& b) {
    return combined(a.value_ - b.value_, a, 1.0, b, -1.0);
  }
  friend Statistic operator/(const Statistic& a, const Statistic& b) {
    return combined(a.value_ / b.value_, a, 1.0 / b.value_, b, -a.value_ / (b.value_ * b.value_));
  }
  friend Statistic operator+(const Statistic& a, double b) { return combined(a.value_ + b, a, 1.0, a, 0.0); }
  friend Statistic operator-(const Statistic& a, double b) { return a + -b; }
  friend Statistic operator*(const Statistic& a, double b) { return combined(a.value_ * b, a, b, a, 0.0); }

 private:
  /// A function of two with its derivatives.
  static Statistic combined(double value, const Statistic& a, double by_a, const Statistic& b, double by_b) {
    Statistic result;
    result.value_ = value;
    result.change_.resize(a.change_.size());
    for (std::size_t i = 0; i < a.change_.size(); ++i)
      result.change_[i] = by_a * a.change_[i] + (by_b != 0.0 ? by_b * b.change_[i] : 0.0);
    return result;
  }

  double value_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> change_;  // by batch; their mean is 0
};

}  // namespace sigmax::apps
