#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace sigmax::apps {

/// Opens a file for reading bytes. Throws InputError with the reason if it is a directory or cannot be read.
std::ifstream open_input(const std::filesystem::path& path);

/// All bytes of a file; throws InputError as `open_input` does, and if reading fails half-way.
std::string read_text(const std::filesystem::path& path);

struct UnfinishedFile;

/// A file that appears whole or not at all: written beside its place under another name, and renamed by `commit`. What
/// is not committed is removed. Failures (a full disk, a directory without permission) throw InputError with path and
/// reason; more than 16 files at a time throw std::logic_error.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);

  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() { discard(); }

  const std::filesystem::path& path() const { return path_; }

  void write(std::string_view text);

  /// Brings to the disk what was written so far: the failures that a commit can have come before it.
  void store();

  /// Puts the file into its place, over an older one. Nothing can be written afterwards.
  void commit();

 private:
  void flush();
  void discard() noexcept;
  [[noreturn]] void fail(int error_number);

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::string buffer_;
  int descriptor_ = -1;
  UnfinishedFile* listed_;  // where a signal handler finds it
};

/// Writes such a file at once.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Writes all to a descriptor; false, with errno, where that fails.
bool write_all(int descriptor, std::string_view text);

/// Removes what uncommitted files of this program have written. A signal handler may call it if the program ends then.
void remove_unfinished_files() noexcept;

/// Creates a directory for results, with its parents, unless it exists, and returns it. Throws InputError with path and
/// reason.
std::filesystem::path output_directory(std::filesystem::path path);

}  // namespace sigmax::apps
