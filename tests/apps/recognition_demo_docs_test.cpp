#include "apps/recognition_demo_support.hpp"

namespace recognition_demo_docs_test {

struct Shown {
  std::string command;
  std::string output;
};

/// The indented commands of a page, awk's too, each with the block of text that follows it.
std::vector<Shown> shown(const std::string& page) {
  std::istringstream lines(contents(std::filesystem::path(SIGMAX_SOURCE) / "docs" / page));
  std::vector<Shown> all;
  bool in_block = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("    recognition_demo") || line.starts_with("    awk "))
      all.push_back({line.substr(4), ""});
    else if (!all.empty() && all.back().command.ends_with('\\'))
      all.back().command.back() = ' ', all.back().command += line;
    else if (line == "```text")
      in_block = !all.empty();
    else if (line == "```")
      in_block = false;
    else if (in_block)
      all.back().output += line + "\n";
  }
  return all;
}

void expect_shown(const std::string& page, std::size_t commands) {
  const std::filesystem::path data = SIGMAX_DATA;
  if (!std::filesystem::exists(data / "recognition")) GTEST_SKIP() << data << " is absent";
  const TemporaryDirectory directory;
  for (const auto& folder :
       {data / "recognition", data / "tracking", std::filesystem::path(SIGMAX_SOURCE) / "apps/examples/data"})
    for (const auto& file : std::filesystem::directory_iterator(folder))
      if (file.path().extension() == ".csv")
        std::filesystem::create_symlink(file.path(), directory.path() / file.path().filename());
  const auto all = shown(page);
  EXPECT_EQ(all.size(), commands);
  for (const auto& [command, output] : all) {
#ifndef NDEBUG
    if (command.find("--runs") != std::string::npos) continue;  // minutes without optimisation
#endif
    // The program by its name, as a reader runs it.
    const auto ending = program::run(
        "/bin/sh", {"-c", "cd " + program::quoted(directory.path()) + " && recognition_demo() { " +
                              program::quoted(program::chosen(SIGMAX_RECOGNITION_DEMO)) + " \"$@\"; } && " + command});
    EXPECT_EQ(ending.status, 0) << command;
    EXPECT_EQ(ending.output, output) << command;
  }
}

TEST(RecognitionDemoPage, ShowsWhatTheProgramPrints) { expect_shown("recognition_demo.md", 4); }
TEST(RecognitionDemoPage, OfRegimesShowsWhatTheProgramPrints) { expect_shown("recognition_demo_regimes.md", 1); }
TEST(RecognitionDemoPage, OfLabelledDataShowsWhatTheProgramPrints) { expect_shown("recognition_demo_data.md", 1); }
TEST(RecognitionDemoPage, OfMoreTablesShowsWhatTheProgramPrints) { expect_shown("recognition_demo_evaluate.md", 2); }
TEST(RecognitionDemoPage, OfAircraftShowsWhatTheProgramPrints) { expect_shown("recognition_demo_aircraft.md", 5); }

}  // namespace recognition_demo_docs_test
