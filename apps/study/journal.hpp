#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sigmax::apps {

/// What the cells of a campaign gave, by the number of the cell.
using CellRows = std::map<std::size_t, std::vector<double>>;

/// A file of finished cells: a first line that says of what campaign, then a line "cell,number,number,…" for each cell
/// in the order in which they were finished. Numbers read back as the same doubles. A line counts when its end is
/// there: what a killed program left of its last one is cut off when the journal is opened again.
///
///     Journal journal("results/cells.journal", "himm_demo sweep {…}");
///     for (…) if (!journal.rows().contains(cell)) journal.append(cell, work(cell));
///     journal.finish();
class Journal {
 public:
  /// Opens the journal of that campaign or begins it. Throws InputError if the file is of another campaign, if another
  /// program has it open, or if it cannot be read or written.
  Journal(std::filesystem::path path, std::string campaign);

  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  const CellRows& rows() const { return rows_; }

  /// Writes a finished cell behind the others.
  void append(std::size_t cell, std::vector<double> row);

  /// Brings to the disk what was appended.
  void store();

  /// Puts the same cells into their order, so that the file does not tell how often the work was interrupted.
  void finish();

 private:
  [[noreturn]] void fail() const;
  void write(const std::string& text);

  std::filesystem::path path_;
  std::string campaign_;
  CellRows rows_;
  int descriptor_ = -1;
};

/// A journal as it lies on the disk, which may still be growing.
struct ReadJournal {
  std::string campaign;
  CellRows rows;
};

/// Throws InputError, with the line, for what is no journal.
ReadJournal read_journal(const std::filesystem::path& path);

/// The line of a cell in a journal, with its end.
std::string journal_line(std::size_t cell, const std::vector<double>& row);

}  // namespace sigmax::apps
