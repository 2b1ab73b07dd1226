#include "table/csv.hpp"

#include <array>
#include <cassert>
#include <cerrno>
#include <iostream>
#include <set>
#include <system_error>

#include "shell/files.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t read_at_once = std::size_t{1} << 16;

// A record beyond this is not data: a quote was left open, or the file is no CSV.
constexpr std::size_t longest_record = std::size_t{1} << 20;

bool is_blank(std::string_view text) { return trimmed(text).empty(); }

constexpr std::string_view separators = ",\t;";
using Counts = std::array<std::size_t, separators.size()>;

/// Takes a line from a text. Counts each separator in it outside quotes, which open at the beginning of a field only.
Counts take_line(std::string_view& text, std::string_view& line) {
  Counts counts{};
  bool quoted = false, at_start = true;
  std::size_t end = 0;
  for (; end < text.size() && (quoted || (text[end] != '\n' && text[end] != '\r')); ++end) {
    const auto which = separators.find(text[end]);
    if (which != separators.npos && !quoted) ++counts[which];
    const bool quote = text[end] == '"', closes = quoted && quote;  // a second quote opens it again
    quoted = quote ? at_start && !quoted : quoted;
    at_start = closes || which != separators.npos || (at_start && text[end] == ' ');
  }
  line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return counts;
}

/// The separator that occurs most often in the header, and as often in the line below; else the first of the header.
/// Lines of words before the header begin with # and have no comma.
char separator_of(std::string_view text) {
  std::string_view line;
  Counts header{};
  do header = take_line(text, line);
  while (!text.empty() && (is_blank(line) || (trimmed(line).starts_with('#') && header[0] == 0)));
  const Counts row = take_line(text, line);
  std::size_t best = separators.size();
  for (const bool alike : {true, false})
    for (std::size_t i = 0; i < separators.size() && (alike || best == separators.size()); ++i)
      if (header[i] > (best < separators.size() ? header[best] : 0) && (!alike || header[i] == row[i])) best = i;
  return best < separators.size() ? separators[best] : ',';
}

std::string_view plural_of(char separator) {
  return separator == ',' ? "commas" : separator == '\t' ? "tabs" : "semicolons";
}

}  // namespace

std::string_view CsvRow::operator[](std::size_t column) const {
  assert(column < ends_.size());
  const std::size_t begin = column == 0 ? 0 : ends_[column - 1];
  return std::string_view{text_}.substr(begin, ends_[column] - begin);
}

bool CsvRow::blank(std::size_t column) const { return is_blank((*this)[column]); }

double CsvRow::number(std::size_t column) const {
  if (const auto value = parse_number((*this)[column])) return *value;
  throw error(column, "a finite number with a decimal point", "correct the cell or drop the row");
}

std::optional<double> CsvRow::optional_number(std::size_t column) const {
  if (blank(column)) return std::nullopt;
  if (const auto value = parse_number((*this)[column])) return value;
  throw error(column, "a finite number with a decimal point", "leave the cell empty where there is none");
}

InputError CsvRow::error(std::size_t column, std::string_view expected, std::string_view remedy) const {
  const std::string_view field = (*this)[column];
  return InputError({.where = fmt::format("{}:{}", header_->file, line_),
                     .what = fmt::format("column {}", in_quotes(header_->names[column])),
                     .found = is_blank(field) ? "an empty cell" : in_quotes(field),
                     .expected = expected,
                     .remedy = remedy});
}

std::string listed(std::span<const std::string> names, std::size_t most) {
  const std::string text = list_of(names.first(std::min(most, names.size())), csv_field);
  return names.size() > most ? text + ", …" : text;
}

std::string typed(std::string_view word) { return in_shell(csv_field(word)); }

std::string csv_field(std::string_view text) {
  const bool plain = text.find_first_of(",\"\r\n") == std::string_view::npos && trimmed(text).size() == text.size();
  if (plain) return std::string{text};
  std::string field = "\"";
  for (const char byte : text) field.append(byte == '"' ? 2 : 1, byte);
  return field += '"';
}

CsvReader open_csv(const std::string& file) {
  return file == "-" ? CsvReader{std::cin, "standard input"} : CsvReader{std::filesystem::path{file}};
}

CsvReader::CsvReader(const std::filesystem::path& path)
    : owned_(std::make_unique<std::ifstream>(open_input(path))),
      stream_(owned_.get()),
      header_(std::make_shared<CsvHeader>(CsvHeader{path.string(), {}})),
      buffer_(read_at_once) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);  // of a regular file
  if (!unknown) bytes_total_ = size;
  read_header();
}

CsvReader::CsvReader(std::istream& stream, std::string name)
    : stream_(&stream), header_(std::make_shared<CsvHeader>(CsvHeader{std::move(name), {}})), buffer_(read_at_once) {
  read_header();
}

