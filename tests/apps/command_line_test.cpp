#include "shell/command_line.hpp"

#include "report/result.hpp"
#include "support/test.hpp"

namespace command_line_test {

/// What the last run of the program below was given.
struct Given {
  std::string subcommand;
  std::uint64_t seed = 1;
  int threads = 0;
  double share = 0.5;
  OutputOptions output;
};
Given given;

void add(CLI::App& program, const std::string& command, const std::string& name) {
  const auto options = std::make_shared<Given>();
  Subcommand app(program, name,
                 "Does nothing but to say at some length, so that the line has to be broken, what it was given.");
  add_seed(app, options->seed);
  add_threads(app, options->threads);
  app.option("--share", options->share, "A share").number_in(0.0, 1.0);
  Option label = app.option("--label", options->output.out, "A label");
  if (name == "train") label.required();
  add_results(app, options->output, command);
  app.run([options, name] {
    given = *options;
    given.subcommand = name;
  });
}

const ProgramOutline outline = {"example",
                                "An example.",
                                {[](CLI::App& program, const std::string& command) { add(program, command, "show"); },
                                 [](CLI::App& program, const std::string& command) { add(program, command, "train"); }},
                                "show"};

struct Ran {
  int code;
  std::string said;
};

Ran run(std::vector<std::string> arguments) {
  given = {};
  arguments.insert(arguments.begin(), "example");
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const int code = run_command_line(outline, static_cast<int>(pointers.size()), pointers.data());
  const std::string printed = testing::internal::GetCapturedStdout();
  return {code, printed + testing::internal::GetCapturedStderr()};
}

TEST(CommandLine, RunsASubcommandWithItsOptions) {
  EXPECT_EQ(run({"train", "--label", "x", "--seed", "18446744073709551615", "--threads", "3", "--wide"}).code, 0);
  EXPECT_EQ(given.subcommand, "train");
  EXPECT_EQ(given.seed, 18446744073709551615U);
  EXPECT_EQ(given.threads, 3);
  EXPECT_EQ(given.output.width(), any_width);
  EXPECT_EQ(given.output.command, "example train --label x --seed 18446744073709551615 --threads 3 --wide");
}

TEST(CommandLine, HasADefaultSubcommand) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{}, {"--seed", "7"}, {"show"}}) {
    EXPECT_EQ(run(arguments).code, 0);
    EXPECT_EQ(given.subcommand, "show");
  }
  EXPECT_EQ(given.output.width(), terminal_width);
  EXPECT_EQ(run({"--version"}).code, 0);
  EXPECT_EQ(given.subcommand, "");
}

TEST(CommandLine, NamesWhatAWordResembles) {
  const auto says = [](const std::vector<std::string>& arguments, const std::string& words) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.said.find(words), std::string::npos) << ran.said;
    EXPECT_EQ(given.subcommand, "");
  };
  says({"train", "--lable", "x"}, "train has no option '--lable'; did you mean '--label'?");
  says({"train", "--lable=x"}, "train has no option '--lable'; did you mean '--label'?");
  says({"--sede", "7"}, "show has no option '--sede'; did you mean '--seed'?");
  says({"train", "--xyzzy"}, "see example train --help");
  says({"trian"}, "there is no subcommand 'trian'; did you mean 'train'?");
  says({"train"}, "--label is required");
  says({"train", "--label", "--wide"}, "--label: found the option --wide, expected a value");
}

TEST(CommandLine, RefusesNumbersThatAreNone) {
  for (const char* seed : {"-1", "12345678901234567890123", "1e3", "nan", "", "0x10", " 1"})
    EXPECT_EQ(run({"show", "--seed", seed}).code, 2) << seed;
  for (const char* share : {"nan", "inf", "-0.1", "1.1", "x"}) {
    const Ran ran = run({"show", std::string("--share=") + share});
    EXPECT_EQ(ran.code, 2) << share;
    EXPECT_NE(ran.said.find("expected a number in [0 - 1]"), std::string::npos) << ran.said;
  }
  EXPECT_EQ(run({"show", "--share", "1"}).code, 0);
}

TEST(CommandLine, HelpFitsATerminal) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"show", "--help"}}) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.code, 0);
    for (const std::string& line : lines_of(ran.said, any_width))
      EXPECT_LE(display_width(line), terminal_width) << line;
  }
  EXPECT_NE(run({"--help"}).said.find("Without a subcommand it runs show."), std::string::npos);
}

TEST(CommandLine, AFailureOfTheWorkEndsTheProgram) {
  const ProgramOutline failing = {"example",
                                  "An example.",
                                  {[](CLI::App& program, const std::string&) {
                                    Subcommand(program, "fail", "Fails.").run([] { throw InputError("no data"); });
                                  }},
                                  "fail"};
  std::string name = "example";
  char* arguments[] = {name.data()};
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_command_line(failing, 1, arguments), 3);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "example: no data\n");
}

}  // namespace command_line_test
