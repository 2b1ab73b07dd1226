#include "report/table.hpp"
#include "support/test.hpp"

#include <nlohmann/json.hpp>

namespace table_test {

ResultTable example() {
  ResultTable table{{{.header = "filter", .align = Align::left}, {.header = "RMSE x, m"}, {.header = "β ∈ [1, 2]"}}};
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
  ResultTable table{{{.header = "a", .align = Align::left}, {.header = "b", .align = Align::left}}};
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
  ResultTable table{{{.header = "na\tme", .align = Align::left}}};
  table.row({"\x1B[31mred\n"});
  table.row({"\xC2\x9B 2J"});
  EXPECT_EQ(table.text(), "na\\x09me\n───────────────\n\\x1B[31mred\\x0A\n\\x9B 2J\n");
}

TEST(Table, NeedsACellAColumn) {
  ResultTable table = example();
  EXPECT_THROW(table.row({"1", "2"}), std::invalid_argument);
  EXPECT_THROW(table.row({}), std::invalid_argument);
  EXPECT_THROW(ResultTable(std::vector<ResultColumn>{}), std::invalid_argument);
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
  ResultTable table{
      {{.header = "name", .align = Align::left}, {.header = "n"}, {.header = "what they are", .align = Align::left}}};
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
  ResultTable table{{{.header = "filter", .align = Align::left},
                     {.header = "x", .group = "before"},
                     {.header = "y", .group = "before"},
                     {.header = "x", .group = "during"},
                     {.header = "y", .group = "during"},
                     {.header = "NIS"}}};
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
    std::vector<ResultColumn> headers = {{.header = "a title of several words", .align = Align::left}};
    std::vector<Cell> cells = {"σ² of what was seen, π(venomous = 0|type = mammal)"};
    for (std::size_t i = 1; i < columns; ++i) {
      headers.push_back({.header = "last − the first row's, points", .group = i % 3 == 0 ? "" : "group"});
      cells.emplace_back("-10.93 ± 2.80");
    }
    ResultTable table{headers};
    table.row(cells);
    EXPECT_TRUE(fits(table.text(80), 80)) << table.text(80);
    EXPECT_TRUE(fits(table.text(45), 45)) << table.text(45);
  }
}

ResultTable result_example() {
  ResultTable table{{{.key = "filter", .header = "filter", .align = Align::left},
                     {.key = "rmse_m", .header = "RMSE", .unit = "m"},
                     {.key = "right", .header = "right", .unit = "%", .digits = 1, .scale = 100.0},
                     {.key = "difference", .header = "− IMM's", .scale = 100.0, .sign = true, .interval = true},
                     {.header = "shown only", .align = Align::left},
                     {.key = "stored_only"}}};
  table.row({"IMM", 12.345, 0.5, {}, "yes", 3});
  table.rule();
  table.row({"HIMM, fuzzy", not_a_number, std::optional<double>{}, Interval{0.25, 0.125}, "no", 1e-7});
  table.row({"same", 0.001, 1.0, Interval{}, "", {}});
  return table;
}

TEST(ResultTable, PrintsItselfAsText) {
  EXPECT_EQ(result_example().text(),
            "filter       RMSE, m  right, %         − IMM's  shown only\n"
            "───────────  ───────  ────────  ──────────────  ──────────\n"
            "IMM            12.35      50.0                  yes\n"
            "───────────  ───────  ────────  ──────────────  ──────────\n"
            "HIMM, fuzzy        –         –  +25.00 ± 12.50  no\n"
            "same            0.00     100.0    none differs\n");
}

TEST(ResultTable, PrintsItselfAsCsv) {
  EXPECT_EQ(result_example().csv(),
            "filter,rmse_m,right,difference,difference_lower,difference_upper,stored_only\n"
            "IMM,12.345,0.5,,,,3\n"
            "\"HIMM, fuzzy\",,,0.25,0.125,0.375,1e-07\n"
            "same,0.001,1,0,,,\n");
  EXPECT_EQ(result_example().csv_header() + result_example().csv_line({"a", 1, 2.5, {}, "b", "c"}),
            "filter,rmse_m,right,difference,difference_lower,difference_upper,stored_only\n"
            "a,1,2.5,,,,c\n");
}

