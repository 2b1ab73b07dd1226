#include "shell/text.hpp"
#include "support/test.hpp"

namespace error_test {

TEST(Message, NamesPlaceFindingExpectationAndRemedy) {
  EXPECT_EQ(message({.where = "flight.csv:12",
                     .what = "column 'x_m'",
                     .found = "'abc'",
                     .expected = "a number",
                     .remedy = "correct the cell"}),
            "flight.csv:12: column 'x_m': found 'abc', expected a number; correct the cell");
}

TEST(Message, LeavesOutWhatIsEmpty) {
  EXPECT_EQ(message({.where = "a.csv", .what = "is empty", .expected = "a header"}),
            "a.csv: is empty: expected a header");
  EXPECT_EQ(message({.found = "a directory", .expected = "a file"}), "found a directory, expected a file");
  EXPECT_EQ(message({.where = "a.csv", .remedy = "close the quote"}), "a.csv; close the quote");
  EXPECT_EQ(message({}), "");
}

TEST(InQuotes, ShowsControlCharactersAndKeepsTheRest) {
  EXPECT_EQ(in_quotes("σ = 5 m"), "'σ = 5 m'");
  EXPECT_EQ(in_quotes(std::string_view{"a\tb\0\x7F", 5}), "'a\\x09b\\x00\\x7F'");
}

TEST(InQuotes, CutsLongTextBetweenCharacters) {
  EXPECT_EQ(in_quotes(std::string(60, 'a')), "'" + std::string(60, 'a') + "'");
  EXPECT_EQ(in_quotes(std::string(61, 'a')), "'" + std::string(60, 'a') + "…'");
  EXPECT_EQ(in_quotes(std::string(59, 'a') + "é and more"), "'" + std::string(59, 'a') + "…'");
}

TEST(Errors, AreOfTwoUnrelatedKinds) {
  static_assert(!std::is_base_of_v<InputError, UsageError> && !std::is_base_of_v<UsageError, InputError>);
  EXPECT_EQ(reason(ENOENT), "No such file or directory");
}

}  // namespace error_test
