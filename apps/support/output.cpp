#include "support/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "support/error.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t written_at_once = std::size_t{1} << 16;

/// The names of the temporary files that there are, where a signal handler can read them.
struct Unfinished {
  std::atomic<bool> taken = false;
  std::atomic<bool> named = false;
  std::array<char, PATH_MAX> name{};
};
std::array<Unfinished, 16> unfinished;

std::size_t take_place() {
  for (std::size_t place = 0; place < unfinished.size(); ++place)
    if (!unfinished[place].taken.exchange(true)) return place;
  throw std::logic_error(fmt::format("more than {} files are written at a time", unfinished.size()));
}

void name_place(std::size_t place, const std::string& name) {
  auto& entry = unfinished[place];
  entry.named = false;
  if (name.size() >= entry.name.size()) return;  // too long to be opened
  std::copy(name.begin(), name.end(), entry.name.begin());
  entry.name[name.size()] = '\0';
  entry.named = true;
}

void free_place(std::size_t place) {
  unfinished[place].named = false;
  unfinished[place].taken = false;
}

/// What helps against a failure to write.
std::string_view remedy(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room there, or choose another place";
    default:
      return "choose another place";
  }
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), place_(take_place()) {
  // Not mkstemp: its files are the owner's alone, whatever the umask says. A name is taken only by the remains of a
  // killed program of the same number, or by another writer of this one.
  for (int attempt = 0; descriptor_ < 0; ++attempt) {
    temporary_ = path_;
    temporary_.replace_filename(fmt::format(".{}.{}-{}.part", path_.filename().native(), ::getpid(), attempt));
    name_place(*place_, temporary_);  // before it exists, so that an interrupt finds it
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) {
      const int error_number = errno;
      temporary_.clear();
      fail(error_number);
    }
  }
  buffer_.reserve(written_at_once);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      place_(std::exchange(other.place_, std::nullopt)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this != &other) {
    discard();
    path_ = std::move(other.path_);
    temporary_ = std::exchange(other.temporary_, {});
    buffer_ = std::move(other.buffer_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    place_ = std::exchange(other.place_, std::nullopt);
  }
  return *this;
}

AtomicFile::~AtomicFile() { discard(); }

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
  for (std::string_view rest = buffer_; !rest.empty();) {
    const auto written = ::write(descriptor_, rest.data(), rest.size());
    if (written >= 0)
      rest.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      fail(errno);
  }
  buffer_.clear();
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  if (place_) free_place(*place_);
  place_.reset();
}

void AtomicFile::fail(int error_number) {
  discard();
  throw InputError(message(
      {.where = path_.native(), .what = "cannot be written: " + reason(error_number), .remedy = remedy(error_number)}));
}

void remove_unfinished_files() noexcept {
  for (const auto& entry : unfinished)
    if (entry.named) ::unlink(entry.name.data());
}

OutputDirectory::OutputDirectory(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (!error && !std::filesystem::is_directory(path_, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw InputError(message({.where = path_.native(),
                              .what = "the directory cannot be created: " + reason(error.value()),
                              .remedy = remedy(error.value())}));
}

std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

std::string toml_number(double value) {
  std::string text = shortest(value);
  if (std::abs(value) >= 0x1p53 && text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace sigmax::apps
