// The code of docs/extending.md that makes a world of recognition_demo, and what it writes.
#include <sigmax/core/transform.hpp>

#include "apps/temporary_directory.hpp"
#include "recognition_demo/world.hpp"
#include "table/csv.hpp"

namespace world_walk_test {

struct Written {
  std::string printed, curves;
};

void run_coins(const DrawOptions& options) {
  const RandomVariable coin{"coin", {"fair", "bent"}}, side{"side", {"heads", "tails"}};
  const Relation<Random, Random> probable{side, coin, {{0.5, 0.5}, {0.2, 0.8}}};
  const auto possible = with_fuzzy_condition(to_possibility(probable, RatioScale{}));
  const std::vector<NamedClassifier> contestants = {{"sigma", Classifier{uninformative(coin), probable}},
                                                    {"max", Classifier{uninformative(as_fuzzy(coin)), possible}}};
  const auto draw_run = [&](std::size_t run) {
    RandomStream random(options.seed, run);
    const std::size_t truth = random.index(coin.size());
    std::vector<Readings> throws;
    for (int k = 0; k < 10; ++k) throws.push_back({random.draw(probable.row(truth))});
    return Drawn{truth, throws};
  };
  World world{"Which coin is it?", {{contestants, draw_run}}};
  world.tell = [&](const std::vector<Scores>& scores, Result& result) {
    result.say("Ten throws of one of two coins");
    add_scores(result, scores.front());
  };
  ResultFiles files(options.output);
  run_world(world, options, files);
}

Written written_by(int threads) {
  const TemporaryDirectory directory;
  testing::internal::CaptureStdout();
  run_coins({.runs = 4000, .threads = threads, .output = {.out = directory.path().string(), .quiet = true}});
  std::fflush(stdout);
  return {testing::internal::GetCapturedStdout(), contents(directory.path() / "curves.csv")};
}

/// The share of runs that Bayes' rule gets right: it names the likelier coin for each number of heads.
double right_by_bayes() {
  double sum = 0.0, ways = 1.0;  // of so many heads in ten
  for (int heads = 0; heads <= 10; ++heads) {
    sum += 0.5 * ways * std::max(std::pow(0.5, 10), std::pow(0.2, heads) * std::pow(0.8, 10 - heads));
    ways *= (10.0 - heads) / (heads + 1.0);
  }
  return sum;
}

TEST(WorldWalk, TellsWhichCoinItIs) {
  const Written by_one = written_by(1);
  EXPECT_TRUE(by_one.printed.starts_with("Ten throws of one of two coins\n\n")) << by_one.printed;
  EXPECT_NE(by_one.printed.find("\nreports:           1     2     5    10"), std::string::npos) << by_one.printed;
  std::istringstream curves(by_one.curves);
  CsvReader reader(curves, "curves.csv");
  std::vector<double> last;
  for (CsvRow row; reader.next(row);)
    if (row.number(reader.column("report")) == 10.0) last.push_back(row.number(reader.column("accuracy")));
  ASSERT_EQ(last.size(), 2U);
  EXPECT_NEAR(last[0], right_by_bayes(), 0.025);  // four standard deviations
  EXPECT_LT(last[1], last[0]);
  const Written by_three = written_by(3);
  EXPECT_EQ(by_three.curves, by_one.curves);
}

}  // namespace world_walk_test
