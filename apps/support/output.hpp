#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace sigmax::apps {

/// A file that appears whole or not at all: written beside its place under another name, and renamed by `commit`. What
/// is not committed is removed. Failures (a full disk, a directory without permission) throw InputError with path and
/// reason.
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
};

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

}  // namespace sigmax::apps
