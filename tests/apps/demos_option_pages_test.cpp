#include <regex>

#include "apps/temporary_directory.hpp"
#include "shell/text.hpp"
#include "support/program.hpp"

namespace demos_option_pages_test {

TEST(OptionPages, AreWhatTheProgramsPrint) {
  const std::filesystem::path source = SIGMAX_SOURCE;
  for (const std::filesystem::path program : {SIGMAX_HIMM_DEMO, SIGMAX_RECOGNITION_DEMO}) {
    const auto page = program::succeeds(source / "scripts" / "option_pages", {"--print", program::chosen(program)});
    EXPECT_EQ(contents(source / "docs" / (program.filename().string() + "_options.md")), page.output)
        << "run scripts/option_pages";
  }
}

TEST(OptionPages, EverySubcommandHasTwoExamplesThatCanBeCopied) {
  const auto examples_of = [](const std::string& program) {
    return std::regex("\\nExamples:(\\n  " + program + R"( [^\n\\]+(\\\n    -[^\n\\]+)*){2,}\n*$)");
  };
  for (const std::filesystem::path program : {SIGMAX_HIMM_DEMO, SIGMAX_RECOGNITION_DEMO}) {
    const std::string name = program.filename();
    const bool tracks = name == "himm_demo";
    for (const auto& subcommand :
         words(tracks ? "simulate reproduce sweep track associate tune" : "esm train classify evaluate")) {
      const std::string help = program::succeeds(program, {subcommand, "--help"}).output;
      EXPECT_TRUE(std::regex_search(help, examples_of(name))) << help;
      for (const std::string& line : lines_of(help, any_width)) EXPECT_LE(display_width(line), 80U) << line;
    }
    EXPECT_TRUE(program::run(program, {"--version"}).output.starts_with(name + " "));
  }
}

TEST(Completion, OffersWhatTheProgramsOwnHelpLists) {
  const auto offered = [](const std::string& program, const std::string& line) {
    return words(
        program::succeeds("/bin/bash", {"-c",
                                        ". \"$0\"; COMP_WORDS=($2); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "
                                        "_sigmax_demo \"$1\" \"${COMP_WORDS[COMP_CWORD]}\"; echo \"${COMPREPLY[@]}\"",
                                        SIGMAX_SOURCE "/apps/completion.bash", program::chosen(program), line})
            .output);
  };
  using Words = std::vector<std::string>;
  EXPECT_EQ(offered(SIGMAX_HIMM_DEMO, "himm_demo s"), (Words{"simulate", "sweep"}));
  EXPECT_EQ(offered(SIGMAX_HIMM_DEMO, "himm_demo track --ra"), (Words{"--radar", "--radar-at"}));
  EXPECT_EQ(offered(SIGMAX_RECOGNITION_DEMO, "recognition_demo train --mis"),
            (Words{"--missing", "--missing-value", "--misread"}));
  EXPECT_EQ(offered(SIGMAX_HIMM_DEMO, "himm_demo track fl"), Words{});  // a file: bash itself knows
}

}  // namespace demos_option_pages_test
