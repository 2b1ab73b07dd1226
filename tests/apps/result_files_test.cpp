#include "support/result_files.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/temporary_directory.hpp"

namespace sigmax::apps {
namespace {

TEST(ResultFiles, AppearTogetherAtTheEnd) {
  const TemporaryDirectory directory;
  const std::filesystem::path out = directory.path() / "a" / "b";
  ResultFiles files({.out = out.string()});
  ASSERT_TRUE(files.wanted());
  AtomicFile* const runs = files.open("runs.csv");
  files.write_json("summary.json", {{"runs", 2}});
  runs->write("run\n");
  runs->write("1\n");
  EXPECT_FALSE(std::filesystem::exists(out / "summary.json"));
  testing::internal::CaptureStdout();
  files.commit();
  std::fflush(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "\nWrote runs.csv and summary.json to " + out.string() + "\n");
  EXPECT_EQ(contents(out / "runs.csv"), "run\n1\n");
  EXPECT_EQ(contents(out / "summary.json"), "{\n  \"runs\": 2\n}\n");
}

TEST(ResultFiles, AreNoneWithoutADirectory) {
  ResultFiles files({});
  EXPECT_FALSE(files.wanted());
  EXPECT_EQ(files.open("runs.csv"), nullptr);
  files.write("curves.csv", "x\n");
  files.write_json("summary.json", {});
  testing::internal::CaptureStdout();
  files.commit();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(ResultFiles, LeaveNothingUnlessTheyAreCommitted) {
  const TemporaryDirectory directory;
  {
    ResultFiles files({.out = directory.path().string()});
    files.write("curves.csv", "x\n");
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(ResultFiles, SummariesBeginWithTheCommand) {
  const auto summary = summary_of({.command = "example show"});
  EXPECT_EQ(summary.at("command"), "example show");
  EXPECT_TRUE(summary.at("version").is_string());
}

}  // namespace
}  // namespace sigmax::apps
