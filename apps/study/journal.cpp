#include "study/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/input.hpp"
#include "support/output.hpp"

namespace sigmax::apps {
namespace {

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
std::pair<Journaled, std::size_t> parsed(const std::filesystem::path& path, std::string_view text) {
  Journaled journal;
  std::size_t begin = 0;
  for (std::size_t line = 1;; ++line) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return {std::move(journal), begin};
    const std::string_view found = text.substr(begin, end - begin);
    if (line == 1)
      journal.study = found;
    else if (!read_line(found, journal.rows))
      throw InputError(message({.where = fmt::format("{}:{}", path.native(), line),
                                .found = in_quotes(found),
                                .expected = "the number of a cell and what it gave, with commas between",
                                .remedy = "delete the file, and the work starts anew"}));
    begin = end + 1;
  }
}

}  // namespace

std::string journal_line(std::size_t cell, const std::vector<double>& row) {
  std::string line = fmt::format("{}", cell);
  for (const double value : row) line.append(",").append(shortest(value));
  return line + "\n";
}

Journaled read_journal(const std::filesystem::path& path) {
  auto journal = parsed(path, read_text(path)).first;
  if (journal.study.empty())
    throw InputError(message({.where = path.native(), .what = "is empty", .expected = "the journal of a campaign"}));
  return journal;
}

Journal::Journal(std::filesystem::path path, std::string study) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail();
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError(message({.where = path_.native(),
                              .what = "another program is writing this journal",
                              .remedy = "wait until it ends, or give another --out"}));
  std::size_t whole = 0;
  std::tie(all_, whole) = parsed(path_, read_text(path_));
  if (::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0) fail();
  if (whole > 0 && all_.study != study)
    throw InputError(message({.where = path_.native() + ":1",
                              .what = "the directory holds another campaign",
                              .found = in_quotes(all_.study),
                              .expected = in_quotes(study),
                              .remedy = "give the same options, or another --out"}));
  all_.study = std::move(study);
  if (whole == 0) write(all_.study + "\n");
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
  sorted.write(all_.study + "\n");
  for (const auto& [cell, row] : all_.rows) sorted.write(journal_line(cell, row));
  sorted.commit();
}

}  // namespace sigmax::apps
