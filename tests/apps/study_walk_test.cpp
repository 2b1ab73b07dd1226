// The code of docs/extending.md that makes a study, and what it writes.

#include "apps/temporary_directory.hpp"
#include "report/result.hpp"
#include "shell/random.hpp"
#include "study/study.hpp"

namespace study_walk_test {

TEST(StudyWalk, WritesWhatItFound) {
  const TemporaryDirectory directory;
  const OutputOptions options{.out = directory.path().string(), .quiet = true};
  const Sharing sharing{.threads = 2};
  const std::uint64_t seed = 1;
  const Study study{"throws", 1000, [&](std::size_t number) {
                      RandomStream random(seed, number);
                      return Study::Row{random.uniform() < 0.25 ? 1.0 : 0.0};
                    }};
  RunningMean heads;
  const bool all = run(study, sharing, options, [&](std::size_t, const Study::Row& row) { heads.add(row[0]); });
  ASSERT_TRUE(all);
  EXPECT_NEAR(heads.mean(), 0.25, 0.05);

  ResultFiles files(options);
  testing::internal::CaptureStdout();
  ResultTable table;
  table.row_of({{{.key = "coin", .header = "coin", .align = Align::left}, "bent"},
                {{.key = "heads", .header = "heads", .digits = 3, .interval = true}, heads.interval()}});
  Result result(options);
  result.fact({"seed"}, seed);
  result.add(table, {.csv = "coins.csv", .summary = {"coins"}, .title = "The coins"});
  result.publish(files);
  std::fflush(stdout);
  const std::string shown = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(shown.starts_with("\ncoin          heads\n────  ─────────────\nbent  0.")) << shown;
  EXPECT_TRUE(contents(directory.path() / "coins.csv").starts_with("coin,heads,heads_lower,heads_upper\nbent,0."));
  EXPECT_TRUE(says(contents(directory.path() / "summary.json"), {"\"coins\": {\n    \"bent\": {\n      \"heads\": {"}));
}

}  // namespace study_walk_test
