#include "study/study.hpp"

#include "apps/temporary_directory.hpp"
#include "report/result.hpp"

namespace study_test {

using Rows = std::vector<std::pair<std::size_t, Study::Row>>;

/// What is added of a study, in the order in which it is.
Rows rows_of(const Study& study, const Sharing& sharing, const OutputOptions& options, bool reports = true) {
  Rows rows;
  EXPECT_EQ(
      run(study, sharing, options, [&](std::size_t cell, const Study::Row& row) { rows.emplace_back(cell, row); }),
      reports);
  return rows;
}

TEST(Study, RowsAreAddedInTheOrderOfTheCellsByAnyNumberOfThreads) {
  const Study study{"cells", 100, [](std::size_t cell) {
                      if (cell % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
                      return Study::Row{0.5 * static_cast<double>(cell)};
                    }};
  const Rows one = rows_of(study, {.threads = 1}, {.quiet = true});
  ASSERT_EQ(one.size(), 100U);
  for (std::size_t cell = 0; cell < 100; ++cell) EXPECT_EQ(one[cell], std::pair(cell, Study::Row{0.5 * double(cell)}));
  EXPECT_EQ(rows_of(study, {.threads = 4}, {.quiet = true}), one);
}

TEST(Study, TheFailureOfTheEarliestCellIsRethrown) {
  const Study study{"cells", 50, [](std::size_t cell) -> Study::Row {
                      if (cell == 30) throw std::runtime_error("thirty");
                      if (cell == 29) {
                        std::this_thread::sleep_for(std::chrono::milliseconds(20));
                        throw std::runtime_error("twenty-nine");
                      }
                      return {};
                    }};
  for (const int threads : {1, 4})
    EXPECT_REFUSED(std::runtime_error, ("twenty-nine"), rows_of(study, {.threads = threads}, {.quiet = true}));
}

TEST(Study, WhatAJournalHasIsNotDoneAgain) {
  const TemporaryDirectory directory;
  const OutputOptions options{.out = directory.path().string(), .quiet = true};
  std::atomic<int> done = 0;
  const Study study{"cells", 10,
                    [&](std::size_t cell) {
                      ++done;
                      return Study::Row{static_cast<double>(cell), 0.1};
                    },
                    "a study"};
  testing::internal::CaptureStdout();
  rows_of(study, {.shard = 1, .shards = 3}, options, false);
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(done, 3);
  EXPECT_REFUSED(InputError, ("7 of 10 cells are missing"), rows_of(study, {.merged = {directory.path()}}, options));
  const Rows rows = rows_of(study, {}, options);
  EXPECT_EQ(done, 10);
  EXPECT_EQ(rows, rows_of(study, {.merged = {directory.path()}}, options));
  ASSERT_EQ(rows.size(), 10U);
  EXPECT_EQ(rows[4].second, (Study::Row{4.0, 0.1}));
}

}  // namespace study_test
