#include "report/result.hpp"

#include <nlohmann/json.hpp>

#include "apps/temporary_directory.hpp"

namespace result_test {

class FilesOfResults : public InDirectory {};

TEST_F(FilesOfResults, AppearTogetherAtTheEnd) {
  const std::filesystem::path out = directory.path() / "a" / "b";
  ResultFiles files({.out = out.string()});
  ASSERT_TRUE(files.wanted());
  AtomicFile* const runs = files.open("runs.csv");
  files.write("summary.json", "{\n  \"runs\": 2\n}\n");
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

TEST_F(FilesOfResults, AreNoneWithoutADirectory) {
  ResultFiles files({});
  EXPECT_FALSE(files.wanted());
  EXPECT_EQ(files.open("runs.csv"), nullptr);
  files.write("curves.csv", "x\n");
  testing::internal::CaptureStdout();
  files.commit();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(FilesOfResults, LeaveNothingUnlessTheyAreCommitted) {
  {
    ResultFiles files({.out = directory.path().string()});
    files.write("curves.csv", "x\n");
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST_F(FilesOfResults, ComeIntoTheirPlacesOnlyIfAllAreOnTheDisk) {
  ResultFiles files({.out = directory.path().string()});
  files.write("small", "1");
  files.write("large", std::string(60'000, 'x'));  // stays in memory until it is stored
  std::string refusal;
  with_files_up_to(20'000, [&] { refusal = message_of<InputError>([&] { files.commit(); }); });
  EXPECT_TRUE(says(refusal, {"large: cannot be written: File too large"}));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "small"));
}

TEST(Result, IsPrintedAndWrittenFromOneTable) {
  const TemporaryDirectory directory;
  const OutputOptions options{.out = directory.path().string(), .command = "example show"};
  ResultTable table({{.key = "filter", .header = "filter", .align = Align::left}, {.key = "rmse_m", .header = "RMSE"}});
  table.row({"imm", 1.5});
  Result result(options);
  result.fact({"runs"}, 2);
  result.fact({"synthetic"}, true);
  result.say("two runs");
  result.say({{true, "said"}, {false, "not said"}});
  result.add(
      table,
      {.heading = "The filters", .csv = "filters.csv", .summary = {"found", 0UL, "by filter"}, .title = "Filters"});
  result.fact({"found", 0UL, "words"}, {"a", "b"});
  ASSERT_EQ(result.page.last.size(), 1U);
  EXPECT_EQ(std::get<ReportTable>(result.page.last[0]).title, "Filters");
  ResultFiles files(options);
  testing::internal::CaptureStdout();
  result.publish(files);
  std::fflush(stdout);
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(printed.starts_with(
      "two runs\nsaid\n\nThe filters\nfilter  RMSE\n──────  ────\nimm     1.50\n\nWrote filters.csv"))
      << printed;
  EXPECT_EQ(contents(directory.path() / "filters.csv"), "filter,rmse_m\nimm,1.5\n");
  const auto summary = nlohmann::json::parse(contents(directory.path() / "summary.json"));
  EXPECT_EQ(summary.at("command"), "example show");
  EXPECT_TRUE(summary.at("version").is_string());
  EXPECT_EQ(summary.at("runs"), 2);
  EXPECT_EQ(summary.at("synthetic"), true);
  EXPECT_EQ(summary.at("found")[0].at("by filter").at("imm").at("rmse_m"), 1.5);
  EXPECT_EQ(summary.at("found")[0].at("words"), (std::vector<std::string>{"a", "b"}));
}

}  // namespace result_test
