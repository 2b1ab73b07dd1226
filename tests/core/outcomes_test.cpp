#include "support/core.hpp"

namespace outcomes_test {

using Labels = std::vector<std::string>;

TEST(Outcomes, LabelsAndIndicesAreEachOthersInverse) {
  const Outcomes age{"age", Labels{"young", "middle", "old"}};
  EXPECT_EQ(age.name(), "age");
  ASSERT_EQ(age.size(), 3U);
  for (std::size_t i = 0; i < age.size(); ++i) EXPECT_EQ(age.index_of(age.label(i)), i);
  EXPECT_EQ(age.label(2), "old");
}

TEST(Outcomes, UnlabelledOutcomesAreTheirNumbers) {
  const Outcomes cell{"cell", 100000};
  EXPECT_EQ(cell.size(), 100000U);
  EXPECT_EQ(cell.label(0), "0");
  EXPECT_EQ(cell.label(99999), "99999");
  EXPECT_EQ(cell.index_of("0"), 0U);
  EXPECT_EQ(cell.index_of("99999"), 99999U);
}

TEST(Outcomes, AnUnlabelledOutcomeHasOneSpelling) {
  const Outcomes cell{"cell", 100};
  for (const char* wrong : {"100", "-1", "+1", "07", " 7", "7 ", "7.0", "0x7", "", "99999999999999999999999"})
    EXPECT_INVALID(("'cell'", wrong, "0, 1, 2", "7, … (100 in all)"), cell.index_of(wrong)) << wrong;
}

TEST(Outcomes, AWrongLabelIsRefusedWithTheOutcomesThatThereAre) {
  const Outcomes mood{"mood", Labels{"calm", "wild"}};
  EXPECT_INVALID(("'mood'", "'Calm'", "calm, wild"), mood.index_of("Calm"));
}

TEST(Outcomes, AWrongIndexIsRefused) {
  const Outcomes mood{"mood", Labels{"calm", "wild"}};
  const Outcomes cell{"cell", 3};
  EXPECT_INVALID(("'mood'", "2 outcomes", "2"), mood.label(2));
  EXPECT_INVALID(("'cell'", "3 outcomes", "3"), cell.label(3));
}

TEST(Outcomes, NoOutcomeAtAllIsRefused) {
  EXPECT_INVALID(("'nothing'", "at least one"), Outcomes("nothing", Labels{}));
  EXPECT_INVALID(("'nothing'", "at least one"), Outcomes("nothing", 0));
}

TEST(Outcomes, RepeatedAndEmptyLabelsAreRefused) {
  EXPECT_INVALID(("'mood'", "'calm'", "twice"), Outcomes("mood", Labels{"calm", "wild", "calm"}));
  EXPECT_INVALID(("'mood'", "empty label"), Outcomes("mood", Labels{"calm", ""}));
}

TEST(Outcomes, EqualityIsOfNameAndOutcomes) {
  const Outcomes mood{"mood", Labels{"calm", "wild"}};
  const Outcomes copy = mood;
  EXPECT_EQ(mood, copy);
  EXPECT_EQ(mood, Outcomes("mood", Labels{"calm", "wild"}));
  EXPECT_NE(mood, Outcomes("temper", Labels{"calm", "wild"}));
  EXPECT_NE(mood, Outcomes("mood", Labels{"wild", "calm"}));
  EXPECT_NE(mood, Outcomes("mood", Labels{"calm", "wild", "odd"}));
  EXPECT_EQ(Outcomes("cell", 5), Outcomes("cell", 5));
  EXPECT_NE(Outcomes("cell", 5), Outcomes("cell", 6));
}

TEST(Outcomes, ACopyOutlivesItsOriginal) {
  auto original = std::make_unique<Outcomes>("mood", Labels{"calm", "wild"});
  const Outcomes copy = *original;
  original.reset();
  EXPECT_EQ(copy.label(1), "wild");
}

}  // namespace outcomes_test
