#include "report/report.hpp"

#include "apps/report_pages.hpp"
#include "apps/rows.hpp"

namespace himm_demo_report_test {

constexpr const char* nasty = "</script><b>&amp;\u2028\"";

Report example() {
  Report report{.title = nasty, .verdict = {nasty}, .command = std::string("himm_demo ") + nasty};
  report.groups = {{nasty}};
  report.chooser = nasty;
  LineChart chart{.title = nasty, .x_label = nasty, .y_label = nasty, .x = {1, 2, 3}, .curves = {}};
  chart.curves.push_back({nasty, nasty, {1.0, std::nan(""), 1.0 / 3.0}});
  chart.shaded = {{1.5, 2.5, nasty}};
  chart.expected = {{0.5, 0.7, std::string(nasty) + "!"}};
  MapChart plan{.title = nasty, .x_label = nasty, .y_label = nasty, .traces = {}};
  plan.traces.push_back({.name = nasty, .group = nasty, .x = {0, 1}, .y = {0, 1}, .z = {0, 1}});
  plan.ellipses.push_back({nasty, 0.5, 0.5, 0.2, 0.1, 30.0});
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
  heat.marked = {{true}};
  heat.scale = 100.0;
  IntervalChart intervals{.title = nasty,
                          .x_label = nasty,
                          .rows = {nasty, "none"},
                          .series = {{.name = nasty, .group = nasty, .values = {{1.0, 0.25}, {std::nan(""), 0.0}}}},
                          .reference = 0.5,
                          .wanted_label = nasty};
  intervals.series[0].wanted = {{-HUGE_VAL, 1.5}, {std::nan(""), std::nan("")}};
  chart.histories = {{nasty, nasty, {{1.0, 2.0, nasty, 0}, {2.0, 3.0, "other", 1}}}};
  report.views = {{nasty, {chart, plan, intervals}}, {"other", {chart}}};
  report.last = {ReportTable{nasty, table, nasty}, heat, Words{nasty, nasty}, Words{nasty, nasty, true}};
  return report;
}

/// The panel of a track's page with this title.
const nlohmann::ordered_json& panel_of(const nlohmann::ordered_json& view, const std::string& title) {
  const auto& panels = view.at("panels");
  return *std::ranges::find_if(panels, [&](const auto& one) { return one.at("title") == title; });
}

class ReportPage : public InDirectory {
 protected:
  void SetUp() override {
    if (!has_reports()) GTEST_SKIP() << "built without libjs-dygraphs and node-d3";
  }

