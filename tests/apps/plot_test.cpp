#include "examples/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "apps/temporary_directory.hpp"
#include "support/throws.hpp"

namespace sigmax::apps {
namespace {

using sigmax::support::throws;

/// How often `part` occurs.
int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The width is 720, the height 400; 70 are left free at the left, 40 above, 55 below, and at the right 60 and 7.5 for
/// each letter of the longest name.
TEST(Plot, PutsNumbersWhereTheirAxesSay) {
  Plot plot{"Errors", "scan", "RMSE"};
  plot.line("sum", {0.0, 5.0, 10.0}, {0.0, 0.5, 1.0});
  plot.points("best", {10.0}, {0.2});
  const std::string svg = plot.svg();
  EXPECT_EQ(count(svg, "points=\"70.0,345.0 350.0,192.5 630.0,40.0\""), 1);
  EXPECT_EQ(count(svg, "cx=\"630.0\" cy=\"284.0\""), 1);
}

TEST(Plot, LabelsRoundTicks) {
  Plot plot{"Errors", "scan", "RMSE"};
  plot.line("sum", {0.3, 9.7}, {0.02, 0.98});
  const std::string svg = plot.svg();
  for (const char* label : {">0<", ">2<", ">4<", ">6<", ">8<", ">10<", ">0.2<", ">0.4<", ">0.6<", ">0.8<", ">1<"})
    EXPECT_GE(count(svg, label), 1) << label;
  EXPECT_EQ(count(svg, ">0.5<"), 0);
  EXPECT_EQ(count(svg, "-0"), 0);
  EXPECT_EQ(count(svg, ">scan<") + count(svg, ">RMSE<") + count(svg, ">Errors<") + count(svg, ">sum<"), 4);
}

TEST(Plot, ShowsNegativeAndConstantNumbers) {
  Plot plot{"", "", ""};
  plot.line("a", {-30.0, 30.0}, {5.0, 5.0});
  const std::string svg = plot.svg();
  for (const char* label : {">-30<", ">-20<", ">0<", ">30<", ">5<", ">6<"}) EXPECT_EQ(count(svg, label), 1) << label;
  EXPECT_EQ(count(svg, "nan"), 0);
}

TEST(Plot, EscapesItsTexts) {
  Plot plot{"a < b & c", "", ""};
  plot.line("<name>", {0.0, 1.0}, {0.0, 1.0});
  const std::string svg = plot.svg();
  EXPECT_EQ(count(svg, "a &lt; b &amp; c"), 1);
  EXPECT_EQ(count(svg, "&lt;name&gt;"), 1);
}

TEST(Plot, IsSavedWhole) {
  const TemporaryDirectory directory;
  Plot plot{"Errors", "scan", "RMSE"};
  plot.line("sum", {0.0, 1.0}, {0.0, 1.0});
  plot.save(directory.path() / "plot.svg");
  std::ostringstream saved;
  saved << std::ifstream(directory.path() / "plot.svg").rdbuf();
  EXPECT_EQ(saved.str(), plot.svg());
}

TEST(Plot, RefusesWhatItCannotShow) {
  Plot plot{"Errors", "scan", "RMSE"};
  EXPECT_TRUE(throws<std::logic_error>([&] { plot.svg(); }, {"Errors", "nothing"}));
  using Bad = std::invalid_argument;
  EXPECT_TRUE(throws<Bad>([&] { plot.line("sum", {1.0, 2.0}, {1.0}); }, {"sum"}));
  EXPECT_TRUE(throws<Bad>([&] { plot.points("sum", {}, {}); }, {"sum"}));
  EXPECT_TRUE(throws<Bad>([&] { plot.line("sum", {1.0}, {NAN}); }, {"sum", "finite"}));
}

}  // namespace
}  // namespace sigmax::apps
