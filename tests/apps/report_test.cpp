#include "support/report.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/report_pages.hpp"
#include "apps/temporary_directory.hpp"

namespace sigmax::apps {
namespace {

constexpr const char* nasty = "</script><b>&amp;\u2028\"";

Report example() {
  Report report{.title = nasty, .verdict = {nasty}, .command = std::string("himm_demo ") + nasty};
  report.groups = {{nasty}};
  report.chooser = nasty;
  LineChart chart{.title = nasty, .x_label = nasty, .y_label = nasty, .x = {1, 2, 3}, .curves = {}};
  chart.curves.push_back({nasty, nasty, {1.0, std::nan(""), 1.0 / 3.0}});
  chart.shaded = {{1.5, 2.5, nasty}};
  chart.expected = {{0.5, 0.7, std::string(nasty) + "!"}};
  Plan plan{.title = nasty, .x_label = nasty, .y_label = nasty, .traces = {}};
  plan.traces.push_back({.name = nasty, .group = nasty, .x = {0, 1}, .y = {0, 1}, .z = {0, 1}});
  plan.ellipses.push_back({nasty, 0.5, 0.5, 0.2, 0.1, 30.0});
  plan.graticule.push_back({nasty, {0, 1}, {0.5, 0.5}});
  ResultTable table({{.key = "name", .header = nasty, .align = Align::left}, {.key = "value", .header = nasty}});
  table.row({nasty, 0.25});
  HeatMap heat{.title = nasty,
               .row_label = nasty,
               .column_label = nasty,
               .rows = {nasty},
               .columns = {nasty},
               .values = {{1.0}},
               .value_label = nasty};
  heat.texts = {{nasty}};
  report.views = {{nasty, {chart, plan}}, {"other", {chart}}};
  report.last = {ReportTable{nasty, table, nasty}, heat, Words{nasty, nasty}, Words{nasty, nasty, true}};
  return report;
}

TEST(Report, IsDataOfWhatItWasGiven) {
  const auto data = data_of(example());
  EXPECT_EQ(data.at("title"), nasty);
  const auto& curve = data.at("views").at(0).at("panels").at(0).at("curves").at(0);
  EXPECT_EQ(curve.at("values"), nlohmann::ordered_json::parse("[1.0, null, 0.3333333]"));
  const auto& cell = data.at("last").at(0).at("rows").at(0).at(1);
  EXPECT_EQ(cell.at("value"), 0.25);
  EXPECT_EQ(cell.at("text"), "0.25");
  EXPECT_TRUE(data.at("last").at(3).at("folded"));
}

TEST(Report, LetsNoTextOutOfItsPlace) {
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const std::string page = html(example());
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_EQ(page.find("</title><b>"), std::string::npos);
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const auto from = page.find(begin) + begin.size();
  EXPECT_EQ(nlohmann::ordered_json::parse(page.substr(from, page.find("</script>", from) - from)), data_of(example()));
}

TEST(Report, TakesBytesThatAreNoText) {
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  EXPECT_NE(html({.title = "a\xFF", .verdict = {"\xC3("}}).find("\uFFFD("), std::string::npos);
}

TEST(Report, AsksForNothingFromElsewhere) {
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const std::string page = html(example());
  for (const char* outside : {"<script src", "<link", "@import", "url(http"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(Report, IsDrawnWithEveryLabelAsItIs) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  std::ofstream(directory.path() / "report.html") << html(example());
  expect_drawn(directory.path() / "report.html");
}

TEST(Report, OfSimulateIsDrawnAndHoldsTheNumbersOfTheSummary) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const auto ending =
      program::run(SIGMAX_HIMM_DEMO, {"simulate", "--quiet", "--runs", "20", "--out", directory.path()});
  ASSERT_EQ(ending.status, 0) << ending.output;
  EXPECT_LT(std::filesystem::file_size(directory.path() / "report.html"), 1000000U);
  expect_drawn(directory.path() / "report.html", directory.path() / "summary.json");
}

TEST(Report, OfTrackIsDrawnAndHoldsTheNumbersOfTheSummary) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const auto ending =
      program::run(SIGMAX_HIMM_DEMO, {"track", SIGMAX_SOURCE "/apps/examples/data/drone.csv", "--quiet", "--set",
                                      "sigma_position_m=[3,3,5]", "--set", "sigma_w=1.5", "--out", directory.path()});
  ASSERT_EQ(ending.status, 0) << ending.output;
  expect_drawn(directory.path() / "report.html", directory.path() / "summary.json");
}

/// Ships that a gate turns some plots away from, one of them with a name that is no name.
TEST(Report, OfTracksHasAViewForEachWithParallelsAndWhatWasTurnedAway) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  std::ofstream file(directory.path() / "ships.csv");
  file << "time_s,latitude_deg,longitude_deg,ship\n";
  for (int k = 0; k < 60; ++k)
    for (const char* ship : {"Anna", "</script><b>"})
      file << 10 * k << ',' << 59.3 + 0.001 * k + (k == 40 ? 0.1 : 0.0) << ',' << 18.1 + 0.0005 * (k % 3) << ',' << ship
           << '\n';
  file.close();
  const auto page = directory.path() / "ships.html";
  const auto ending =
      program::run(SIGMAX_HIMM_DEMO, {"track", directory.path() / "ships.csv", "--quiet", "--track-id", "ship", "--set",
                                      "sigma_position_m=30", "--set", "gate_probability=0.999", "--report", page});
  ASSERT_EQ(ending.status, 0) << ending.output;
  const std::string text = contents(page);
  EXPECT_EQ(text.find("</script><b>"), std::string::npos);
  for (const char* part : {"\"name\":\"Anna\"", "\"rejected by himm\"", "59.35° N", "18.1° E"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  expect_drawn(page);
}

TEST(Report, OfALongRecordingIsThinnedAndSaysSo) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  std::ofstream file(directory.path() / "long.csv");
  file << "time_s,x_m,y_m\n";
  for (int k = 0; k < 20000; ++k) file << k << ',' << 10 * k + (k * 37 % 11) + (k == 15432 ? 4000 : 0) << ",0\n";
  file.close();
  const auto page = directory.path() / "long.html";
  const auto ending =
      program::run(SIGMAX_HIMM_DEMO, {"track", directory.path() / "long.csv", "--quiet", "--report", page});
  ASSERT_EQ(ending.status, 0) << ending.output;
  EXPECT_LT(std::filesystem::file_size(page), 1500000U);
  const std::string text = contents(page);
  EXPECT_NE(text.find("The charts are thinned"), std::string::npos);
  EXPECT_NE(text.find("158327"), std::string::npos) << "the outlier is among what is drawn";
}

TEST(Report, IsNotWrittenOverItsInput) {
  const TemporaryDirectory directory;
  const std::string file = directory.path() / "flight.csv";
  std::ofstream(file) << "time_s,x_m,y_m\n0,0,0\n1,1,0\n2,2,0\n3,3,0\n";
  const auto ending = program::run(SIGMAX_HIMM_DEMO, {"track", file, "--report", file});
  EXPECT_EQ(ending.status, 2);
  if (has_reports()) EXPECT_NE(ending.output.find("--report"), std::string::npos) << ending.output;
  EXPECT_TRUE(contents(file).starts_with("time_s,x_m,y_m"));
}

TEST(Report, OfEvaluateHasConfusionMatricesAndTheNumbersOfTheSummary) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const auto ending =
      program::run(SIGMAX_RECOGNITION_DEMO, {"evaluate", SIGMAX_SOURCE "/apps/examples/data/fruit.csv", "--label",
                                             "fruit", "--foldings", "2", "--quiet", "--out", directory.path()});
  ASSERT_EQ(ending.status, 0) << ending.output;
  expect_drawn(directory.path() / "report.html", directory.path() / "summary.json");
}

TEST(Report, OfClassifyExplainsAChosenRow) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const std::string model = directory.path() / "fruit.json", page = directory.path() / "fruit.html";
  ASSERT_EQ(program::run(SIGMAX_RECOGNITION_DEMO,
                         {"train", SIGMAX_SOURCE "/apps/examples/data/fruit.csv", "--label", "fruit", "--model", model})
                .status,
            0);
  const auto ending =
      program::run(SIGMAX_RECOGNITION_DEMO, {"classify", model, SIGMAX_SOURCE "/apps/examples/data/fruit_new.csv",
                                             "--rows", "3", "--quiet", "--report", page});
  ASSERT_EQ(ending.status, 0) << ending.output;
  const std::string text = contents(page), begin = "id=\"data\">";
  const auto from = text.find(begin) + begin.size();
  const auto data = nlohmann::ordered_json::parse(text.substr(from, text.find("</script>", from) - from));
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

TEST(Report, OfEsmShowsTheSupportOfEachPlatformOverTime) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const auto ending =
      program::run(SIGMAX_RECOGNITION_DEMO, {"esm", "--runs", "50", "--quiet", "--out", directory.path()});
  ASSERT_EQ(ending.status, 0) << ending.output;
  expect_drawn(directory.path() / "report.html", directory.path() / "summary.json");
}

TEST(Report, OfAllFiltersStaysBelowAMegabyte) {
  const TemporaryDirectory directory;
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const auto file = directory.path() / "all.html";
  const auto ending =
      program::run(SIGMAX_HIMM_DEMO, {"simulate", "--quiet", "--runs", "3", "--set", "filters=all", "--report", file});
  ASSERT_EQ(ending.status, 0) << ending.output;
  EXPECT_NE(ending.output.find("Wrote " + file.string() + "\n"), std::string::npos) << ending.output;
  EXPECT_LT(std::filesystem::file_size(file), 1000000U);
}

TEST(Report, IsNotBegunWhereItCannotBeWritten) {
  if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  const auto ending = program::run(SIGMAX_HIMM_DEMO, {"simulate", "--quiet", "--report", "/nowhere/report.html"});
  EXPECT_EQ(ending.status, 3);
  EXPECT_NE(ending.output.find("/nowhere/report.html: cannot be written"), std::string::npos) << ending.output;
}

}  // namespace
}  // namespace sigmax::apps
