#include "result/pictures.hpp"

#include "apps/has_gnuplot.hpp"
#include "apps/temporary_directory.hpp"
#include "result/report.hpp"
#include "support/program.hpp"

namespace pictures_test {

LineChart chart_of(std::string title, std::vector<Curve> curves) {
  return {.title = std::move(title),
          .x_label = "time, s",
          .y_label = "error, m",
          .x = {1.0, 2.0, 3.0},
          .curves = std::move(curves)};
}

std::string script_of(LineChart chart, std::vector<ReportGroup> groups = {}) {
  return pictures_of({.title = "", .groups = std::move(groups), .panels = {std::move(chart)}}).at(0).script;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Pictures, OfAChartHaveItsNumbersBandsAndMarks) {
  LineChart chart = chart_of("Errors", {{"himm", "", {0.5, NAN, 1.25}, {0.25, NAN, 1.0}, {0.75, NAN, 1.5}}});
  chart.shaded = {{1.5, 2.5, "manoeuvre"}, {3.0, 3.0, "restart"}};
  chart.expected = {{0.5, 0.75, "95 %"}};
  const std::string script = script_of(chart);
  EXPECT_TRUE(says(script, {"END\n1 0.5 0.25 0.75 \n2 NaN NaN NaN \n3 1.25 1 1.5 \nEND\n"}));
  EXPECT_TRUE(
      says(script, {"set label 'Errors' at screen", "set xlabel 'time, s'", "set label 'error, m' at screen",
                    "set yrange [*<0:0<*]", "rectangle from 1.5, graph 0 to 2.5, graph 1 behind", "'manoeuvre'",
                    "arrow from 3, graph 0 to 3, graph 1", "rectangle from graph 0, first 0.5 to graph 1, first 0.75",
                    "title '95 %'", "using 1:3:4 with filledcurves", "using 1:2 with lines", "title 'himm'"}));
}

TEST(Pictures, EndAnAxisWhereTheReportDoesAndGoOnOverGapsThatAreOthersTimes) {
  LineChart chart = chart_of("Weights", {{"cv", "", {0.5, NAN, 0.25}}});
  chart.greatest_y = 1.05;
  chart.joined = true;
  chart.note = "it's cut";
  const std::string script = script_of(chart);
  EXPECT_TRUE(says(script, {"set yrange [0:1.05]"}));
  EXPECT_TRUE(says(script, {"END\n1 0.5 0.5 0.5 \n3 0.25 0.25 0.25 \nEND\n"}));
  EXPECT_TRUE(says(script, {"'it''s cut' at screen"}));
}

TEST(Pictures, ShowTheGroupsThatAreShownInTheColoursOfTheReport) {
  const LineChart chart = chart_of("Errors", {{"measurement", "measurement", {1.0, 2.0, 3.0}},
                                              {"imm", "imm", {1.0, 2.0, 3.0}},
                                              {"himm", "himm", {1.0, 2.0, 3.0}}});
  const std::string script = script_of(chart, {{"measurement", true}, {"imm", false, false}, {"himm"}});
  EXPECT_FALSE(says(script, {"'imm'"}));
  EXPECT_TRUE(says(script, {"linecolor '#7a7a7a' dashtype 1 linewidth 1.8 title 'measurement'"}));
  EXPECT_TRUE(says(script, {"linecolor '#d55e00' dashtype (8,3) linewidth 1.8 title 'himm'"}));
  EXPECT_TRUE(says(contents(SIGMAX_SOURCE "/apps/report/report.css"),
                   {"--colour-0: #0072b2; --colour-1: #d55e00; --colour-2: #009e73; --colour-3: #b0508a; "
                    "--colour-4: #a87400; --colour-5: #3d8fc4; --colour-6: #5d3fa0; --colour-7: #6b6b00;"}));
  EXPECT_TRUE(says(contents(SIGMAX_SOURCE "/apps/report/report.js"),
                   {"dashes = [[], [8, 3], [2, 3], [9, 3, 2, 3], [14, 4], [5, 5], [3, 3, 9, 3], [1, 5]]"}));
}

TEST(Pictures, OfAPlanHaveOneScaleFocusEllipsesAndHeights) {
  Plan plan{.title = "Track", .x_label = "x, m", .y_label = "y, m", .traces = {}};
  plan.traces.push_back({.name = "himm", .x = {0, 10}, .y = {0, 20}, .z = {5, 6}});
  plan.traces.push_back({.name = "flat", .shape = PlanTrace::Shape::crosses, .x = {1}, .y = {2}});
  plan.ellipses.push_back({"", 5.0, 6.0, 2.0, 1.0, 30.0});
  plan.graticule.push_back({"18.1° E", {0, 1}, {0.5, 0.5}});
  plan.focus = {0.0, 10.0, 0.0, 20.0};
  const auto pictures = pictures_of({.title = "", .panels = {plan}});
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_TRUE(
      says(pictures[0].script, {"set size ratio -1", "set xrange [-2:12]\nset yrange [-2:22]", "0 0 5 \n10 20 6 ",
                                "ellipse center 5, 6 size 4, 2 angle 30", "'18.1° E'", "title 'flat'", "pointtype 2"}));
  EXPECT_EQ(pictures[1].name, "track_in_space");
  EXPECT_TRUE(says(pictures[1].script, {"splot $data1 using 1:2:3"}));
  EXPECT_FALSE(says(pictures[1].script, {"'flat'"}));
}

TEST(Pictures, OfAHeatMapHaveItsCellsAsTheReportWritesThem) {
  const HeatMap map{.title = "Confusion",
                    .row_label = "true",
                    .column_label = "decided",
                    .rows = {"a", "b"},
                    .columns = {"a", "it's"},
                    .values = {{0.25, 3.0}, {NAN, -1.5}},
                    .value_label = "rows",
                    .diverging = true};
  const std::string script = pictures_of({.title = "", .panels = {map}}).at(0).script;
  EXPECT_TRUE(says(script, {"set cbrange [-3:3]", "set xtics ('a' 0, 'it''s' 1)", "set ytics ('a' 0, 'b' 1)",
                            "0 0 0.25 \n1 0 3 \n1 1 -1.5 \n", "'0.25' at 0, 0", "'-1.50' at 1, 1"}));
}

TEST(Pictures, AreThoseThatTheReportOpensWith) {
  const auto chart = [](std::string title) { return chart_of(std::move(title), {{"a", "", {1.0, 2.0, 3.0}}}); };
  Report report{.title = ""};
  report.panels = {chart("First"), Words{"words", "words"}, chart_of("Nothing", {{"a", "", {NAN, NAN, NAN}}})};
  report.views = {{"one", {chart("RMSE in x"), chart("rmse; IN: x")}}, {"other", {chart("Never")}}};
  report.last = {chart("π"), chart("First")};
  std::vector<std::string> names;
  for (const Picture& picture : pictures_of(report)) names.push_back(picture.name);
  EXPECT_EQ(names, (std::vector<std::string>{"first", "rmse_in_x", "rmse_in_x_2", "figure", "first_2"}));
}

/// Tests of gnuplot itself skip, visibly, where it is not installed.
class InstalledGnuplot : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  }
};

