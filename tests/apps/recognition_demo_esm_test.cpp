#include <nlohmann/json.hpp>

#include "apps/recognition_demo_support.hpp"
#include "shell/random.hpp"
#include "shell/text.hpp"

namespace recognition_demo_esm_test {

/// The world of docs/recognition_demo.md once more: T1{e1,e2}, T2{e2,e3}, T3{e1,e3,e4}, T4{e2,e4,e5}.
const Matrix carried = {{1, 1, 0, 0, 0}, {0, 1, 1, 0, 0}, {1, 0, 1, 1, 0}, {0, 1, 0, 1, 1}};

Matrix equal_usage() {
  return each_row(carried, [](const Numbers& row) { return divided(row, sum(row)); });
}

Matrix sensor(double right, double wrong) {
  Matrix rows(5, Numbers(5, wrong));
  for (std::size_t f = 0; f < 5; ++f) rows[f][f] = right;
  return rows;
}

struct Inference {
  std::string name;
  Matrix emitter_given_platform;
  Matrix reading_given_emitter;
  bool feature_by_max;
  bool pattern_by_max;
};

std::vector<Inference> inferences() {
  const Matrix p = sensor(0.7, 0.075), ratio = sensor(1.0, 0.075 / 0.7), dubois_prade = sensor(1.0, 0.3);
  return {{"sigma", equal_usage(), p, false, false},
          {"max, ratio scale", carried, ratio, true, true},
          {"max, Dubois-Prade", carried, dubois_prade, true, true},
          {"sigma-max", carried, p, true, true},
          {"max-sigma, ratio scale", equal_usage(), ratio, false, false},
          {"max-sigma, Dubois-Prade", equal_usage(), dubois_prade, false, false}};
}

/// What is believed after one more reading: b(c) ⊗ ⊕_f L(z|f) L(f|c), divided by its ⊕.
Numbers with_sensor_noise(const Inference& inference, const Numbers& before, std::size_t reading) {
  Numbers after;
  for (std::size_t c = 0; c < before.size(); ++c) {
    double likelihood = 0.0;
    for (std::size_t f = 0; f < 5; ++f) {
      const double term = inference.reading_given_emitter[f][reading] * inference.emitter_given_platform[c][f];
      likelihood = inference.feature_by_max ? std::max(likelihood, term) : likelihood + term;
    }
    after.push_back(before[c] * likelihood);
  }
  return divided(after, inference.pattern_by_max ? greatest(after) : sum(after));
}

double credit(const Numbers& belief, std::size_t truth) {
  const auto ties = [&](double value) { return value >= greatest(belief) * (1.0 - 1e-9); };
  if (!ties(belief[truth])) return 0.0;
  return 1.0 / static_cast<double>(std::count_if(belief.begin(), belief.end(), ties));
}

program::Ending esm(const std::filesystem::path& out, std::vector<std::string> more) {
  return recognition_demo(Arguments{"esm", "--quiet", "--out", out} + more);
}

TEST(RecognitionDemoEsm, EveryClassifierEqualsPlainLoopsOverTheReadingsOfAllRuns) {
  const TemporaryDirectory directory;
  program::succeeded(esm(directory.path(), words("--runs 60 --reports 15")));
  std::map<std::string, Numbers> accuracy;
  for (std::size_t run = 0; run < 60; ++run) {
    RandomStream random(1, run);
    const std::size_t truth = random.index(4);
    std::vector<std::size_t> readings;
    for (std::size_t k = 0; k < 15; ++k)
      readings.push_back(random.draw(sensor(0.7, 0.075)[random.draw(equal_usage()[truth])]));
    for (const auto& inference : inferences()) {
      Numbers belief(4, inference.pattern_by_max ? 1.0 : 0.25);
      Numbers& of_runs = accuracy[inference.name];
      of_runs.resize(15, 0.0);
      for (std::size_t k = 0; k < 15; ++k) {
        belief = with_sensor_noise(inference, belief, readings[k]);
        of_runs[k] += credit(belief, truth) / 60.0;
      }
    }
  }
  std::size_t compared = 0;
  for (const auto& row : rows_of(directory.path() / "curves.csv"))
    if (const auto curve = accuracy.find(row.at("classifier")); curve != accuracy.end()) {
      EXPECT_CLOSE(std::stod(row.at("accuracy")), curve->second.at(std::stoul(row.at("report")) - 1), 1e-9)
          << row.at("classifier") << ", report " << row.at("report");
      ++compared;
    }
  EXPECT_EQ(compared, 6U * 15U);
}

TEST(RecognitionDemoEsm, TheSeedChoosesTheRuns) {
  const TemporaryDirectory directory;
  for (const std::string seed : {"1", "2"})
    ASSERT_EQ(esm(directory.path() / seed, {"--runs", "5", "--seed", seed}).status, 0);
  EXPECT_NE(contents(directory.path() / "1" / "curves.csv"), contents(directory.path() / "2" / "curves.csv"));
}

TEST(RecognitionDemoEsm, IsWhatTheProgramRunsWithoutASubcommand) {
  const auto plain = recognition_demo_succeeds({"--runs", "50"});
  EXPECT_EQ(plain.output, recognition_demo({"esm", "--runs", "50"}).output);
  EXPECT_TRUE(plain.output.starts_with("Synthetic emitter world, not recorded data")) << plain.output;
}

/// The widest tables of every subcommand.
TEST(RecognitionDemoEsm, TablesFitATerminalUnlessTheyMayBeWide) {
  const auto widest = [](const std::string& text) {
    std::size_t width = 0;
    for (const std::string& line : lines_of(text, any_width)) width = std::max(width, display_width(line));
    return width;
  };
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"esm", "--alpha", "0.5", "--runs", "5"},
                                                    {"esm", "--regime", "usage", "--runs", "2", "--reports", "3"}}) {
    EXPECT_LE(widest(recognition_demo(arguments).output), 80U) << arguments.front();
    auto wide = arguments;
    wide.push_back("--wide");
    EXPECT_GT(widest(recognition_demo(wide).output), 100U) << arguments.front();
  }
}

TEST(RecognitionDemoRegimes, BeginWithTheWorldThatTheClassifiersAssume) {
  const TemporaryDirectory directory;
  ASSERT_EQ(esm(directory.path() / "esm", {"--runs", "20", "--reports", "4", "--seed", "7"}).status, 0);
  program::succeeded(
      esm(directory.path() / "regimes", {"--regime", "all", "--runs", "20", "--reports", "4", "--seed", "7"}));
  std::map<std::string, std::string> last;
  for (const auto& row : rows_of(directory.path() / "esm" / "curves.csv"))
    if (row.at("report") == "4") last[row.at("classifier")] = row.at("accuracy");
  std::size_t compared = 0;
  for (const auto& row : rows_of(directory.path() / "regimes" / "regimes.csv"))
    if (row.at("regime") == "usage" && row.at("setting") == "equal") {
      EXPECT_EQ(row.at("accuracy"), last.at(row.at("classifier"))) << row.at("classifier");
      ++compared;
    }
  EXPECT_EQ(compared, 4U);
  const auto summary = nlohmann::json::parse(contents(directory.path() / "regimes" / "summary.json"));
  EXPECT_EQ(summary.at("regimes").at("conflict").size(), 4U);
}

}  // namespace recognition_demo_esm_test
