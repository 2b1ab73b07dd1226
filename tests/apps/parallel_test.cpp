#include "shell/progress.hpp"
#include "support/test.hpp"

namespace parallel_test {

/// A result without a default.
struct Square {
  explicit Square(std::size_t of) : value(of * of) {}
  std::size_t value;
};

TEST(ForEachRun, AddsInTheOrderOfTheRuns) {
  for (const std::size_t runs : {0U, 1U, 9U, 1000U})
    for (const int threads : {1, 2, 7})
      for (const std::size_t block : {1U, 4U, 256U}) {
        std::size_t next = 0;
        for_each_run(
            runs, threads, [](std::size_t run) { return Square(run); },
            [&](std::size_t run, const Square& square) {
              EXPECT_EQ(run, next++);
              EXPECT_EQ(square.value, run * run);
            },
            block);
        EXPECT_EQ(next, runs);
      }
}

TEST(ForEachRun, RethrowsTheEarliestFailure) {
  for (const int threads : {1, 4}) {
    std::vector<std::size_t> added;
    try {
      for_each_run(
          100, threads,
          [](std::size_t run) {
            if (run == 23 || run == 21 || run == 50) throw std::runtime_error(std::to_string(run));
            return run;
          },
          [&](std::size_t run, std::size_t) { added.push_back(run); }, 10);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "21");
    }
    EXPECT_EQ(added.size(), 20U);
  }
}

TEST(ThreadsOrAll, TakesWhatIsAskedFor) {
  EXPECT_EQ(threads_or_all(3), 3);
  EXPECT_GE(threads_or_all(0), 1);
}

}  // namespace parallel_test
