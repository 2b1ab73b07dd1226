#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace sigmax::apps {

/// A temporary file without a name, so that it is gone with the program; in $TMPDIR, else in /tmp. What cannot be made,
/// written or read is an InputError, which says where and why.
class UnnamedFile {
 public:
  /// What it is for ends the message: "the rows".
  explicit UnnamedFile(std::string purpose);
  UnnamedFile(UnnamedFile&& other) noexcept
      : purpose_(std::move(other.purpose_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  UnnamedFile& operator=(UnnamedFile&& other) noexcept {
    std::swap(purpose_, other.purpose_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~UnnamedFile();

  int descriptor() const { return descriptor_; }
  std::uint64_t size() const;

  /// From some byte on; what is read must be there.
  void write(std::uint64_t first, std::span<const std::byte> bytes) const;
  void read(std::uint64_t first, std::span<std::byte> bytes) const;

 private:
  [[noreturn]] void fail(const char* what, int error_number) const;
  template <class Transfer>
  void all_of(std::size_t count, const char* what, const Transfer& transfer) const;

  std::string purpose_;
  int descriptor_;
};

}  // namespace sigmax::apps
