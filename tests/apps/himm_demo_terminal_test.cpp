#include "shell/text.hpp"
#include "support/program.hpp"

namespace himm_demo_terminal_test {

/// Runs in a terminal of so many columns, by `script`, which gives the program one.
program::Ending in_terminal(int columns, const std::string& command) {
  return program::run("/usr/bin/script",
                      {"-qec", "stty cols " + std::to_string(columns) + "; TERM=xterm " + command, "/dev/null"});
}

/// The columns of a table's row stand beside each other where the terminal has room, and else below each other.
TEST(HimmDemoTables, TakeTheColumnsOfTheTerminal) {
  if (!std::filesystem::exists("/usr/bin/script")) GTEST_SKIP() << "no script";
  const std::string command = program::quoted(program::chosen(SIGMAX_HIMM_DEMO)) +
                              " track --quiet " SIGMAX_SOURCE
                              "/apps/examples/data/drone.csv --set filters=[imm,himm_histories]";
  const auto widest = [](const std::string& text) {
    std::istringstream lines(text);
    std::size_t width = 0;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("himm_histories")) width = std::max(width, display_width(line));
    return width;
  };
  EXPECT_GT(widest(in_terminal(120, command).output), 80U);
  EXPECT_LE(widest(in_terminal(120, command).output), 120U);
  EXPECT_LE(widest(in_terminal(80, command).output), 80U);
  EXPECT_LE(widest(program::run("/bin/sh", {"-c", command}).output), 80U);
}

}  // namespace himm_demo_terminal_test
