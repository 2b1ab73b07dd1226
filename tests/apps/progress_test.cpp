#include "shell/progress.hpp"

#include "apps/terminal.hpp"
#include "shell/text.hpp"

namespace progress_test {

using namespace std::chrono_literals;

TEST(ProgressLine, ShowsPartAndTimeLeft) {
  EXPECT_EQ(Progress::line("runs", 50, 100, 7s, 45), "runs [###########...........]  50 %, 7 s left");
  EXPECT_EQ(Progress::line("runs", 0, 100, 7s, 17), "runs [....]   0 %");
  EXPECT_EQ(Progress::line("runs", 100, 100, 7s, 60), "runs [" + std::string(37, '#') + "] 100 %, 0 s left");
  EXPECT_EQ(Progress::line("σ", 1, 1000, 1s, 80), "σ [" + std::string(40, '.') + "]   0 %, 17 min left");
  EXPECT_EQ(Progress::line("σ", 1, 10000, 1s, 80), "σ [" + std::string(40, '.') + "]   0 %, 2.8 h left");
}

TEST(ProgressLine, NeverPassesAHundredPercentNorTheWidth) {
  EXPECT_EQ(Progress::line("a", 5, 4, 1s, 24), "a [####] 100 %, 0 s left");
  EXPECT_EQ(Progress::line("runs", 50, 100, 7s, 15), " 50 %, 7 s left");
  EXPECT_EQ(Progress::line("runs", 50, 100, 7s, 5), " 50 %");
  EXPECT_EQ(Progress::line("reading", 50, 0, 7s, 4), "read");
  for (std::size_t width = 0; width < 100; ++width)
    EXPECT_LE(display_width(Progress::line("σ of runs", 3, 7, 100s, width)), width);
}

TEST(Progress, IsSilentWhereThereIsNoTerminal) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_NONBLOCK), 0);
  {
    Progress progress{"runs", 10, false, ends[1]};
    std::this_thread::sleep_for(110ms);
    progress.advance(5);
  }
  char byte = 0;
  EXPECT_EQ(::read(ends[0], &byte, 1), -1);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Progress, IsSilentWhenAsked) {
  const Terminal terminal;
  if (!terminal.works()) GTEST_SKIP() << "no pseudo-terminal here";
  {
    Progress progress{"runs", 10, true, terminal.device()};
    std::this_thread::sleep_for(110ms);
    progress.advance(5);
  }
  EXPECT_EQ(terminal.seen(), "");
}

TEST(Progress, DrawsOnATerminalAndWipesItsLine) {
  const Terminal terminal;
  if (!terminal.works()) GTEST_SKIP() << "no pseudo-terminal here";
  Progress progress{"runs", 10, false, terminal.device()};
  progress.advance(1);
  EXPECT_EQ(terminal.seen(), "");  // a job that is over at once shows nothing
  std::this_thread::sleep_for(110ms);
  progress.advance(4);
  const std::string drawn = terminal.seen();
  EXPECT_TRUE(drawn.starts_with("\rruns [")) << drawn;
  EXPECT_TRUE(says(drawn, {"]  50 %, "}));
  progress.finish();
  EXPECT_EQ(terminal.seen(), "\r" + std::string(drawn.size() - 1, ' ') + "\r");
  std::this_thread::sleep_for(110ms);
  progress.advance(5);
  progress.finish();
  EXPECT_EQ(terminal.seen(), "");
}

TEST(Progress, DrawsAtMostTenTimesASecond) {
  const Terminal terminal;
  if (!terminal.works()) GTEST_SKIP() << "no pseudo-terminal here";
  const auto start = std::chrono::steady_clock::now();
  Progress progress{"runs", 1U << 30U, false, terminal.device()};
  while (std::chrono::steady_clock::now() - start < 350ms) progress.advance();
  const auto elapsed = std::chrono::steady_clock::now() - start;
  const std::string seen = terminal.seen();
  const auto drawn = std::count(seen.begin(), seen.end(), '\r');
  EXPECT_GE(drawn, 1);
  EXPECT_LE(drawn, elapsed / 100ms);
}

TEST(Progress, CountsTheWorkOfAllThreads) {
  Progress progress{"runs", 40'000, true};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&progress] {
      for (int j = 0; j < 5'000; ++j) progress.advance(2);
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(progress.done(), 40'000U);
}

}  // namespace progress_test
