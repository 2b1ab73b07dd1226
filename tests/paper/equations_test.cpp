// docs/equations.md has a row for each equation of the paper, in order, and what it names is there.

#include "apps/temporary_directory.hpp"

namespace equations_test {

namespace fs = std::filesystem;
const fs::path source = SIGMAX_SOURCE;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line.substr(2));
  for (std::string cell; std::getline(stream, cell, '|');) {
    const auto begin = cell.find_first_not_of(' ');
    result.push_back(begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
  }
  return result;
}

TEST(Equations, AllHaveASymbolAHeaderAndAPage) {
  std::istringstream page(contents(source / "docs" / "equations.md"));
  int number = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| (")) continue;
    const auto row = cells(line);
    ASSERT_EQ(row.size(), 5U) << line;
    EXPECT_EQ(row[0], "(" + std::to_string(++number) + ")");
    const std::string room = row[3].substr(0, row[3].find('/'));
    const fs::path header = source / room / "include" / "sigmax" / row[3];
    ASSERT_TRUE(fs::exists(header)) << line;
    const std::string symbol = row[2].substr(1, row[2].size() - 2);
    EXPECT_TRUE(says(contents(header), {symbol}));
    const auto open = row[4].find("](");
    ASSERT_NE(open, std::string::npos) << line;
    EXPECT_TRUE(fs::exists(source / "docs" / row[4].substr(open + 2, row[4].size() - open - 3))) << line;
  }
  EXPECT_EQ(number, 68);
}

TEST(Equations, EveryPageOfTheIndexIsThere) {
  const std::string index = contents(source / "docs" / "README.md");
  std::size_t pages = 0;
  for (auto open = index.find("]("); open != std::string::npos; open = index.find("](", open + 1), ++pages) {
    const auto close = index.find(')', open);
    EXPECT_TRUE(fs::exists(source / "docs" / index.substr(open + 2, close - open - 2)))
        << index.substr(open, close - open);
  }
  EXPECT_GT(pages, 15U);
}

}  // namespace equations_test
