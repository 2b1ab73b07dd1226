#include "study/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/input.hpp"
#include "support/output.hpp"

namespace sigmax::apps {
namespace {

InputError bad_line(const std::filesystem::path& path, std::size_t line, std::string_view found) {
  return InputError(message({.where = fmt::format("{}:{}", path.native(), line),
                             .found = in_quotes(found),
                             .expected = "the number of a cell and what it gave, with commas between",
                             .remedy = "delete the file, and the work starts anew"}));
}

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

/// The journal in a text, and how much of the text its whole lines are.
std::pair<ReadJournal, std::size_t> parsed(const std::filesystem::path& path, std::string_view text) {
  ReadJournal journal;
  std::size_t begin = 0;
  for (std::size_t line = 1;; ++line) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return {std::move(journal), begin};
    const std::string_view found = text.substr(begin, end - begin);
    if (line == 1)
      journal.campaign = found;
    else if (!read_line(found, journal.rows))
      throw bad_line(path, line, found);
    begin = end + 1;
  }
}

}  // namespace

std::string journal_line(std::size_t cell, const std::vector<double>& row) {
  std::string line = fmt::format("{}", cell);
  for (const double value : row) line.append(",").append(shortest(value));
  return line + "\n";
}

ReadJournal read_journal(const std::filesystem::path& path) {
  auto journal = parsed(path, read_text(path)).first;
  if (journal.campaign.empty())
    throw InputError(message({.where = path.native(), .what = "is empty", .expected = "the journal of a campaign"}));
  return journal;
}

Journal::Journal(std::filesystem::path path, std::string campaign)
    : path_(std::move(path)), campaign_(std::move(campaign)) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail();
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError(message({.where = path_.native(),
                              .what = "another program is writing this journal",
                              .remedy = "wait until it ends, or give another --out"}));
  auto [journal, whole] = parsed(path_, read_text(path_));
  if (::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0) fail();
  if (whole == 0) {
    write(campaign_ + "\n");
    store();
  } else if (journal.campaign != campaign_) {
    throw InputError(message({.where = path_.native() + ":1",
                              .what = "the directory holds another campaign",
                              .found = in_quotes(journal.campaign),
                              .expected = in_quotes(campaign_),
                              .remedy = "give the same options, or another --out"}));
  }
  rows_ = std::move(journal.rows);
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::fail() const {
  throw InputError(message({.where = path_.native(),
                            .what = "cannot be written: " + reason(errno),
                            .remedy = "make room there, or give another --out; what is finished is kept"}));
}

void Journal::write(const std::string& text) {
  for (std::string_view rest = text; !rest.empty();) {
    const auto written = ::write(descriptor_, rest.data(), rest.size());
    if (written >= 0)
      rest.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      fail();
  }
}

void Journal::append(std::size_t cell, std::vector<double> row) {
  write(journal_line(cell, row));
  rows_.insert_or_assign(cell, std::move(row));
}

void Journal::store() {
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) fail();
}

void Journal::finish() {
  AtomicFile sorted(path_);
  sorted.write(campaign_ + "\n");
  for (const auto& [cell, row] : rows_) sorted.write(journal_line(cell, row));
  sorted.commit();
}

}  // namespace sigmax::apps
