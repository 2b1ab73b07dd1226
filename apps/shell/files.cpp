#include "shell/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <system_error>

#include "shell/text.hpp"

namespace sigmax::apps {

/// The name of a temporary file, where a signal handler can read it.
struct UnfinishedFile {
  std::atomic<bool> taken = false;
  std::atomic<bool> named = false;
  std::array<char, PATH_MAX> name{};
};

namespace {

std::array<UnfinishedFile, 16> unfinished;

UnfinishedFile* free_place() {
  for (UnfinishedFile& file : unfinished)
    if (!file.taken.exchange(true)) return &file;
  throw std::logic_error(fmt::format("more than {} files are written at a time", unfinished.size()));
}

void put_name(const std::string& name, UnfinishedFile& file) {
  file.named = false;
  if (name.size() >= file.name.size()) return;  // too long to be opened
  *std::copy(name.begin(), name.end(), file.name.begin()) = '\0';
  file.named = true;
}

constexpr std::size_t written_at_once = std::size_t{1} << 16;

/// What helps against a failure to write.
std::string_view remedy(int error_number) {
  const bool full = error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG;
  return full ? "make room there, or choose another place" : "choose another place";
}

}  // namespace

std::ifstream open_input(const std::filesystem::path& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown))
    throw InputError("{}: found a directory, expected a file; name one of the files in it", path.native());
  errno = 0;
  std::ifstream stream{path, std::ios::binary};
  if (!stream)
    throw InputError("{}: cannot be read: {}; see whether its name and permissions are right", path.native(),
                     reason(errno));
  return stream;
}

std::string read_text(const std::filesystem::path& path) {
  auto stream = open_input(path);
  std::string text;
  std::array<char, 1 << 14> block{};
  errno = 0;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0)
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw InputError("{}: cannot be read: {}", path.native(), reason(errno));
  return text;
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(descriptor, text.data(), text.size());
    if (written == 0 || (written < 0 && errno != EINTR)) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), listed_(free_place()) {
  // Not mkstemp: its files are the owner's alone, whatever the umask says. A name is taken only by the remains of a
  // killed program of the same number, or by another writer of this one.
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporary_ = path_;
    temporary_.replace_filename(fmt::format(".{}.{}-{}.part", path_.filename().native(), ::getpid(), attempt));
    put_name(temporary_, *listed_);  // before it exists, so that an interrupt finds it
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) {
      const int error_number = errno;
      temporary_.clear();
      fail(error_number);
    }
  }
  buffer_.reserve(written_at_once);
}

void AtomicFile::write(std::string_view text) {
  if (descriptor_ < 0) throw std::logic_error(path_.native() + " is written after its commit");
  buffer_ += text;
  if (buffer_.size() >= written_at_once) flush();
}

void AtomicFile::store() {
  if (descriptor_ < 0) throw std::logic_error(path_.native() + " is stored after its commit");
  flush();
  // Without this a power cut may leave the name and lose the contents; some file systems have no such call.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) fail(errno);
}

void AtomicFile::commit() {
  store();
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
  temporary_.clear();
  discard();
}

void AtomicFile::flush() {
  if (!write_all(descriptor_, buffer_)) fail(errno);
  buffer_.clear();
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  if (listed_ == nullptr) return;
  listed_->named = false;
  std::exchange(listed_, nullptr)->taken = false;
}

void AtomicFile::fail(int error_number) {
  discard();
  throw InputError(
      {.where = path_.native(), .what = "cannot be written: " + reason(error_number), .remedy = remedy(error_number)});
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void remove_unfinished_files() noexcept {
  for (const UnfinishedFile& file : unfinished)
    if (file.named) ::unlink(file.name.data());
}

std::filesystem::path output_directory(std::filesystem::path path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error && !std::filesystem::is_directory(path, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw InputError({.where = path.native(),
                      .what = "the directory cannot be created: " + reason(error.value()),
                      .remedy = remedy(error.value())});
  return path;
}

}  // namespace sigmax::apps
