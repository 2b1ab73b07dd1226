#pragma once

#include "support/matrices.hpp"

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

/// Fails unless a row of estimates.csv has this mean and these sigmas along so many axes, in the order x, …, vx, …, ax,
/// of which the acceleration has no sigma; along the other axes its cells are empty.
inline void expect_row(const TextRow& row, const restatement::State& state, std::size_t axes, double tolerance = 1e-9) {
  static const std::vector<std::string> names = {"x_m",    "y_m",     "z_m",     "vx_mps", "vy_mps",
                                                 "vz_mps", "ax_mps2", "ay_mps2", "az_mps2"};
  for (std::size_t i = 0; i < state.mean.size(); ++i) {
    const std::string& name = names[i / axes * 3 + i % axes];
    ASSERT_CLOSE(std::stod(row.at(name)), state.mean[i], tolerance) << name;
    if (i < 2 * axes) {
      ASSERT_CLOSE(std::stod(row.at("sigma_" + name)), std::sqrt(state.covariance(i, i)), tolerance);
    }
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k % 3 >= axes) {
      ASSERT_EQ(row.at(names[k]), "");
    }
  }
}

/// A recorded track outside the project, or nothing.
inline std::string recorded(const std::string& name) {
  const auto path = std::filesystem::path(SIGMAX_DATA) / "tracking" / name;
  return std::filesystem::exists(path) ? path.string() : "";
}

}  // namespace sigmax::apps
