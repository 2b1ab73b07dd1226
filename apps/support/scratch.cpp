#include "support/scratch.hpp"

#include <algorithm>
#include <cassert>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_held = std::size_t{1} << 20;

}  // namespace

void Scratch::append(std::span<const std::byte> bytes) {
  if (held_.size() + bytes.size() > most_held) {
    if (!file_) file_.emplace("the rows");
    file_->write(in_file_, held_);
    in_file_ += held_.size();
    held_.clear();
  }
  held_.insert(held_.end(), bytes.begin(), bytes.end());
}

/// How many of these bytes are in the file.
std::size_t Scratch::in_file(std::uint64_t first, std::size_t count) const {
  return first < in_file_ ? std::min<std::uint64_t>(count, in_file_ - first) : 0;
}

void Scratch::read(std::uint64_t first, std::span<std::byte> bytes) const {
  assert(first + bytes.size() <= size());
  const std::size_t filed = in_file(first, bytes.size());
  if (filed > 0) file_->read(first, bytes.first(filed));
  if (filed == bytes.size()) return;
  std::copy_n(held_.begin() + static_cast<std::ptrdiff_t>(first + filed - in_file_), bytes.size() - filed,
              bytes.begin() + static_cast<std::ptrdiff_t>(filed));
}

void Scratch::overwrite(std::uint64_t first, std::span<const std::byte> bytes) {
  assert(first + bytes.size() <= size());
  const std::size_t filed = in_file(first, bytes.size());
  if (filed > 0) file_->write(first, bytes.first(filed));
  if (filed == bytes.size()) return;
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(filed), bytes.end(),
            held_.begin() + static_cast<std::ptrdiff_t>(first + filed - in_file_));
}

}  // namespace sigmax::apps
