#include "support/table.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace sigmax::apps {
namespace {

TextTable example() {
  TextTable table{{{"filter", Align::left}, {"RMSE x, m"}, {"β ∈ [1, 2]"}}};
  table.row({"IMM", "12.30", "1"});
  table.row({"HIMM σ²", "5.125", "1.2"});
  return table;
}

TEST(Table, AlignsColumnsBelowTheirHeaders) {
  EXPECT_EQ(example().text(),
            "filter   RMSE x, m  β ∈ [1, 2]\n"
            "───────  ─────────  ──────────\n"
            "IMM          12.30           1\n"
            "HIMM σ²      5.125         1.2\n");
}

TEST(Table, DrawsRulesBetweenRows) {
  TextTable table{{{"a", Align::left}, {"b", Align::left}}};
  table.row({"1", ""});
  table.rule();
  table.row({"", "22"});
  EXPECT_EQ(table.text(),
            "a  b\n"
            "─  ──\n"
            "1\n"
            "─  ──\n"
            "   22\n");
}

TEST(Table, ShowsControlCharactersInsteadOfObeyingThem) {
  TextTable table{{{"na\tme", Align::left}}};
  table.row({"\x1B[31mred\n"});
  table.row({"\xC2\x9B 2J"});
  EXPECT_EQ(table.text(), "na\\x09me\n───────────────\n\\x1B[31mred\\x0A\n\\x9B 2J\n");
}

TEST(Table, NeedsACellAColumn) {
  TextTable table = example();
  EXPECT_THROW(table.row({"1", "2"}), std::invalid_argument);
  EXPECT_THROW(table.row({}), std::invalid_argument);
  EXPECT_THROW(TextTable{{}}, std::invalid_argument);
}

TEST(Table, PrintsItsText) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  example().print(file);
  std::rewind(file);
  std::string printed(1024, '\0');
  printed.resize(std::fread(printed.data(), 1, printed.size(), file));
  std::fclose(file);
  EXPECT_EQ(printed, example().text());
}

/// No line of a text is wider than this.
testing::AssertionResult fits(const std::string& text, std::size_t width) {
  for (const std::string& line : lines_of(text, any_width))
    if (display_width(line) > width) return testing::AssertionFailure() << line;
  return testing::AssertionSuccess();
}

TEST(Table, IsLeftAloneWhereItFits) { EXPECT_EQ(example().text(30), example().text()); }

TEST(Table, BreaksHeadersFirst) {
  EXPECT_EQ(example().text(20),
            "                β ∈\n"
            "          RMSE  [1,\n"
            "filter    x, m   2]\n"
            "───────  ─────  ───\n"
            "IMM      12.30    1\n"
            "HIMM σ²  5.125  1.2\n");
}

TEST(Table, BreaksHeadersNoMoreThanItMust) {
  EXPECT_EQ(example().text(26),
            "                       β ∈\n"
            "filter   RMSE x, m  [1, 2]\n"
            "───────  ─────────  ──────\n"
            "IMM          12.30       1\n"
            "HIMM σ²      5.125     1.2\n");
}

TEST(Table, BreaksCellsOfWordsNext) {
  TextTable table{{{"name", Align::left}, {"n"}, {"what they are", Align::left}}};
  table.row({"legs", "6", "0, 2, 4, 5, 6, 8 as the zoo has them"});
  table.row({"hair", "2", "0, 1"});
  EXPECT_EQ(table.text(32),
            "name  n  what they are\n"
            "────  ─  ───────────────────────\n"
            "legs  6  0, 2, 4, 5, 6, 8 as the\n"
            "         zoo has them\n"
            "hair  2  0, 1\n");
}

TEST(Table, PutsColumnsInBlocksLast) {
  TextTable table{{{"filter", Align::left},
                   {"x", Align::right, "before"},
                   {"y", Align::right, "before"},
                   {"x", Align::right, "during"},
                   {"y", Align::right, "during"},
                   {"NIS"}}};
  table.row({"IMM", "12.30", "11.25", "13.37", "14.44", "3.01"});
  table.rule();
  table.row({"HIMM", "12.30", "11.25", "13.37", "14.44", "2.99"});
  EXPECT_EQ(table.text(34),
            "filter  before x      y\n"
            "──────  ────────  ─────\n"
            "IMM        12.30  11.25\n"
            "──────  ────────  ─────\n"
            "HIMM       12.30  11.25\n"
            "\n"
            "filter  during x      y   NIS\n"
            "──────  ────────  ─────  ────\n"
            "IMM        13.37  14.44  3.01\n"
            "──────  ────────  ─────  ────\n"
            "HIMM       13.37  14.44  2.99\n");
  EXPECT_TRUE(fits(table.text(16), 16)) << table.text(16);  // groups come apart
}

TEST(Table, FitsWhateverItHolds) {
  for (std::size_t columns = 1; columns < 12; ++columns) {
    std::vector<TextTable::Column> headers = {{"a title of several words", Align::left}};
    std::vector<std::string> cells = {"σ² of what was seen, π(venomous = 0|type = mammal)"};
    for (std::size_t i = 1; i < columns; ++i) {
      headers.push_back({"last − the first row's, points", Align::right, i % 3 == 0 ? "" : "group"});
      cells.push_back("-10.93 ± 2.80");
    }
    TextTable table{headers};
    table.row(cells);
    EXPECT_TRUE(fits(table.text(80), 80)) << table.text(80);
    EXPECT_TRUE(fits(table.text(45), 45)) << table.text(45);
  }
}

TEST(Wrapped, BreaksAtBlanksAndKeepsIndents) {
  EXPECT_EQ(wrapped("one two three\n\n  four five", 9), "one two\nthree\n\n  four\n  five\n");
  EXPECT_EQ(wrapped("one two three\n", any_width), "one two three\n");
  EXPECT_EQ(wrapped("incomprehensible words", 5), "incomprehensible\nwords\n");
  EXPECT_EQ(wrapped("differences ± 95 % − sigma's", 12), "differences ± 95\n% − sigma's\n");
  EXPECT_EQ(wrapped("", 5), "\n");
  EXPECT_EQ(wrapped("a\x1B[2Jb\nc", any_width), "a\\x1B[2Jb\nc\n");
}

TEST(DisplayWidth, CountsColumnsNotBytes) {
  EXPECT_EQ(display_width(""), 0U);
  EXPECT_EQ(display_width("abc"), 3U);
  EXPECT_EQ(display_width("σ² ± 3.0 °, Λ → π"), 17U);
  EXPECT_EQ(display_width("─ 95 %"), 6U);
  EXPECT_EQ(display_width("x\u0302"), 1U);     // a combining circumflex
  EXPECT_EQ(display_width("目標"), 4U);        // East Asian characters are two wide
  EXPECT_EQ(display_width("\U0001F6E9"), 2U);  // a pictograph of four bytes
  EXPECT_EQ(display_width("a\xFF\xC3"), 3U);   // bytes that are no UTF-8
}

}  // namespace
}  // namespace sigmax::apps
