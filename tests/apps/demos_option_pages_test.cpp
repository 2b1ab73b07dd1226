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

TEST(OptionPages, EverySubcommandHasTwoExamples) {
  for (const std::string subcommand : {"simulate", "reproduce", "sweep", "merge", "track", "tune"}) {
    const std::string help = program::run(SIGMAX_HIMM_DEMO, {subcommand, "--help"}).output;
    const auto examples = help.find("\nExamples:\n");
    ASSERT_NE(examples, std::string::npos);
    std::size_t count = 0;
    for (auto at = help.find("\n  himm_demo ", examples); at != std::string::npos; ++count)
      at = help.find("\n  himm_demo ", at + 1);
    EXPECT_GE(count, 2U) << help;
  }
}

}  // namespace
