#include "result/braille.hpp"

#include "apps/temporary_directory.hpp"
#include "result/report.hpp"
#include "support/program.hpp"

namespace braille_test {

LineChart chart(std::vector<double> values) {
  LineChart made{.title = "error", .x_label = "s", .y_label = "m", .x = {}, .curves = {}};
  for (std::size_t k = 0; k < values.size(); ++k) made.x.push_back(static_cast<double>(k));
  made.curves.push_back({"imm", "imm", std::move(values)});
  return made;
}

std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Braille, DrawsARiseFromBelowToAbove) {
  // 20 characters are 40 dots across, 2 lines 8 down; the value of dot x is x.
  std::vector<double> values(40);
  for (std::size_t k = 0; k < 40; ++k) values[k] = static_cast<double>(k);
  const auto lines = lines_in(braille(chart(values), 25, 2, false));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], "error: m");
  EXPECT_EQ(lines[1].substr(0, 5), "39.0 ");
  EXPECT_EQ(lines[2].substr(0, 5), " 0.0 ");
  EXPECT_EQ(lines[1].substr(5, 10), "          ");
  EXPECT_EQ(lines[1].substr(lines[1].size() - 3), "⠉");  // both dots on top
  EXPECT_EQ(lines[2].substr(5, 3), "⣀");                 // both dots at the bottom
  EXPECT_EQ(lines[3].substr(lines[3].size() - 4), "39 s");
  EXPECT_EQ(lines[4], "     imm");
}

TEST(Braille, LeavesAGapWhereNothingIsKnown) {
  std::vector<double> values(40, 1.0);
  for (std::size_t k = 10; k < 30; ++k) values[k] = not_a_number;
  const auto lines = lines_in(braille(chart(values), 25, 1, false));
  EXPECT_EQ(lines[1], "1.00 ⠉⠉⠉⠉⠉          ⠉⠉⠉⠉⠉");
  auto joined = chart(values);
  joined.joined = true;
  EXPECT_EQ(lines_in(braille(joined, 25, 1, false))[1], "1.00 ⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉");
}

TEST(Braille, IsNothingWithoutNumbers) {
  EXPECT_EQ(braille(chart({}), 79, 7, false), "");
  EXPECT_EQ(braille(chart({not_a_number}), 79, 7, false), "");
}

TEST(Braille, NamesTheCurvesInTheirColours) {
  const std::string text = braille(chart({1.0, 2.0}), 40, 2, true);
  EXPECT_TRUE(says(text, {"\x1B[36mimm\x1B[0m"}));
}

TEST(Braille, BreaksWhatIsWiderThanTheChart) {
  LineChart made = chart({1.0, 2.0});
  made.curves.clear();
  for (int i = 0; i < 20; ++i)
    made.curves.push_back({"σ of " + std::to_string(i), "x" + std::to_string(i), {1.0, 2.0}});
  const auto lines = lines_in(braille(made, 40, 2, false));
  std::string names;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_LE(display_width(lines[i]), 40U) << lines[i];
    if (i >= 4) names += lines[i] + "\n";
  }
  EXPECT_EQ(names.substr(0, names.find('\n')), "     σ of 0  σ of 1  σ of 2  σ of 3");
  for (const Curve& curve : made.curves) EXPECT_NE(names.find(curve.name), std::string::npos) << names;
}

TEST(Braille, NamesDoNotCommandTheTerminal) {
  LineChart made = chart({1.0, 2.0});
  made.title += "\x1B[2J";
  made.curves.front().name += "\x1B[2J";
  const std::string text = braille(made, 40, 2, false);
  EXPECT_EQ(text.find('\x1B'), std::string::npos);
  EXPECT_TRUE(says(text, {"imm\\x1B[2J"}));
}

}  // namespace braille_test