std::optional<std::size_t> CsvReader::find(std::string_view name) const {
  const auto& names = header_->names;
  const auto found = std::ranges::find(names, name);
  if (name.empty() || found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::size_t CsvReader::column(std::string_view name) const {
  if (const auto index = find(name)) return *index;
  const bool is_lone = std::ranges::count(names(), "") + 1 == std::ssize(names());
  throw InputError({.where = file(),
                    .what = fmt::format("there is no column {}", in_quotes(name)),
                    .remedy = fmt::format("the columns are {}{}", fmt::join(names(), ", "),
                                          is_lone ? ": one name in the first line; it must name all columns, "
                                                    "separated by commas, tabs or semicolons"
                                                  : "")});
}

void CsvReader::read_header() {
  fill();
  const std::string_view start{buffer_.data(), filled_};
  if (start.starts_with("\xEF\xBB\xBF")) position_ = 3;
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
    throw InputError("{}: found UTF-16 text, expected UTF-8; convert it", file());

  separator_ = separator_of(start.substr(position_));
  CsvRow row;
  const bool may_tell = start.substr(position_).starts_with("sep=");  // as a spreadsheet does, in a line before
  bool some = read_record(row);
  if (some && may_tell && row.size() == 2 && row[0] == "sep=" && row[1].empty()) some = read_record(row);
  if (!some)
    throw InputError("{}: is empty: expected a line with the names of the columns; see whether it was written whole",
                     file());
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::string_view name = trimmed(row[i]);
    // Unnamed columns, as a trailing comma makes them, cannot be asked for and so are not ambiguous.
    if (!name.empty() && !seen.insert(name).second)
      throw error(row.line(),
                  {.what = fmt::format("two columns are named {}", in_quotes(name)),
                   .remedy = "rename one of them, or, if the first row is of data, put a row of names above it"});
    header_->names.emplace_back(name);
  }
}

bool CsvReader::next(CsvRow& row) {
  if (!read_record(row)) return false;
  if (row.header_ != header_) row.header_ = header_;
  const bool first = std::exchange(is_first_, false);
  if (row.size() == names().size()) return true;
  const bool may_name_rows = first && names().size() > 1 && row.size() == names().size() + 1;
  throw error(row.line(), {.found = fmt::format("{} fields", row.size()),
                           .expected = fmt::format("{} as in the header", names().size()),
                           .remedy = may_name_rows ? "if the first ones name the rows, give them a name in the header, "
                                                     "which R's write.table leaves out"
                                     : ended_      ? "the file ends within this line: see whether it is whole"
                                                   : fmt::format("add or drop {0}; text with {0} stands in quotes",
                                                                 plural_of(separator_))});
}

bool CsvReader::read_record(CsvRow& row) {
  bool had_quotes = false;
  do {
    row.text_.clear();
    row.ends_.clear();
    row.line_ = line_;
    if (peek() == end_of_file) return false;
    for (bool in_record = true; in_record;) {
      const std::size_t begin = row.ends_.empty() ? 0 : row.ends_.back();
      int byte = get();
      for (; byte != separator_ && byte != '\n' && byte != '\r' && byte != end_of_file; byte = get()) {
        if (byte == '"' && is_blank(std::string_view{row.text_}.substr(begin))) {
          row.text_.resize(begin);
          had_quotes = true;
          read_quoted(row);
          while (peek() != separator_ && (peek() == ' ' || peek() == '\t')) get();
          if (const int after = peek(); after != separator_ && after != '\n' && after != '\r' && after != end_of_file)
            throw error(line_, {.found = in_quotes({&buffer_[position_], 1}) + " after a closing quote",
                                .expected = "the next field or the end of the line",
                                .remedy = "write a quote inside quotes twice"});
        } else {
          append(row, byte);
        }
      }
      row.ends_.push_back(row.text_.size());
      refuse_endless(row);
      in_record = byte == separator_;
      if (in_record) continue;
      if (byte == '\r' && peek() == '\n') get();
      ended_ = byte == end_of_file;
      if (!ended_) ++line_;
    }
  } while (!had_quotes && (is_blank(row.text_) || (row.ends_.size() == 1 && row.text_.starts_with('#'))));
  return true;
}

void CsvReader::read_quoted(CsvRow& row) {
  const std::size_t opened = line_;
  for (int byte = get();; byte = get()) {
    if (byte == end_of_file)
      throw error(opened, {.what = "the quote opened here is not closed at the end of the file",
                           .remedy = "see whether the file is whole, and write a quote inside quotes twice"});
    if (byte == '"') {
      if (peek() != '"') return;
      get();
    }
    append(row, byte);
    if (byte == '\n' || (byte == '\r' && peek() != '\n')) ++line_;
  }
}

void CsvReader::append(CsvRow& row, int byte) const {
  if (byte == '\0') throw error(line_, {.found = "a zero byte", .expected = "UTF-8 text"});
  row.text_.push_back(static_cast<char>(byte));
  refuse_endless(row);
}

void CsvReader::refuse_endless(const CsvRow& row) const {
  if (row.text_.size() + row.ends_.size() > longest_record)
    throw error(row.line_, {.what = "the record that starts here is longer than 1 MiB",
                            .remedy = "look for a quote that is left open"});
}

int CsvReader::peek() {
  if (position_ == filled_ && !fill()) return end_of_file;
  return static_cast<unsigned char>(buffer_[position_]);
}

int CsvReader::get() {
  const int byte = peek();
  if (byte != end_of_file) ++position_;
  return byte;
}

bool CsvReader::fill() {
  bytes_before_ += position_;
  position_ = 0;
  filled_ = 0;
  errno = 0;
  // What is there now is enough: a pipe may take its time for more.
  if (stream_->peek() != std::istream::traits_type::eof()) {
    const auto size = stream_->readsome(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    filled_ = static_cast<std::size_t>(size);
    if (size == 0 && stream_->get(buffer_[0])) filled_ = 1;
  }
  if (stream_->bad()) throw InputError("{}: cannot be read: {}", file(), reason(errno));
  return filled_ > 0;
}

InputError CsvReader::error(std::size_t line, Complaint complaint) const {
  const std::string where = fmt::format("{}:{}", file(), line);
  complaint.where = where;
  return InputError(complaint);
}

}  // namespace sigmax::apps
