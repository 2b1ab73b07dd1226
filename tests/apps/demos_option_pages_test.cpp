#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace sigmax::apps {
namespace {

TEST(OptionPages, AreWhatTheProgramsPrint) {
  const std::filesystem::path source = SIGMAX_SOURCE;
  for (const std::filesystem::path program : {SIGMAX_HIMM_DEMO, SIGMAX_RECOGNITION_DEMO}) {
    const auto page = program::run(source / "scripts" / "option_pages", {"--print", program::chosen(program)});
    ASSERT_EQ(page.status, 0) << page.output;
    EXPECT_EQ(contents(source / "docs" / (program.filename().string() + "_options.md")), page.output)
        << "run scripts/option_pages";
  }
}

TEST(OptionPages, EverySubcommandHasTwoExamplesThatCanBeCopied) {
  for (const std::string subcommand : {"simulate", "reproduce", "sweep", "merge", "track", "tune"}) {
    const std::string help = program::run(SIGMAX_HIMM_DEMO, {subcommand, "--help"}).output;
    const std::string heading = "\nExamples:\n";
    const auto examples = help.find(heading);
    ASSERT_NE(examples, std::string::npos);
    std::istringstream lines(help.substr(examples + heading.size()));
    std::size_t count = 0;
    bool goes_on = false;
    for (std::string line; std::getline(lines, line); goes_on = line.ends_with(" \\")) {
      EXPECT_TRUE(line.starts_with(goes_on ? "    -" : "  himm_demo ")) << line;
      count += goes_on ? 0U : 1U;
    }
    EXPECT_GE(count, 2U) << help;
  }
}

}  // namespace
}  // namespace sigmax::apps
