#include "support/scratch.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "support/error.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t most_held = std::size_t{1} << 20;

std::filesystem::path directory() {
  const char* asked = std::getenv("TMPDIR");
  return asked != nullptr && *asked != '\0' ? asked : "/tmp";
}

[[noreturn]] void fail(const std::string& what, int error_number) {
  throw InputError(message({.where = directory().native(),
                            .what = "a temporary file for the rows cannot be " + what + ": " + reason(error_number),
                            .remedy = "make room there, or name another directory by the variable TMPDIR"}));
}

/// Calls transfer(done), which returns how many bytes it moved, until all are.
template <class Transfer>
void all_of(std::size_t count, const std::string& what, const Transfer& transfer) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t moved = transfer(done);
    if (moved > 0)
      done += static_cast<std::size_t>(moved);
    else if (moved == 0 || errno != EINTR)
      fail(what, moved == 0 ? EIO : errno);
  }
}

void write_all(int descriptor, std::uint64_t first, std::span<const std::byte> bytes) {
  all_of(bytes.size(), "written", [&](std::size_t done) {
    return ::pwrite(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(first + done));
  });
}

}  // namespace

Scratch::Scratch(Scratch&& other) noexcept
    : held_(std::move(other.held_)),
      in_file_(std::exchange(other.in_file_, 0)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

Scratch& Scratch::operator=(Scratch&& other) noexcept {
  std::swap(held_, other.held_);
  std::swap(in_file_, other.in_file_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

Scratch::~Scratch() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Scratch::open() {
  std::string name = (directory() / "sigmax-XXXXXX").native();
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("made", errno);
  ::unlink(name.c_str());
}

void Scratch::append(std::span<const std::byte> bytes) {
  if (held_.size() + bytes.size() > most_held) {
    if (descriptor_ < 0) open();
    write_all(descriptor_, in_file_, held_);
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
  all_of(filed, "read", [&](std::size_t done) {
    return ::pread(descriptor_, bytes.data() + done, filed - done, static_cast<off_t>(first + done));
  });
  if (filed == bytes.size()) return;
  std::copy_n(held_.begin() + static_cast<std::ptrdiff_t>(first + filed - in_file_), bytes.size() - filed,
              bytes.begin() + static_cast<std::ptrdiff_t>(filed));
}

void Scratch::overwrite(std::uint64_t first, std::span<const std::byte> bytes) {
  assert(first + bytes.size() <= size());
  const std::size_t filed = in_file(first, bytes.size());
  write_all(descriptor_, first, bytes.first(filed));
  if (filed == bytes.size()) return;
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(filed), bytes.end(),
            held_.begin() + static_cast<std::ptrdiff_t>(first + filed - in_file_));
}

}  // namespace sigmax::apps
