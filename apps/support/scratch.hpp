#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace sigmax::apps {

/// A temporary file without a name, so that it is gone with the program; in $TMPDIR, else in /tmp. What cannot be made,
/// written or read is an InputError, which says where and why.
class UnnamedFile {
 public:
  /// What it is for ends the message: "the rows".
  explicit UnnamedFile(std::string purpose);
  UnnamedFile(const UnnamedFile&) = delete;
  UnnamedFile& operator=(const UnnamedFile&) = delete;
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

/// Plain values that are written once and read often, in memory that does not grow with them: those of the last MiB are
/// held, those before are in an UnnamedFile. Different threads may read, and overwrite different values, at a time.
template <class T>
  requires std::is_trivially_copyable_v<T>
class ScratchArray {
 public:
  std::size_t size() const { return in_file() + held_.size(); }

  void push_back(const T& value) {
    constexpr std::size_t most_held = (std::size_t{1} << 20U) / sizeof(T);
    if (held_.size() == most_held) {
      if (!filed_) filed_ = std::make_unique<Filed>();
      filed_->file.write(filed_->count * sizeof(T), std::as_bytes(std::span(held_)));
      filed_->count += held_.size();
      held_.clear();
    }
    held_.push_back(value);
  }

  /// Reads the values from some place on; all of them must be there.
  void read(std::size_t first, std::span<T> values) const {
    const std::size_t filed = std::min(values.size(), in_file() - std::min(first, in_file()));
    if (filed > 0) filed_->file.read(first * sizeof(T), std::as_writable_bytes(values.first(filed)));
    for (std::size_t i = filed; i < values.size(); ++i) values[i] = held_[first + i - in_file()];
  }

  void set(std::size_t index, const T& value) {
    if (index < in_file())
      filed_->file.write(index * sizeof(T), std::as_bytes(std::span(&value, 1)));
    else
      held_[index - in_file()] = value;
  }

 private:
  struct Filed {
    UnnamedFile file{"the rows"};
    std::size_t count = 0;
  };
  std::size_t in_file() const { return filed_ ? filed_->count : 0; }

  std::vector<T> held_;
  std::unique_ptr<Filed> filed_;
};

/// Reads an array, which must outlive it and stay as it is, block by block: cheap if the indices ascend.
template <class T>
class ScratchCursor {
 public:
  explicit ScratchCursor(const ScratchArray<T>& array) : array_(&array) {}

  const T& operator[](std::size_t index) {
    if (index < first_ || index >= first_ + block_.size()) {
      constexpr std::size_t most = 4096;
      block_.resize(std::min(most, array_->size() - index));
      array_->read(index, block_);
      first_ = index;
    }
    return block_[index - first_];
  }

 private:
  const ScratchArray<T>* array_;
  std::size_t first_ = 0;
  std::vector<T> block_;
};

}  // namespace sigmax::apps
