// Any bytes are a table with rows as long as its header, which reads the same when written out again, or an error that
// names the file.

#include "fuzz/require.hpp"
#include "table/csv.hpp"

namespace {

using Records = std::vector<std::vector<std::string>>;

void check_number(const CsvRow& row, std::size_t column) {
  try {
    const auto number = row.optional_number(column);
    require(!number || std::isfinite(*number), "a number of a cell is finite");
    require(!number || *number == row.number(column), "a cell has one number");
  } catch (const InputError& error) {
    require(std::string_view{error.what()}.starts_with("input:"), "an error of a cell names the file");
  }
}

/// The header and all rows.
Records read(const std::string& text) {
  std::istringstream stream{text};
  CsvReader reader{stream, "input"};
  Records records{{reader.names().begin(), reader.names().end()}};
  for (std::size_t i = 0; i < records[0].size(); ++i)
    require(records[0][i].empty() || reader.column(records[0][i]) == i, "a column is found by its name");

  std::size_t line = 0;
  for (CsvRow row; reader.next(row);) {
    require(row.size() == records[0].size(), "a row has as many cells as the header");
    require(row.line() > line, "records start on later and later lines");
    line = row.line();
    auto& cells = records.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) {
      cells.emplace_back(row[i]);
      check_number(row, i);
    }
  }
  require(reader.bytes_read() == text.size(), "a file is read to its end");
  return records;
}

/// The field as the programs write it, among others.
void check_written(const std::string& field) {
  const Records row = read("a,b,c\n1," + csv_field(field) + ",2\n");
  require(row == Records{{"a", "b", "c"}, {"1", field, "2"}}, "a field reads the same when written out again");
}

/// Every field in quotes, RFC 4180.
std::string written(const Records& records) {
  std::string text;
  for (const auto& record : records) {
    for (const auto& field : record) {
      text += &field == &record.front() ? "\"" : ",\"";
      for (const char byte : field) text.append(byte == '"' ? 2 : 1, byte);
      text += '"';
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Records records;
  try {
    records = read({data, data + size});
  } catch (const InputError& error) {
    require(std::string_view{error.what()}.starts_with("input"), "an error names the file");
    return 0;
  }
  require(read(written(records)) == records, "a table reads the same when written out again");
  for (const auto& record : records)
    for (const auto& field : record) check_written(field);
  return 0;
}
