#pragma once

#include "apps/temporary_directory.hpp"
#include "table/csv.hpp"

namespace sigmax::apps {

using TextRow = std::map<std::string, std::string>;

/// The rows of a CSV file, each by the names of its columns.
inline std::vector<TextRow> rows_of(const std::filesystem::path& path) {
  CsvReader reader{path};
  std::vector<TextRow> rows;
  for (CsvRow row; reader.next(row);) {
    auto& named = rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) named[reader.names()[i]] = row[i];
  }
  return rows;
}
/// Those of a text.
inline std::vector<TextRow> rows(const std::string& text) {
  const TemporaryDirectory directory;
  return rows_of(directory.write("rows.csv", text));
}

/// Those that have these cells, by the names of their columns.
inline std::vector<TextRow> those_with(std::vector<TextRow> rows, const TextRow& cells) {
  std::erase_if(rows, [&](const TextRow& row) {
    return std::any_of(cells.begin(), cells.end(), [&](const auto& cell) { return row.at(cell.first) != cell.second; });
  });
  return rows;
}
/// The only one.
inline TextRow row_with(const std::vector<TextRow>& rows, const TextRow& cells) {
  const auto found = those_with(rows, cells);
  EXPECT_EQ(found.size(), 1U) << testing::PrintToString(cells);
  return found.at(0);
}
inline std::vector<TextRow> of_filter(const std::vector<TextRow>& rows, const std::string& filter) {
  return those_with(rows, {{"filter", filter}});
}

}  // namespace sigmax::apps
