#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fuzz/require.hpp"

namespace sigmax::fuzz {

/// A file in memory, so that reading a thousand of them in a second wears no disk.
class MemoryFile {
 public:
  MemoryFile() = default;
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { std::filesystem::remove(path_); }

  const std::filesystem::path& path() const { return path_; }

  /// The path of the file, which holds the text from now on.
  const std::filesystem::path& holding(std::string_view text) const {
    require((std::ofstream{path_, std::ios::binary} << text).flush().good(), "a file in memory can be written");
    return path_;
  }

 private:
  std::filesystem::path path_ = "/dev/shm/sigmax-fuzz-" + std::to_string(::getpid());
};

}  // namespace sigmax::fuzz
