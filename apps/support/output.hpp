#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace sigmax::apps {

/// A file that appears whole or not at all: written beside its place under another name, and renamed by `commit`. What
/// is not committed is removed. Failures (a full disk, a directory without permission) throw InputError with path and
/// reason; more than 16 files at a time throw std::logic_error.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  const std::filesystem::path& path() const { return path_; }

  void write(std::string_view text);

  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    write(fmt::format(format, std::forward<Arguments>(arguments)...));
  }

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
  std::optional<std::size_t> place_;  // in the list of unfinished files
};

/// Commits files that belong together: none is put into its place before all are on the disk.
template <class... Files>
void commit_all(Files&... files) {
  (files.store(), ...);
  (files.commit(), ...);
}

/// Removes what uncommitted files of this program have written. A signal handler may call it if the program ends then.
void remove_unfinished_files() noexcept;

/// A directory for results; it is created, with its parents, unless it exists. Throws InputError with path and reason.
class OutputDirectory {
 public:
  explicit OutputDirectory(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  AtomicFile file(std::string_view name) const { return AtomicFile{path_ / name}; }

 private:
  std::filesystem::path path_;
};

/// The shortest decimal number that reads back as the same double.
std::string shortest(double value);

/// The same as TOML reads it back: with a point where it would be an integer that no double may stand for.
std::string toml_number(double value);

}  // namespace sigmax::apps
