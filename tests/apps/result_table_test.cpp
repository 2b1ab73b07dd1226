#include "support/result_table.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sigmax::apps {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ResultTable example() {
  ResultTable table{{{.key = "filter", .header = "filter", .align = Align::left},
                     {.key = "rmse_m", .header = "RMSE", .unit = "m"},
                     {.key = "right", .header = "right", .unit = "%", .digits = 1, .scale = 100.0},
                     {.key = "difference", .header = "− IMM's", .scale = 100.0, .sign = true, .interval = true},
                     {.header = "shown only", .align = Align::left},
                     {.key = "stored_only"}}};
  table.row({"IMM", 12.345, 0.5, {}, "yes", 3});
  table.rule();
  table.row({"HIMM, fuzzy", nan, std::optional<double>{}, Interval{0.25, 0.125}, "no", 1e-7});
  table.row({"same", 0.001, 1.0, Interval{}, "", {}});
  return table;
}

TEST(ResultTable, PrintsItselfAsText) {
  EXPECT_EQ(example().text(),
            "filter       RMSE, m  right, %         − IMM's  shown only\n"
            "───────────  ───────  ────────  ──────────────  ──────────\n"
            "IMM            12.35      50.0                  yes\n"
            "───────────  ───────  ────────  ──────────────  ──────────\n"
            "HIMM, fuzzy        –         –  +25.00 ± 12.50  no\n"
            "same            0.00     100.0    none differs\n");
}

TEST(ResultTable, PrintsItselfAsCsv) {
  EXPECT_EQ(example().csv(),
            "filter,rmse_m,right,difference,difference_lower,difference_upper,stored_only\n"
            "IMM,12.345,0.5,,,,3\n"
            "\"HIMM, fuzzy\",,,0.25,0.125,0.375,1e-07\n"
            "same,0.001,1,0,,,\n");
  EXPECT_EQ(example().csv_header() + example().csv_line({"a", 1, 2.5, {}, "b", "c"}),
            "filter,rmse_m,right,difference,difference_lower,difference_upper,stored_only\n"
            "a,1,2.5,,,,c\n");
}

TEST(ResultTable, PrintsItselfAsJson) {
  EXPECT_EQ(example().json().dump(),
            R"({"IMM":{"rmse_m":12.345,"right":0.5,"stored_only":3},)"
            R"("HIMM, fuzzy":{"rmse_m":null,"right":null,"difference":{"mean":0.25,"lower":0.125,"upper":0.375},)"
            R"("stored_only":1e-07},)"
            R"("same":{"rmse_m":0.001,"right":1.0,"difference":{"mean":0.0,"lower":null,"upper":null}}})");
}

TEST(ResultTable, ShowsANumberAsItsCellSays) {
  ResultTable table{{{.key = "a", .header = "a", .align = Align::left}, {.key = "b", .header = "b"}}};
  table.row({"x", Cell(1.23456, "1.2 ± 0.1")});
  EXPECT_EQ(table.text(), "a          b\n─  ─────────\nx  1.2 ± 0.1\n");
  EXPECT_EQ(table.csv(), "a,b\nx,1.23456\n");
  EXPECT_EQ(table.json().dump(), R"({"x":{"b":1.23456}})");
}

TEST(ResultTable, NeedsACellAColumn) {
  ResultTable table = example();
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
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity(), 2), "∞");
  EXPECT_EQ(number_text(nan, 2), "–");
  EXPECT_EQ(sized_text(0.0012, 2), "0.0012");
  EXPECT_EQ(sized_text(3.44e-7, 2, true), "+3.4e-07");
  EXPECT_EQ(sized_text(0.0, 2), "0.00");
  EXPECT_EQ(sized_text(0.006, 2), "0.01");
  EXPECT_EQ(sized_text(1e150, 2), "1e+150");
}

}  // namespace
}  // namespace sigmax::apps
