#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shell/text.hpp"

namespace sigmax::apps {

/// The first record of a CSV file.
struct CsvHeader {
  std::string file;
  std::vector<std::string> names;
};

/// One record, of as many fields as the header has; it keeps its text until the reader fills it again.
class CsvRow {
 public:
  /// The line on which the record starts; the first of the file is 1.
  std::size_t line() const { return line_; }
  std::size_t size() const { return ends_.size(); }
  std::string_view operator[](std::size_t column) const;

  /// Whether the field is empty, or blanks.
  bool blank(std::size_t column) const;

  /// Throws InputError with file, line and column unless the field is a finite number.
  double number(std::size_t column) const;

  /// As `number`, but an empty field is nothing.
  std::optional<double> optional_number(std::size_t column) const;

  /// An error about one field, for rules that only the caller knows.
  InputError error(std::size_t column, std::string_view expected, std::string_view remedy = {}) const;

 private:
  friend class CsvReader;

  std::shared_ptr<const CsvHeader> header_;
  std::string text_;
  std::vector<std::size_t> ends_;
  std::size_t line_ = 0;
};

/// Reads a headed CSV file (RFC 4180, UTF-8) record by record, in memory that does not grow with the file.
///
///     CsvReader reader{path};
///     const std::size_t x = reader.column("x_m");
///     for (CsvRow row; reader.next(row);) use(row.number(x));
///
/// Fields are separated by commas, or by tabs or else semicolons if the header has these and no comma outside quotes;
/// a first line "sep=;" is skipped. Lines end with LF, CR LF or CR; those are skipped whose fields are all blank, or
/// that are a single one that begins with #. Blanks around a quoted field are allowed. Malformed input throws
/// InputError with file and line.
class CsvReader {
 public:
  explicit CsvReader(const std::filesystem::path& path);

  /// Reads a stream, which must outlive the reader; `name` stands for the file in messages.
  CsvReader(std::istream& stream, std::string name);

  const std::string& file() const { return header_->file; }

  /// The names of the columns, without the blanks around them.
  std::span<const std::string> names() const { return header_->names; }

  /// Index of a column, if there is such a one.
  std::optional<std::size_t> find(std::string_view name) const;

  /// Index of a column; throws InputError that lists the columns that there are.
  std::size_t column(std::string_view name) const;

  /// Reads the next record; false at the end of the file.
  bool next(CsvRow& row);

  /// Progress: the bytes taken so far, and the size of the file where it is known.
  std::uint64_t bytes_read() const { return bytes_before_ + position_; }
  std::optional<std::uint64_t> bytes_total() const { return bytes_total_; }

 private:
  static constexpr int end_of_file = -1;

  void read_header();
  bool read_record(CsvRow& row);
  void read_quoted(CsvRow& row);
  void append(CsvRow& row, int byte) const;
  void refuse_endless(const CsvRow& row) const;
  int peek();
  int get();
  bool fill();
  InputError error(std::size_t line, Complaint complaint) const;

  std::unique_ptr<std::istream> owned_;
  std::istream* stream_;
  std::shared_ptr<CsvHeader> header_;
  std::vector<char> buffer_;
  std::size_t position_ = 0, filled_ = 0;
  std::uint64_t bytes_before_ = 0;
  std::optional<std::uint64_t> bytes_total_;
  std::size_t line_ = 1;
  char separator_ = ',';
  bool is_first_ = true;  // the next record below the header
  bool ended_ = false;    // the last record ran into the end of the file
};

/// Opens a file, or the standard input for "-".
CsvReader open_csv(const std::string& file);

/// Text as one field of a CSV file: in quotes where it needs them.
std::string csv_field(std::string_view text);

/// The first of some names, each as such a field: blue, "red, dark", …
std::string listed(std::span<const std::string> names, std::size_t most);

/// A word of a list on the command line as it is typed: '"12,5"'.
std::string typed(std::string_view word);

}  // namespace sigmax::apps
