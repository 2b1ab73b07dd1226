#pragma once

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace sigmax::apps {

using TextRow = std::map<std::string, std::string>;

/// The rows of a CSV file without quotes, each by the names of its columns.
inline std::vector<TextRow> rows(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> names;
  std::vector<TextRow> result;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::string cell;
    for (const char letter : line + ",") {
      if (letter == ',')
        cells.push_back(std::exchange(cell, ""));
      else
        cell += letter;
    }
    if (names.empty()) {
      names = cells;
      continue;
    }
    auto& row = result.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = cells.at(i);
  }
  return result;
}

/// A number as it reads back.
inline std::string exact(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// The number that a cell holds; unlike std::stod this takes one that is no normal number, too.
inline double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

/// A recorded track outside the project, or nothing.
inline std::string recorded(const std::string& name) {
  const auto path = std::filesystem::path(SIGMAX_DATA) / "tracking" / name;
  return std::filesystem::exists(path) ? path.string() : "";
}

}  // namespace sigmax::apps