  /// Runs a subcommand with these files and options, whose words are a text, and with its results and its page here.
  void himm_demo(const char* subcommand, const Arguments& files, const char* options) {
    program::succeeds(SIGMAX_HIMM_DEMO,
                      Arguments{subcommand} + files + words(options) + Arguments{"--quiet", "--out", directory.path()});
  }
  std::filesystem::path page() const { return directory.path() / "report.html"; }
  void expect_numbers_of_the_summary() const { expect_drawn(page(), directory.path() / "summary.json"); }
};

const Arguments drone = {SIGMAX_SOURCE "/apps/examples/data/drone.csv"};

TEST(Report, IsDataOfWhatItWasGiven) {
  const auto data = data_of(example());
  EXPECT_EQ(data.at("title"), nasty);
  const auto& curve = data.at("views").at(0).at("panels").at(0).at("curves").at(0);
  EXPECT_EQ(curve.at("values"), nlohmann::ordered_json::parse("[1.0, null, 0.3333333]"));
  const auto& cell = data.at("last").at(0).at("rows").at(0).at(1);
  EXPECT_EQ(cell.at("value"), 0.25);
  EXPECT_EQ(cell.at("text"), "0.25");
  EXPECT_TRUE(data.at("last").at(3).at("folded"));
  EXPECT_EQ(data.at("last").at(1).at("shown"), nlohmann::ordered_json::parse(R"([["100.00*"]])"));
  const auto& intervals = data.at("views").at(0).at("panels").at(2).at("series").at(0);
  EXPECT_EQ(intervals.at("values"), nlohmann::ordered_json::parse("[[1.0, 0.75, 1.25], [null, null, null]]"));
  EXPECT_EQ(intervals.at("shown"), nlohmann::ordered_json::parse(R"(["1.00 ± 0.25", "–"])"));
  EXPECT_TRUE(intervals.at("wanted").at(0).at("from").is_null());
}

TEST_F(ReportPage, LetsNoTextOutOfItsPlace) {
  const std::string page = html(example());
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_EQ(page.find("</title><b>"), std::string::npos);
  EXPECT_EQ(data_in(directory.write("report.html", page)), data_of(example()));
}

TEST_F(ReportPage, TakesBytesThatAreNoText) {
  EXPECT_TRUE(says(html({.title = "a\xFF", .verdict = {"\xC3("}}), {"\uFFFD("}));
}

TEST_F(ReportPage, AsksForNothingFromElsewhere) {
  const std::string page = html(example());
  for (const char* outside : {"<script src", "<link", "@import", "url(http"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST_F(ReportPage, IsDrawnWithEveryLabelAsItIs) { expect_drawn(directory.write("report.html", html(example()))); }

TEST_F(ReportPage, OfSimulateIsDrawnAndHoldsTheNumbersOfTheSummary) {
  himm_demo("simulate", {}, "--runs 20");
  EXPECT_LT(std::filesystem::file_size(page()), 1000000U);
  expect_numbers_of_the_summary();
}

TEST_F(ReportPage, OfTrackIsDrawnAndHoldsTheNumbersOfTheSummary) {
  himm_demo("track", drone, "--set sigma_position_m=[3,3,5] --set sigma_w=1.5");
  expect_numbers_of_the_summary();
}

/// What the page of a run holds, and what its summary says.
struct Written {
  nlohmann::ordered_json data, summary;
};

Written written(const std::filesystem::path& directory) {
  const auto read = [&](const std::string& name) { return nlohmann::ordered_json::parse(contents(directory / name)); };
  auto summary = read("summary.json");
  return {read(summary.at("report_data")), std::move(summary)};
}

/// The fields of the lines of a file that begin so, after the beginning.
std::vector<std::string> lines_with(const std::filesystem::path& file, const std::string& beginning) {
  std::istringstream text(contents(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(beginning)) lines.push_back(line.substr(beginning.size()));
  return lines;
}

TEST_F(ReportPage, OfSimulateDrawsTheCurvesThatRmseCsvHolds) {
  himm_demo("simulate", {}, "--runs 3");
  const auto data = written(directory.path()).data;
  const auto& chart = data.at("panels").at(0);
  ASSERT_EQ(chart.at("title"), "RMSE in x");
  for (const auto& curve : chart.at("curves"))
    for (std::size_t k = 0; k < curve.at("values").size(); ++k) {
      const auto cell = lines_with(directory.path() / "rmse.csv",
                                   std::to_string(k + 1) + "," + curve.at("name").get<std::string>() + ",x,");
      ASSERT_EQ(cell.size(), 1U);
      if (cell[0].empty()) {
        EXPECT_TRUE(curve.at("values")[k].is_null());
      } else {
        EXPECT_NEAR(curve.at("values")[k].get<double>(), std::stod(cell[0]), 1e-6 * std::stod(cell[0]));
      }
    }
}

TEST_F(ReportPage, OfReproduceShowsEverySentenceAndTheFiguresThatDecide) {
  himm_demo("reproduce", {}, "--runs 3");
  EXPECT_LT(std::filesystem::file_size(page()), 1000000U);
  const auto [data, summary] = written(directory.path());
  EXPECT_EQ(data.at("panels").at(0).at("rows").size(), summary.at("sentences").size());
  EXPECT_EQ(data.at("views").size(), 16U) << "presets, scenarios and groups";
  std::size_t figures = 0;
  for (const auto& view : data.at("views"))
    for (const auto& panel : view.at("panels"))
      if (!panel.at("wanted_label").empty() && !panel.at("title").get<std::string>().starts_with("RMSE in"))
        figures += panel.at("rows").size();
  EXPECT_EQ(figures, std::ranges::count_if(rows_of(directory.path() / "figures.csv"), [](const TextRow& row) {
              return row.at("imm") == "correct" &&
                     row.at("reading") == (row.at("preset") == "released" ? "released" : "own");
            }));
  const auto& map = data.at("last").at(0);
  for (std::size_t row = 0; row < map.at("rows").size(); ++row) {
    const auto& own = summary.at("over_measurement").at("paper_text").at(map.at("rows")[row]);
    for (std::size_t column = 0; column < map.at("columns").size(); ++column)
      if (const auto& value = map.at("values")[row][column]; !value.is_null())
        EXPECT_EQ(value, own.at(map.at("columns")[column])) << map.at("rows")[row];
  }
  expect_drawn(page());
}

TEST_F(ReportPage, OfSweepIsAMapOfConditionsAndFilters) {
  const auto sweep = [&](const std::string& out, const Arguments& more) {
    const auto small = words(
        "sweep --quiet --scenario 2 --filters imm,himm_own --probability 0.05 --possibility 0.2,0.5 --sigma-w 3 "
        "--augmentation zero --mismatch 1,2 --period 2 --strength 1 --length 0.5,1 --tuning-runs 1 --runs 2 --out");
    program::succeeds(SIGMAX_HIMM_DEMO, small + Arguments{directory.path() / out} + more);
    return directory.path() / out;
  };
  const auto alone = sweep("alone", {}), crossed = sweep("crossed", {"--cross"});
  const auto data = written(alone).data;
  const auto& map = data.at("panels").at(0);
  const auto rows = map.at("rows").get<std::vector<std::string>>();
  const auto row = static_cast<std::size_t>(std::find(rows.begin(), rows.end(), "noise ×2") - rows.begin());
  ASSERT_LT(row, rows.size());
  ASSERT_EQ(map.at("columns"), nlohmann::ordered_json::parse(R"(["HIMM", "himm_own"])"));
  const auto tuned =
      row_with(rows_of(alone / "tuned.csv"),
               {{"noise", "2"}, {"period", "1"}, {"strength", "1"}, {"length", "1"}, {"filter", "himm_own"}});
  EXPECT_NEAR(map.at("values")[row][1].get<double>(), std::stod(tuned.at("above_imm")), 1e-9);
  EXPECT_TRUE(says(map.at("texts")[row][1].get<std::string>(), {"leaving " + tuned.at("leaving")}));
  const auto crossing = written(crossed).data;
  EXPECT_EQ(crossing.at("panels").at(0).at("columns").size(), 2U);
  EXPECT_EQ(crossing.at("panels").at(0).at("rows").size(), 4U);
  expect_drawn(alone / "report.html");
  expect_drawn(crossed / "report.html");
  const auto merged = directory.path() / "merged.html";
  sweep("merged", {"--cross", "--merge", crossed, "--report", merged});
  EXPECT_TRUE(says(contents(merged), {"against the tuned IMM"}));
}

TEST_F(ReportPage, OfTuneShowsInnovationsAndFoldsBeforeAndAfter) {
  const auto page = directory.path() / "tune.html", found = directory.path() / "tune.json";
  const auto ending = program::run(
      SIGMAX_HIMM_DEMO,
      words("tune --quiet --set filters=imm --set sigma_position_m=[30,30,30] --models dwna --starts 1 --folds 2") +
          drone + Arguments{"--summary", found, "--report", page});
  if (ending.output.find("built without an optimiser") != std::string::npos) GTEST_SKIP() << "built without NLopt";
  ASSERT_EQ(ending.status, 0) << ending.output;
  const auto summary = nlohmann::ordered_json::parse(contents(found));
  const auto& filter = summary.at("filters").at("imm");
  EXPECT_LT(filter.at("held_out").at("all folds").at("best"), filter.at("held_out").at("all folds").at("before"));
  EXPECT_LT(filter.at("before").at("sensors").at("all rows").at("nis"), 0.5) << "the sigmas are far too great";
  EXPECT_TRUE(filter.at("settings").contains("sigma_position_m")) << filter.at("settings");
  expect_drawn(page, found);
}

TEST_F(ReportPage, OfAFilterThatKeepsHistoriesShowsTheBestOne) {
  himm_demo("track", drone, "--set filters=himm_histories --set explain=true --set sigma_position_m=[3,3,5]");
  const auto [data, summary] = written(directory.path());
  const auto& told = summary.at("histories").at("himm_histories").at("");
  const auto& drawn =
      panel_of(data.at("views").at(0), "Mode weights of himm_histories").at("histories").at(0).at("stays");
  ASSERT_EQ(drawn.size(), told.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(drawn[i].at("label"), told[i].at("mode"));
    EXPECT_NEAR(
        drawn[i].at("from").get<double>(),
        told[i].at("since_s").get<double>() - told[0].at("since_s").get<double>() + drawn[0].at("from").get<double>(),
        1e-3);
    EXPECT_LE(drawn[i].at("from"), drawn[i].at("to"));
  }
  expect_numbers_of_the_summary();
}

/// Ships that a gate turns some detections away from, one of them with a name that is no name.
TEST_F(ReportPage, OfTracksHasAViewForEachWithWhatWasTurnedAway) {
  std::ofstream file(directory.path() / "ships.csv");
  file << "time_s,latitude_deg,longitude_deg,ship\n";
  for (int k = 0; k < 60; ++k)
    for (const char* ship : {"Anna", "</script><b>"})
      file << 10 * k << ',' << 59.3 + 0.001 * k + (k == 40 ? 0.1 : 0.0) << ',' << 18.1 + 0.0005 * (k % 3) << ',' << ship
           << '\n';
  file.close();
  const auto page = directory.path() / "ships.html";
  program::succeeds(SIGMAX_HIMM_DEMO,
                    {"track", directory.path() / "ships.csv", "--quiet", "--track-id", "ship", "--set",
                     "sigma_position_m=30", "--set", "gate_probability=0.999", "--report", page});
  const std::string text = contents(page);
  EXPECT_EQ(text.find("</script><b>"), std::string::npos);
  EXPECT_TRUE(says(text, {"\"name\":\"Anna\"", "\"rejected by himm\""}));
  expect_drawn(page);
}

/// The mean NIS of the last 20 rows lies in a band of as many quantities as they have, of velocities too.
TEST_F(ReportPage, OfRowsWithMoreQuantitiesExpectsMoreOfTheNis) {
  for (const bool always : {true, false}) {
    std::string rows = "time_s,x_m,y_m,vx_mps,vy_mps\n";
    for (int k = 0; k < 40; ++k)
      rows += std::to_string(k) + "," + std::to_string(10 * k) + (always || k % 2 == 0 ? ",7,10,0\n" : ",7,,\n");
    himm_demo("track", {directory.write("moves.csv", rows)}, "--set sigma_velocity_mps=1");
    const auto [data, summary] = written(directory.path());
    const auto& usual = panel_of(data.at("views").at(0), "NIS a measured quantity").at("curves").front();
    const auto last = [&](const char* end) { return usual.at(end).back().get<double>(); };
    // The quantiles of χ² with 80 and 60 degrees of freedom.
    EXPECT_NEAR(last("lower"), always ? 57.1532 / 80 : 40.4817 / 60, 1e-5);
    EXPECT_NEAR(last("upper"), always ? 106.6286 / 80 : 83.2977 / 60, 1e-5);
  }
}

/// Speed and course are those of the velocities in estimates.csv, and so are their bands where the axes do not depend
/// on each other; a course is clockwise from y, within one turn.
TEST_F(ReportPage, OfATurningTargetTellsHowFastAndWhichWay) {
  std::string rows = "time_s,x_m,y_m\n";
  for (int k = 0; k < 150; ++k)
    rows += fmt::format("{},{:.6f},{:.6f}\n", k, 1000.0 * std::sin(0.06 * k), -1000.0 * std::cos(0.06 * k));
  himm_demo("track", {directory.write("turns.csv", rows)},
            "--set filters=imm --set models=[dwpa] --set sigma_position_m=5");
  const auto data = written(directory.path()).data;
  const auto& speed = panel_of(data.at("views").at(0), "Speed").at("curves").at(0);
  const auto& course = panel_of(data.at("views").at(0), "Course").at("curves").at(0);
  std::size_t k = 0, c = 0;
  for (const std::string& line : lines_with(directory.path() / "estimates.csv", "")) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (cells.front() == "time_s") continue;
    const double vx = std::stod(cells.at(5)), vy = std::stod(cells.at(6));
    const double sx = std::stod(cells.at(14)), sy = std::stod(cells.at(15)), v = std::hypot(vx, vy);
    while (speed.at("values").at(k).is_null()) ++k;
    EXPECT_NEAR(speed.at("values").at(k).get<double>(), v, 1e-4);
    EXPECT_NEAR(speed.at("upper").at(k).get<double>(), v + 2.0 * std::hypot(vx * sx, vy * sy) / v, 1e-4);
    while (course.at("values").at(c).is_null()) ++c;
    const double degrees = course.at("values").at(c).get<double>(), radians = degrees * M_PI / 180.0;
    EXPECT_NEAR(std::sin(radians) * v, vx, 1e-3);
    EXPECT_NEAR(std::cos(radians) * v, vy, 1e-3);
    EXPECT_TRUE(degrees >= 0.0 && degrees <= 360.0) << degrees;
    EXPECT_NEAR(course.at("upper").at(c).get<double>() - degrees,
                2.0 * std::hypot(vy * sx, vx * sy) / v / v * 180.0 / M_PI, 1e-3);
    ++k, ++c;
  }
}

/// Dates make an axis of clock times, a header in knots one of knots; lines break where there is no row for long.
TEST_F(ReportPage, OfDatesAndKnotsHasClockTimesAndKnots) {
  std::string rows = "time_s,latitude_deg,longitude_deg,SOG_knots\n";
  for (int k = 0; k < 60; ++k)
    rows += fmt::format("2016-01-12T1{}:{:02}:{:02}Z,{:.6f},18,10\n", k < 40 ? 3 : 4, k / 6, k % 6 * 10, 59 + 1e-4 * k);
  himm_demo("track", {directory.write("ship.csv", rows)}, "--set sigma_position_m=3 --set filters=himm");
  const auto data = written(directory.path()).data;
  const auto& view = data.at("views").at(0);
  const auto& speed = panel_of(view, "Speed");
  EXPECT_EQ(speed.at("x_label"), "time, UTC");
  EXPECT_EQ(speed.at("clock"), 1452603600.0);
  EXPECT_EQ(speed.at("joined"), 100.0);
  EXPECT_EQ(speed.at("y_label"), "kt; band: ± 2 σ");
  const double degree_m = 111403.0;  // along the meridian there
  EXPECT_NEAR(speed.at("curves").at(0).at("values").at(39), 1e-5 * degree_m * 3600 / 1852, 0.1);
  for (const char* const name : {"measurement", "himm"}) {
    const auto& traces = view.at("panels").at(0).at("traces");
    const auto trace = std::ranges::find_if(traces, [&](const auto& one) { return one.at("name") == name; });
    EXPECT_EQ(std::ranges::count_if(trace->at("y"), &nlohmann::ordered_json::is_null), 1) << name;
  }
  const auto& weights = panel_of(view, "Mode weights of himm");
  EXPECT_EQ(weights.at("y_label"), "possibilities");
  EXPECT_EQ(weights.at("range"), nlohmann::ordered_json::parse("[0.0, 1.05]"));
  expect_drawn(page());
}

TEST(Report, EndsAnAxisWhereMostNumbersAre) {
  LineChart chart{.curves = {{.values = std::vector<double>(100, 2.0)}}};
  chart.curves[0].values[7] = 3.0;
  keep_usual(chart);
  EXPECT_FALSE(chart.greatest_y);
  chart.curves[0].values[1] = 500.0;
  keep_usual(chart);
  EXPECT_NEAR(*chart.greatest_y, 2.3, 1e-12);
  EXPECT_EQ(chart.note, "The axis is cut; numbers and bands go from 0.0 to 500.0.");
}

/// A list of all tracks, which the summary has too; one that is too short says why it has no estimate.
TEST_F(ReportPage, OfManyTracksListsThemAll) {
  std::string rows = "time_s,x_m,y_m,id\n";
  for (int k = 0; k < 20; ++k)
    for (int id = 0; id < 14; ++id)
      if (id > 0 || k == 0) rows += fmt::format("{},{},{},ship{}\n", k, 10 * k + 1000 * id, 5 * (k % 2), id);
  himm_demo("track", {directory.write("ships.csv", rows)}, "--track-id id --set gate_probability=0.99");
  const auto [data, summary] = written(directory.path());
  EXPECT_EQ(data.at("views").size(), 14U);
  EXPECT_NE(data.at("views").front().at("name"), "ship0") << "the first one is short";
  const auto& view = data.at("views").back();
  EXPECT_EQ(view.at("name"), "ship0");
  EXPECT_TRUE(says(view.at("panels").back().at("text").get<std::string>(), {"1 measurement; a filter starts from 3"}));
  EXPECT_EQ(data.at("panels").at(1).at("traces").size(), 14U);
  EXPECT_EQ(data.at("panels").at(2).at("rows").size(), 14U);
  const auto& one = summary.at("tracks").at("each").at("ship3");
  EXPECT_EQ(one.at("rows"), 20);
  EXPECT_EQ(one.at("duration_s"), 19.0);
  EXPECT_NEAR(one.at("way_m").get<double>(), 160.0, 40.0) << "from the fourth row on";
  expect_numbers_of_the_summary();
}

TEST_F(ReportPage, OfALongRecordingIsThinnedAndSaysSo) {
  std::ofstream file(directory.path() / "long.csv");
  file << "time_s,x_m,y_m\n";
  for (int k = 0; k < 20000; ++k) file << k << ',' << 10 * k + (k * 37 % 11) + (k == 15432 ? 4000 : 0) << ",0\n";
  file.close();
  const auto page = directory.path() / "long.html";
  const auto ending =
      program::succeeds(SIGMAX_HIMM_DEMO, {"track", directory.path() / "long.csv", "--quiet", "--report", page});
  EXPECT_LT(std::filesystem::file_size(page), 6000000U);
  const std::string text = contents(page);
  EXPECT_TRUE(says(text, {"The charts are thinned", "158327"}));
}

TEST_F(ReportPage, OfAllFiltersStaysBelowAMegabyte) {
  himm_demo("simulate", {}, "--runs 3 --set filters=all");
  EXPECT_LT(std::filesystem::file_size(page()), 1000000U);
}

}  // namespace himm_demo_report_test
