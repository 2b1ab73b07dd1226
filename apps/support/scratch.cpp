#include "support/scratch.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "support/error.hpp"

namespace sigmax::apps {
namespace {

std::filesystem::path directory() {
  const char* asked = std::getenv("TMPDIR");
  return asked != nullptr && *asked != '\0' ? asked : "/tmp";
}

constexpr std::size_t most_held = std::size_t{1} << 20;

}  // namespace

UnnamedFile::UnnamedFile(std::string purpose) : purpose_(std::move(purpose)) {
  std::string name = (directory() / "sigmax-XXXXXX").native();
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("made", errno);
  ::unlink(name.c_str());
}

UnnamedFile::~UnnamedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void UnnamedFile::fail(const char* what, int error_number) const {
  throw InputError({.where = directory().native(),
                    .what = "a temporary file for " + purpose_ + " cannot be " + what + ": " + reason(error_number),
                    .remedy = "make room there, or name another directory by the variable TMPDIR"});
}

/// Calls transfer(done), which returns how many bytes it moved, until all are.
template <class Transfer>
void UnnamedFile::all_of(std::size_t count, const char* what, const Transfer& transfer) const {
  for (std::size_t done = 0; done < count;) {
    const ssize_t moved = transfer(done);
    if (moved > 0)
      done += static_cast<std::size_t>(moved);
    else if (moved == 0 || errno != EINTR)
      fail(what, moved == 0 ? EIO : errno);
  }
}

std::uint64_t UnnamedFile::size() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail("read", errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void UnnamedFile::write(std::uint64_t first, std::span<const std::byte> bytes) const {
  all_of(bytes.size(), "written", [&](std::size_t done) {
    return ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(first + done));
  });
}

void UnnamedFile::read(std::uint64_t first, std::span<std::byte> bytes) const {
  all_of(bytes.size(), "read", [&](std::size_t done) {
    return ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(first + done));
  });
}

void Scratch::append(std::span<const std::byte> bytes) {
  if (held_.size() + bytes.size() > most_held) {
    if (!filed_) filed_ = std::make_unique<Filed>();
    filed_->file.write(filed_->size, held_);
    filed_->size += held_.size();
    held_.clear();
  }
  held_.insert(held_.end(), bytes.begin(), bytes.end());
}

/// How many of these bytes are in the file.
std::size_t Scratch::in_file(std::uint64_t first, std::size_t count) const {
  return first < in_file() ? std::min<std::uint64_t>(count, in_file() - first) : 0;
}

void Scratch::read(std::uint64_t first, std::span<std::byte> bytes) const {
  assert(first + bytes.size() <= size());
  const std::size_t filed = in_file(first, bytes.size());
  if (filed > 0) filed_->file.read(first, bytes.first(filed));
  if (filed == bytes.size()) return;
  std::copy_n(held_.begin() + static_cast<std::ptrdiff_t>(first + filed - in_file()), bytes.size() - filed,
              bytes.begin() + static_cast<std::ptrdiff_t>(filed));
}

void Scratch::overwrite(std::uint64_t first, std::span<const std::byte> bytes) {
  assert(first + bytes.size() <= size());
  const std::size_t filed = in_file(first, bytes.size());
  if (filed > 0) filed_->file.write(first, bytes.first(filed));
  if (filed == bytes.size()) return;
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(filed), bytes.end(),
            held_.begin() + static_cast<std::ptrdiff_t>(first + filed - in_file()));
}

}  // namespace sigmax::apps
