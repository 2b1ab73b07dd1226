#include "shell/text.hpp"
#include "shell/random.hpp"
#include "support/test.hpp"

namespace text_test {

TEST(ParseNumber, TakesDecimalNumbersWithSignAndBlanks) {
  EXPECT_EQ(parse_number("12.5"), 12.5);
  EXPECT_EQ(parse_number(" \t-0.25\t "), -0.25);
  EXPECT_EQ(parse_number("+3"), 3.0);
  EXPECT_EQ(parse_number("1e-3"), 1e-3);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("5."), 5.0);
  EXPECT_EQ(parse_number("5e-324"), least_subnormal);
  EXPECT_EQ(parse_number("0.1000000000000000055511151231257827"), 0.1);
}

TEST(ParseNumber, TakesNothingElse) {
  for (const std::string_view text :
       {"",     " ",   "abc",  "1x",  "1 2",  "1,5",      "+",     "-",  "+-1", "-+1",   "++1", "+ 1",
        "0x10", "nan", "-nan", "inf", "+inf", "Infinity", "1e999", "1e", "--1", "1_000", "½"})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(Trimmed, TakesBlanksOffBothEnds) {
  EXPECT_EQ(trimmed(" \ta b\t "), "a b");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Shortest, ReadsBackAsTheSameDouble) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(5.0), "5");
  EXPECT_EQ(shortest(-1e-300), "-1e-300");
  EXPECT_EQ(shortest(1.0 / 3.0), "0.3333333333333333");
  RandomStream random{1, 0};
  for (int i = 0; i < 10'000; ++i) {
    const double value = std::ldexp(random.normal(), static_cast<int>(2000.0 * (random.uniform() - 0.5)));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(shortest(value).c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(value));
  }
}

TEST(TomlNumber, HasAPointWhereAnIntegerWouldNotFit) {
  EXPECT_EQ(toml_number(2.0), "2");
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(9007199254740991.0), "9007199254740991");
  EXPECT_EQ(toml_number(9007199254740992.0), "9007199254740992.0");
  EXPECT_EQ(toml_number(-92233720368547758.7), "-92233720368547760.0");
  EXPECT_EQ(toml_number(92233720368547758072.5), "92233720368547758080.0");
  EXPECT_EQ(toml_number(-92233720368547758072.5), "-92233720368547758080.0");
  EXPECT_EQ(toml_number(1e300), "1e+300");
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
  EXPECT_EQ(display_width("\U0001F600"), 2U);  // a pictograph of four bytes
  EXPECT_EQ(display_width("a\xFF\xC3"), 3U);   // bytes that are no UTF-8
}

}  // namespace text_test
