#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace demos_overwriting_test {

const std::filesystem::path data = std::filesystem::path(SIGMAX_SOURCE) / "apps" / "examples" / "data";

/// A command of which the file `input`, and what names it, must stay as it is. FILE, LINK, TWIN and DIR are the input,
/// links to it and their directory.
struct Command {
  std::string program;
  std::string input;  ///< a name that the command would write
  std::vector<std::string> arguments;
};

const std::vector<Command> commands = {
    {SIGMAX_RECOGNITION_DEMO, "predictions.csv", {"evaluate", "FILE", "--label", "fruit", "--out", "DIR"}},
    {SIGMAX_RECOGNITION_DEMO, "confusion.csv", {"evaluate", "LINK", "--label", "fruit", "--out", "DIR/../dir"}},
    {SIGMAX_RECOGNITION_DEMO, "f.csv", {"evaluate", "FILE", "--label", "fruit", "--report", "FILE"}},
    {SIGMAX_RECOGNITION_DEMO, "f.csv", {"train", "FILE", "--label", "fruit", "--model", "FILE"}},
    {SIGMAX_RECOGNITION_DEMO, "f.csv", {"train", "FILE", "--label", "fruit", "--model", "LINK"}},
    {SIGMAX_RECOGNITION_DEMO, "predictions.csv", {"classify", "m.json", "FILE", "--out", "DIR"}},
    {SIGMAX_RECOGNITION_DEMO, "summary.json", {"classify", "FILE", "f.csv", "--out", "DIR"}},
    {SIGMAX_RECOGNITION_DEMO, "report.html", {"classify", "FILE", "f.csv", "--out", "DIR"}},
    {SIGMAX_HIMM_DEMO, "summary.json", {"simulate", "--config", "FILE", "--out", "DIR"}},
    {SIGMAX_HIMM_DEMO, "rmse.csv", {"simulate", "--config", "FILE", "--out", "DIR"}},
    {SIGMAX_HIMM_DEMO, "estimates.csv", {"track", "FILE", "--out", "DIR"}},
    {SIGMAX_HIMM_DEMO, "f.csv", {"track", "FILE", "--report", "FILE"}},
    {SIGMAX_HIMM_DEMO, "cells.journal", {"sweep", "--merge", "DIR", "--out", "DIR/whole", "--report", "LINK"}},
};

/// What suits the program, but for a configuration, which may be empty, and what is refused unread.
std::string text_for(const Command& command) {
  if (command.arguments.front() == "simulate") return "";
  return contents(data / (command.program == SIGMAX_HIMM_DEMO ? "drone.csv" : "fruit.csv"));
}

TEST(Overwriting, NoSubcommandWritesOverItsInput) {
  for (const Command& command : commands) {
    const TemporaryDirectory scratch;
    const auto directory = scratch.path() / "dir";
    std::filesystem::create_directory(directory);
    const auto link = scratch.path() / "link", file = directory / command.input;
    const std::string text = text_for(command);
    scratch.write("dir/" + command.input, text);
    std::filesystem::create_symlink(file, link);
    std::vector<std::string> arguments;
    for (std::string argument : command.arguments) {
      if (argument == "FILE") argument = file;
      if (argument == "LINK") argument = link;
      if (argument.starts_with("DIR")) argument.replace(0, 3, directory);
      arguments.push_back(argument);
    }
    const auto ending = program::run(command.program, arguments);
    EXPECT_EQ(ending.status, 2) << ending.output;
    EXPECT_TRUE(says(ending.on_one_line(), {"would write over the input"}));
    EXPECT_EQ(contents(file), text) << ending.output;
    EXPECT_TRUE(std::filesystem::is_symlink(link)) << ending.output;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory), {}), 1) << ending.output;
  }
}

TEST(Overwriting, TheStandardInputIsKnownByItsFile) {
  const TemporaryDirectory scratch;
  const auto file = scratch.write("predictions.csv", contents(data / "fruit.csv"));
  const auto ending = program::run("/bin/sh", {"-c", "exec \"$0\" evaluate - --label fruit --out \"$1\" <\"$2\"",
                                               program::chosen(SIGMAX_RECOGNITION_DEMO), scratch.path(), file});
  EXPECT_EQ(ending.status, 2) << ending.output;
  EXPECT_EQ(contents(file), contents(data / "fruit.csv"));
}

}  // namespace demos_overwriting_test