TEST(ResultTable, PrintsItselfAsJson) {
  EXPECT_EQ(result_example().json().dump(),
            R"({"IMM":{"rmse_m":12.345,"right":0.5,"stored_only":3},)"
            R"("HIMM, fuzzy":{"rmse_m":null,"right":null,"difference":{"mean":0.25,"lower":0.125,"upper":0.375},)"
            R"("stored_only":1e-07},)"
            R"("same":{"rmse_m":0.001,"right":1.0,"difference":{"mean":0.0,"lower":null,"upper":null}}})");
}

TEST(ResultTable, HasPartsOfItsRowsAndColumns) {
  ResultTable table{{{.key = "name", .header = "name", .align = Align::left, .parts = 1},
                     {.key = "x", .header = "x"},
                     {.key = "y", .header = "y", .parts = 2},
                     {.key = "z", .header = "z", .parts = 0}}};
  for (const char* name : {"a", "b", "c"}) table.row({name, 1, 2, 3});
  EXPECT_EQ(table.part(1, "letter", 1).text(), "letter  x\n──────  ─\nb       1\nc       1\n");
  EXPECT_EQ(table.part(2, "x", 1, 1).csv(), "x,y\n1,2\n");
}

TEST(ResultTable, ShowsANumberAsItsCellSays) {
  ResultTable table{{{.key = "a", .header = "a", .align = Align::left}, {.key = "b", .header = "b"}}};
  table.row({"x", Cell(1.23456, "1.2 ± 0.1")});
  EXPECT_EQ(table.text(), "a          b\n─  ─────────\nx  1.2 ± 0.1\n");
  EXPECT_EQ(table.csv(), "a,b\nx,1.23456\n");
  EXPECT_EQ(table.json().dump(), R"({"x":{"b":1.23456}})");
}

TEST(ResultTable, KnowsEveryWholeNumber) {
  ResultTable table{{{.key = "a"}, {.key = "b"}, {.key = "c"}}};
  table.row({"x", std::numeric_limits<std::uint64_t>::max(), std::numeric_limits<std::int64_t>::min()});
  EXPECT_EQ(table.csv(), "a,b,c\nx,18446744073709551615,-9223372036854775808\n");
}

TEST(ResultTable, NeedsACellAColumn) {
  ResultTable table = result_example();
  EXPECT_THROW(table.row({"1", 2}), std::invalid_argument);
  EXPECT_THROW(table.csv_line({}), std::invalid_argument);
  EXPECT_THROW(ResultTable{{}}, std::invalid_argument);
}

TEST(NumberText, SuitsTheSizeOfTheNumber) {
  EXPECT_EQ(number_text(12.345, 1), "12.3");
  EXPECT_EQ(number_text(12.3, 2, true), "+12.30");
  EXPECT_EQ(number_text(-3.0, 0), "-3");
  EXPECT_EQ(number_text(999999999.0, 2), "999999999.00");
  EXPECT_EQ(number_text(1.5e150, 2), "1.5e+150");
  EXPECT_EQ(number_text(-1.797e308, 2, true), "-1.8e+308");
  EXPECT_EQ(number_text(0.0012, 2), "0.00");
  EXPECT_EQ(number_text(sigmax::apps::infinity, 2), "∞");
  EXPECT_EQ(number_text(not_a_number, 2), "–");
  EXPECT_EQ(sized_text(0.0012, 2), "0.0012");
  EXPECT_EQ(sized_text(3.44e-7, 2, true), "+3.4e-07");
  EXPECT_EQ(sized_text(0.0, 2), "0.00");
  EXPECT_EQ(sized_text(0.006, 2), "0.01");
  EXPECT_EQ(sized_text(64155865.62, 2), "6.4e+07");
}

}  // namespace table_test
