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
