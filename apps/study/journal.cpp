#include "study/study.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <charconv>

#include "shell/files.hpp"
#include "shell/text.hpp"

namespace sigmax::apps {
namespace {

constexpr std::string_view damage = "the line is damaged: its checksum is another";
constexpr std::size_t seal_size = std::string_view(" #01234567\n").size();

/// Reads one "cell,number,number,…" into the rows; false if it is something else.
bool read_line(std::string_view line, CellRows& rows) {
  const char* at = line.data();
  const char* const end = at + line.size();
  std::size_t cell = 0;
  const auto number = std::from_chars(at, end, cell);
  if (number.ec != std::errc{}) return false;
  std::vector<double> row;
  for (at = number.ptr; at != end;) {
    if (*at++ != ',') return false;
    double value = 0.0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc{}) return false;
    row.push_back(value);
    at = read.ptr;
  }
  rows.insert_or_assign(cell, std::move(row));
  return true;
}

/// What a text holds of a journal.
struct Reading {
  Journaled journal;
  std::size_t sound = 0;             ///< bytes before the first line that does not count
  std::vector<std::size_t> damaged;  ///< lines
};

/// Throws InputError if the first line, without which the others say nothing, is not as it was written.
Reading parsed(const std::filesystem::path& path, std::string_view text) {
  Reading reading;
  std::size_t begin = 0, end = 0;
  for (std::size_t number = 1; (end = text.find('\n', begin)) != std::string_view::npos; ++number) {
    const std::string_view found = text.substr(begin, end + 1 - begin);
    const bool has_seal = found.size() >= seal_size && found.substr(found.size() - seal_size).starts_with(" #");
    const std::string_view line = has_seal ? found.substr(0, found.size() - seal_size) : found;
    const bool as_written = has_seal && found == sealed(line);
    if (number == 1 && !as_written)
      throw InputError({.where = path.native() + ":1",
                        .what = has_seal ? damage : "the line has no checksum, so an older version wrote this journal",
                        .remedy = fmt::format("{}, or delete the file and give its command again, which starts anew",
                                              has_seal ? "copy the file again" : "go on and merge by that version")});
    if (number == 1)
      reading.journal.study = line;
    else if (!as_written || !read_line(line, reading.journal.rows))
      reading.damaged.push_back(number);
    begin = end + 1;
    if (reading.damaged.empty()) reading.sound = begin;
  }
  return reading;
}

/// "himm_demo 0.1.0 sweep", "--scenario 2", …
std::vector<std::string_view> options_of(std::string_view study) {
  std::vector<std::string_view> options;
  for (std::size_t begin = 0;;) {
    const std::size_t end = study.find(" --", begin);
    options.push_back(study.substr(begin, end - begin));
    if (end == std::string_view::npos) return options;
    begin = end + 1;
  }
}

}  // namespace

std::string sealed(std::string_view line) {
  boost::crc_32_type sum;
  sum.process_bytes(line.data(), line.size());
  return fmt::format("{} #{:08x}\n", line, sum.checksum());
}

std::string journal_line(std::size_t cell, const std::vector<double>& row) {
  std::string line = fmt::format("{}", cell);
  for (const double value : row) line.append(",").append(shortest(value));
  return sealed(line);
}

Journaled read_journal(const std::filesystem::path& path) {
  auto [journal, sound, damaged] = parsed(path, read_text(path));
  if (journal.study.empty()) throw InputError("{}: is empty: expected the journal of a campaign", path.native());
  if (!damaged.empty())
    throw InputError({.where = fmt::format("{}:{}", path.native(), damaged.front()),
                      .what = damage,
                      .remedy = "copy the file again, or give its command again, which mends it"});
  return std::move(journal);
}

void require_study(const std::filesystem::path& journal, std::string_view found, std::string_view expected,
                   std::string_view what, std::string_view remedy) {
  if (found == expected) return;
  const auto theirs = options_of(found), ours = options_of(expected);
  const auto [their, our] = std::mismatch(theirs.begin(), theirs.end(), ours.begin(), ours.end());
  const auto whole = [](const auto& options, auto option) {
    return option == options.end() ? "no further option" : fmt::format("'{}'", printable(*option));
  };
  throw InputError({.where = journal.native() + ":1",
                    .what = what,
                    .found = whole(theirs, their),
                    .expected = whole(ours, our),
                    .remedy = remedy});
}

Journal::Journal(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {}

Journal::Journal(std::filesystem::path path, std::string study) : Journal(std::move(path)) {
  if (descriptor_ < 0) fail();
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError("{}: another program is writing this journal; wait until it ends, or give another --out",
                     path_.native());
  auto [journal, sound, damaged] = parsed(path_, read_text(path_));
  if (sound > 0)
    require_study(path_, journal.study, study, "the directory holds another campaign",
                  "give the same options, or another --out");
  if (::ftruncate(descriptor_, static_cast<off_t>(sound)) != 0) fail();
  all_.study = std::move(study);
  if (sound == 0) write(sealed(all_.study));
  if (damaged.empty()) {
    all_.rows = std::move(journal.rows);
    return;
  }
  const std::string others = damaged.size() > 1 ? fmt::format(", and {} below it", damaged.size() - 1) : "";
  complain("himm_demo: warning: " + message({.where = fmt::format("{}:{}", path_.native(), damaged.front()),
                                             .what = fmt::format("{}{}", damage, others),
                                             .remedy = "what it said is computed again"}));
  append(journal.rows);
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::fail() const {
  throw InputError("{}: cannot be written: {}; make room there, or give another --out; what is finished is kept",
                   path_.native(), reason(errno));
}

void Journal::write(const std::string& text) {
  if (!write_all(descriptor_, text)) fail();
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) fail();
}

void Journal::append(const CellRows& rows) {
  std::string text;
  for (const auto& [cell, row] : rows) {
    text += journal_line(cell, row);
    all_.rows.insert_or_assign(cell, row);
  }
  if (!text.empty()) write(text);
}

void Journal::finish() {
  AtomicFile sorted(path_);
  sorted.write(sealed(all_.study));
  for (const auto& [cell, row] : all_.rows) sorted.write(journal_line(cell, row));
  sorted.commit();
}

}  // namespace sigmax::apps
