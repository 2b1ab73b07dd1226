#include "support/scratch.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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

}  // namespace

UnnamedFile::UnnamedFile(std::string purpose) : purpose_(std::move(purpose)) {
  std::string name = (directory() / "sigmax-XXXXXX").native();
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail("made", errno);
  ::unlink(name.c_str());
}

UnnamedFile::~UnnamedFile() { ::close(descriptor_); }

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

}  // namespace sigmax::apps
