#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sigmax::apps {

/// What the cells of a study gave, by the number of the cell.
using CellRows = std::map<std::size_t, std::vector<double>>;

/// A journal as it lies on the disk, which may still be growing: a first line that describes the study, then a line
/// "cell,number,number,…" for each finished cell. Numbers read back as the same doubles. A line counts when its end is
/// there.
struct Journaled {
  std::string study;
  CellRows rows;
};

/// Throws InputError, with the line, for what is no journal.
Journaled read_journal(const std::filesystem::path& path);

/// The line of a cell in a journal, with its end.
std::string journal_line(std::size_t cell, const std::vector<double>& row);

/// The journal of a study that goes on. What a killed program left of its last line is cut off.
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
  [[noreturn]] void fail() const;
  void write(const std::string& text);

  std::filesystem::path path_;
  Journaled all_;
  int descriptor_ = -1;
};

}  // namespace sigmax::apps
