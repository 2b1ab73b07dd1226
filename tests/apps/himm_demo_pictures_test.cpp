#include "apps/has_gnuplot.hpp"
#include "apps/temporary_directory.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

namespace himm_demo_pictures_test {

class HimmDemoPictures : public InDirectory {};

TEST_F(HimmDemoPictures, AskForGnuplotWhereItIsNotInstalled) {
  const auto plots = directory.path() / "plots";
  const auto ending = program::run("/usr/bin/env", {"PATH=/nowhere", program::chosen(SIGMAX_HIMM_DEMO), "simulate",
                                                    "--quiet", "--runs", "2", "--plots", plots});
  EXPECT_EQ(ending.status, 2);
  EXPECT_TRUE(says(ending.on_one_line(), {"gnuplot", "cannot be started", "install it", "gnuplot-nox"}));
  EXPECT_FALSE(std::filesystem::exists(plots));
}

TEST_F(HimmDemoPictures, AreTheChartsOfSimulate) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  const auto ending =
      program::succeeds(SIGMAX_HIMM_DEMO, {"simulate", "--quiet", "--runs", "3", "--plots", directory.path()});
  EXPECT_TRUE(says(ending.on_one_line(), {"charts as SVG and PDF to"}));
  for (const char* name : {"rmse_in_x", "rmse_in_y", "rmse_in_z", "mode_weights", "nees_of_the_position", "nis",
                           "track_of_run_1", "track_of_run_1_in_space"}) {
    EXPECT_TRUE(contents(directory.path() / (std::string(name) + ".svg")).ends_with("</svg>\n\n")) << name;
    EXPECT_TRUE(contents(directory.path() / (std::string(name) + ".pdf")).starts_with("%PDF")) << name;
  }
  const auto files = std::filesystem::directory_iterator(directory.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 16);
}

TEST_F(HimmDemoPictures, AreThoseOfOneShardAndOfMergedOnes) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  const auto whole = directory.path() / "whole", merged = directory.path() / "merged";
  const auto reproduce = [&](std::vector<std::string> more) {
    program::succeeds(SIGMAX_HIMM_DEMO, Arguments{"reproduce", "--quiet", "--runs", "2"} + more);
  };
  reproduce({"--plots", whole});
  for (const char* part : {"1", "2"})
    reproduce({"--shard", part + std::string("/2"), "--out", directory.path() / part});
  const auto ending =
      program::succeeds(SIGMAX_HIMM_DEMO, {"merge", directory.path() / "1", directory.path() / "2", "--out",
                                           directory.path() / "all", "--quiet", "--plots", merged});
  for (const auto& picture : std::filesystem::directory_iterator(whole))
    if (picture.path().extension() == ".svg")
      EXPECT_EQ(contents(merged / picture.path().filename()), contents(picture.path()));
}

TEST_F(HimmDemoPictures, AreNotDrawnWhereTheyCannotBeWritten) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  const auto ending = program::run(SIGMAX_HIMM_DEMO, {"simulate", "--quiet", "--plots", "/proc/nowhere"});
  EXPECT_EQ(ending.status, 3);
  EXPECT_TRUE(says(ending.output, {"/proc/nowhere: the directory cannot be created"}));
}

/// Runs in a terminal of so many columns, by `script`, which gives the program one.
program::Ending in_terminal(int columns, const std::string& command) {
  return program::run("/usr/bin/script",
                      {"-qec", "stty cols " + std::to_string(columns) + "; TERM=xterm " + command, "/dev/null"});
}

TEST(HimmDemoBraille, EndsTheOutputOfAWideTerminalOnly) {
  if (!std::filesystem::exists("/usr/bin/script")) GTEST_SKIP() << "no script";
  const std::string command = program::quoted(program::chosen(SIGMAX_HIMM_DEMO)) + " simulate --quiet --runs 2";
  EXPECT_TRUE(says(in_terminal(80, command).output, {"⠉"}));
  EXPECT_EQ(in_terminal(79, command).output.find("Mode weights"), std::string::npos);
  EXPECT_EQ(in_terminal(80, command + " --no-chart").output.find("Mode weights"), std::string::npos);
  EXPECT_EQ(in_terminal(80, "env TERM=dumb " + command).output.find("Mode weights"), std::string::npos);
  EXPECT_EQ(program::run(SIGMAX_HIMM_DEMO, {"simulate", "--quiet", "--runs", "2"}).output.find("Mode weights"),
            std::string::npos);
  const std::string track = program::quoted(program::chosen(SIGMAX_HIMM_DEMO)) + " track --quiet " SIGMAX_SOURCE
                                                                                 "/apps/examples/data/drone.csv";
  EXPECT_TRUE(says(in_terminal(120, track).output, {"Mode weights"}));
}

/// The columns of a table's row stand beside each other where the terminal has room, and else below each other.
TEST(HimmDemoTables, TakeTheColumnsOfTheTerminal) {
  if (!std::filesystem::exists("/usr/bin/script")) GTEST_SKIP() << "no script";
  const std::string command = program::quoted(program::chosen(SIGMAX_HIMM_DEMO)) + " track --quiet --no-chart " +
                              SIGMAX_SOURCE "/apps/examples/data/drone.csv --set filters=[imm,himm_histories]";
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

}  // namespace himm_demo_pictures_test
