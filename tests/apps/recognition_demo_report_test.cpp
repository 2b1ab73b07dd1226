#include "apps/recognition_demo_support.hpp"
#include "apps/report_pages.hpp"
#include "report/report.hpp"

namespace recognition_demo_report_test {

using Json = nlohmann::ordered_json;

constexpr const char* fruit = SIGMAX_SOURCE "/apps/examples/data/fruit.csv";

/// The pages of recognition_demo, which tests use in a browser.
class RecognitionReport : public InDirectory {
 protected:
  void SetUp() override {
    if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  }

  /// Runs a subcommand with --out, and returns the data of its page.
  Json page_of(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--quiet", "--out", directory.path()});
    recognition_demo_succeeds(arguments);
    summary_ = Json::parse(contents(directory.path() / "summary.json"));
    return data_in(page());
  }

  std::filesystem::path page() const { return directory.path() / "report.html"; }
  void expect_numbers_of_the_summary() const { expect_drawn(page(), directory.path() / "summary.json"); }

  Json summary_;
};

/// The numbers of two places of a page or a summary are near.
void expect_close(const Json& found, const Json& expected, double tolerance) {
  EXPECT_CLOSE(found.get<double>(), expected.get<double>(), tolerance);
}

Json panel_called(const Json& panels, const std::string& title) {
  for (const auto& panel : panels)
    if (panel.at("title") == title) return panel;
  ADD_FAILURE() << "no panel " << title;
  return {};
}

TEST_F(RecognitionReport, OfEvaluateHasConfusionMatricesAndReliabilityOfTheSummary) {
  const Json data = page_of({"evaluate", fruit, "--label", "fruit", "--foldings", "2"});
  for (const auto& [classifier, bins] : summary_.at("reliability").items()) {
    const Json chart = panel_called(data.at("panels"), "Reliability of " + classifier);
    const Json &share = chart.at("curves").at(0), &diagonal = chart.at("curves").at(1);
    ASSERT_EQ(chart.at("x").size(), bins.size());
    EXPECT_EQ(diagonal.at("values"), chart.at("x"));
    double statements = 0.0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const Json& bin = bins[i];
      expect_close(chart.at("x")[i], bin.at("mean_degree"), 1e-6);
      expect_close(share.at("values")[i], bin.at("share_that_is_true"), 1e-6);
      expect_close(share.at("lower")[i], bin.at("lower"), 1e-6);
      expect_close(share.at("upper")[i], bin.at("upper"), 1e-6);
      EXPECT_EQ(chart.at("remarks")[i], fmt::format("{:.0f}", bin.at("statements").get<double>()));
      statements += bin.at("statements").get<double>();
    }
    EXPECT_CLOSE(statements, summary_.at("rows").get<double>() * static_cast<double>(summary_.at("classes").size()),
                 1e-9);
  }
  expect_numbers_of_the_summary();
}

/// Names of classes that are no names to a page.
TEST_F(RecognitionReport, ShowsAClassAsItIsCalled) {
  std::string text = "size,colour,kind\n";
  for (int i = 0; i < 40; ++i)
    text += std::to_string(i % 7 + (i % 2) * 4) + "," + (i % 3 ? "red" : "</td>") + "," +
            (i % 2 ? "</script><b>" : "it's `x` {_} \\") + "\n";
  const auto file = directory.write("odd.csv", text);
  const Json data = page_of({"evaluate", file, "--label", "kind", "--foldings", "1", "--folds", "2"});
  EXPECT_EQ(data.at("panels").at(0).at("rows").at(0).get<std::string>() +
                data.at("panels").at(0).at("rows").at(1).get<std::string>(),
            "</script><b>it's `x` {_} \\");
  EXPECT_EQ(contents(page()).find("</script><b>"), std::string::npos);
  expect_numbers_of_the_summary();
}

TEST_F(RecognitionReport, OfClassifyExplainsAChosenRow) {
  const std::string model = directory.path() / "fruit.json", page = directory.path() / "fruit.html";
  recognition_demo_succeeds({"train", fruit, "--label", "fruit", "--model", model});
  recognition_demo_succeeds({"classify", model, SIGMAX_SOURCE "/apps/examples/data/fruit_new.csv", "--rows", "3",
                             "--quiet", "--report", page});
  const Json data = data_in(page);
  ASSERT_EQ(data.at("views").size(), 3U);
  for (const auto& view : data.at("views")) {  // the class that is explained is the one with the greatest support
    const auto& support = view.at("panels").at(0);
    const auto values = support.at("values").at(0).get<std::vector<double>>();
    const auto best = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
    const std::string why = view.at("panels").at(1).at("columns").at(0).at("header");
    EXPECT_TRUE(why.starts_with("sigma: " + support.at("columns").at(best).get<std::string>() + " rather than")) << why;
  }
  expect_drawn(page);
}

TEST_F(RecognitionReport, OfRegimesHasTheDifferencesOfTheSummary) {
  const Json data = page_of({"esm", "--regime", "all", "--runs", "20", "--reports", "5"});
  ASSERT_EQ(data.at("panels").size(), summary_.at("regimes").size());
  for (const auto& [regime, settings] : summary_.at("regimes").items()) {
    const Json map = panel_called(data.at("panels"), "Regime " + regime);
    for (std::size_t r = 0; r < map.at("rows").size(); ++r)
      for (std::size_t c = 0; c < map.at("columns").size(); ++c) {
        const Json& found = settings.at(map.at("rows")[r].get<std::string>())
                                .at(map.at("columns")[c].get<std::string>())
                                .at("accuracy_minus_that_of_the_first");
        expect_close(map.at("values")[r][c], found.at("mean"), 1e-12);
      }
  }
  expect_drawn(page());
}

}  // namespace recognition_demo_report_test
