#include "support/text.hpp"
#include "support/test.hpp"

namespace text_test {

TEST(Wrapped, BreaksAtBlanksAndKeepsIndents) {
  EXPECT_EQ(wrapped("one two three\n\n  four five", 9), "one two\nthree\n\n  four\n  five\n");
  EXPECT_EQ(wrapped("one two three\n", any_width), "one two three\n");
  EXPECT_EQ(wrapped("incomprehensible words", 5), "incomprehensible\nwords\n");
  EXPECT_EQ(wrapped("differences ± 95 % − sigma's", 12), "differences ± 95\n% − sigma's\n");
  EXPECT_EQ(wrapped("", 5), "\n");
  EXPECT_EQ(wrapped("a\x1B[2Jb\nc", any_width), "a\\x1B[2Jb\nc\n");
}

TEST(Alike, IsWhatDiffersInCaseBlanksOrTheWritingOfANumber) {
  EXPECT_EQ(alike({"red", "green", "Red"}), "'red' and 'Red'");
  EXPECT_EQ(alike({"1", "2", "1.0"}), "'1' and '1.0'");
  EXPECT_EQ(alike({"0", "-0"}), "'0' and '-0'");
  EXPECT_EQ(alike({"oak tree", "oak  tree"}), "'oak tree' and 'oak  tree'");
  EXPECT_EQ(alike({"oak", "oak\u00a0"}), "'oak' and 'oak\u00a0'");
  EXPECT_EQ(alike({"red", "reed", "1", "10", "", "oaktree", "oak tree", "é", "à"}), "");
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