TEST(Gnuplot, TextsAreQuotedAndOnOneLine) {
  EXPECT_EQ(in_gnuplot("it's"), "'it''s'");
  EXPECT_EQ(in_gnuplot("a\nb\tc\x7F"), "'a b c '");
  EXPECT_EQ(in_gnuplot("\\n"), "'\\n'");
  EXPECT_EQ(in_gnuplot("a\xFF π"), "'a\xEF\xBF\xBD π'");
}

TEST_F(InstalledGnuplot, ShowsEachLetterAsItIs) {
  const TemporaryDirectory directory;
  const std::string file = directory.path() / "made";
  const std::string title = "a_b^2 {/Bold x} @y ~z \\n \"q\" 'r' `touch " + file + "` %d </text><b> & π";
  const std::string svg = svg_of({"", "set title " + in_gnuplot(title) + "\nplot x title " + in_gnuplot(title)});
  std::string escaped;
  for (const char letter : title)
    escaped += letter == '<' ? std::string("&lt;") : letter == '&' ? std::string("&amp;") : std::string(1, letter);
  const std::string shown = "<text>" + escaped + "</text>";
  const auto first = svg.find(shown);
  ASSERT_NE(first, std::string::npos) << svg;
  EXPECT_NE(svg.find(shown, first + 1), std::string::npos) << svg;
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(InstalledGnuplot, WritesDocumentsWithoutTheTimeOfDay) {
  const Picture picture{"", "plot sin(x)", 8.0, 5.0};
  const std::string svg = svg_of(picture), pdf = pdf_of(picture);
  EXPECT_TRUE(says(svg, {"width=\"336\" height=\"210\""}));
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
  EXPECT_EQ(pdf, pdf_of(picture));
  // The table of places is where the document says.
  const auto place = pdf.rfind("startxref\n") + 10;
  EXPECT_EQ(pdf.compare(std::stoul(pdf.substr(place)), 4, "xref"), 0);
}

TEST_F(InstalledGnuplot, HandsOnWhatGnuplotComplainsOf) {
  EXPECT_REFUSED(std::runtime_error, ("gnuplot", "undefined"), svg_of({"", "plot nothing\n"}));
}

/// Every kind of picture with labels that gnuplot, SVG and shells take for their own.
TEST_F(InstalledGnuplot, TakesAnyText) {
  const std::string nasty = "</script><b> 'q' \"r\" \\ _{@} `id` ^2\n%s \xFF";
  LineChart chart = chart_of(nasty, {{nasty, nasty, {1.0, NAN, 2.0}, {0.5, NAN, 1.5}, {1.5, NAN, 2.5}}});
  chart.shaded = {{1.5, 2.5, nasty}};
  chart.expected = {{0.5, 0.7, nasty}};
  chart.note = chart.x_label = chart.y_label = nasty;
  Plan plan{.title = nasty, .x_label = nasty, .y_label = nasty, .traces = {}, .note = nasty};
  plan.traces.push_back({.name = nasty, .group = nasty, .x = {0, 1}, .y = {0, 1}, .z = {0, 1}});
  plan.ellipses.push_back({nasty, 0.5, 0.5, 0.2, 0.1, 30.0});
  plan.graticule.push_back({nasty, {0, 1}, {0.5, 0.5}});
  const HeatMap heat{.title = nasty,
                     .row_label = nasty,
                     .column_label = nasty,
                     .rows = {nasty},
                     .columns = {nasty},
                     .values = {{1.0}},
                     .value_label = nasty,
                     .note = nasty};
  const auto pictures = pictures_of({.title = nasty, .groups = {{nasty}}, .panels = {chart, plan, heat}});
  ASSERT_EQ(pictures.size(), 4U);
  for (const Picture& picture : pictures) {
    EXPECT_EQ(picture.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
        << picture.name;
    const std::string svg = svg_of(picture);
    EXPECT_TRUE(says(svg, {"&lt;/script>&lt;b> 'q' \"r\" \\ _{@} `id` ^2 %s \xEF\xBF\xBD"}));
    EXPECT_FALSE(says(svg, {"<b>"}));
    EXPECT_FALSE(holds(svg, "%%") || holds(svg, "0.000000")) << svg;
    EXPECT_TRUE(pdf_of(picture).starts_with("%PDF"));
  }
}

}  // namespace pictures_test
