#include <regex>

#include "apps/temporary_directory.hpp"
#include "support/program.hpp"

namespace {

TEST(OptionPages, AreWhatTheProgramsPrint) {
  const std::filesystem::path source = SIGMAX_SOURCE;
  for (const std::filesystem::path program : {SIGMAX_HIMM_DEMO, SIGMAX_RECOGNITION_DEMO}) {
    const auto page = program::succeeds(source / "scripts" / "option_pages", {"--print", program::chosen(program)});
    EXPECT_EQ(contents(source / "docs" / (program.filename().string() + "_options.md")), page.output)
        << "run scripts/option_pages";
  }
}

TEST(OptionPages, EverySubcommandHasTwoExamplesThatCanBeCopied) {
  const std::regex examples(R"(\nExamples:(\n  himm_demo [^\n\\]+(\\\n    -[^\n\\]+)*){2,}\n*$)");
  for (const std::string subcommand : {"simulate", "reproduce", "sweep", "merge", "track", "tune"}) {
    const std::string help = program::run(SIGMAX_HIMM_DEMO, {subcommand, "--help"}).output;
    EXPECT_TRUE(std::regex_search(help, examples)) << help;
  }
}

}  // namespace
