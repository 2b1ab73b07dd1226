#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace discretization_test {

TEST(Discretization, ARangeForOverATemporarysCutsSeesThem) {
  Numbers seen;
  for (const double cut : Discretization{{2.5, 4.0}}.cuts()) seen.push_back(cut);
  EXPECT_EQ(seen, (Numbers{2.5, 4.0}));
  static_assert(std::is_same_v<decltype(Discretization{{1.0}}.cuts()), Numbers>);
}

TEST(Discretization, PutsACutIntoTheBinAboveIt) {
  const Discretization bins{{2.5, 4.0}};
  EXPECT_EQ(bins.size(), 3U);
  EXPECT_EQ(bins.bin(-1e300), 0U);
  EXPECT_EQ(bins.bin(std::nextafter(2.5, 0.0)), 0U);
  EXPECT_EQ(bins.bin(2.5), 1U);
  EXPECT_EQ(bins.bin(std::nextafter(4.0, 0.0)), 1U);
  EXPECT_EQ(bins.bin(4.0), 2U);
  EXPECT_EQ(bins.bin(infinity), 2U);
  EXPECT_EQ(bins.bin(not_a_number), missing);
}

TEST(Discretization, NamesItsBins) {
  const Discretization bins{{2.5, 4.0}};
  EXPECT_EQ(bins.labels(), (std::vector<std::string>{"below 2.5", "2.5 to 4", "4 and above"}));
  EXPECT_EQ(bins.variable<Fuzzy>("width"), (FuzzyVariable{"width", {"below 2.5", "2.5 to 4", "4 and above"}}));
  EXPECT_EQ(bins.lower(0), -infinity);
  EXPECT_EQ(bins.upper(0), 2.5);
  EXPECT_EQ(bins.lower(2), 4.0);
  EXPECT_EQ(bins.upper(2), infinity);
  const double close = std::nextafter(0.1, 1.0);
  EXPECT_EQ((Discretization{{0.1, close}}.variable<Random>("x").size()), 3U);  // labels tell any two cuts apart
}

TEST(Discretization, WithoutCutsIsASingleBin) {
  const Discretization all{{}};
  EXPECT_EQ(all.bin(0.0), 0U);
  EXPECT_EQ(all.labels(), std::vector<std::string>{"any"});
  EXPECT_EQ(all.upper(0), infinity);
}

TEST(Discretization, RefusesCutsThatDoNotAscend) {
  EXPECT_INVALID(("ascend", "1 follows 1"), Discretization({1.0, 1.0}));
  EXPECT_INVALID(("1.5 follows 2"), Discretization({2.0, 1.5}));
  EXPECT_INVALID(("finite", "nan"), Discretization({not_a_number}));
  EXPECT_INVALID(("finite", "inf"), Discretization({1.0, infinity}));
  const Discretization bins{{1.0}};
  EXPECT_INVALID(("2 bins", "2"), bins.lower(2));
  EXPECT_THROW(bins.upper(2), std::invalid_argument);
}

TEST(EqualWidth, CutsTheRangeOfTheTrainingData) {
  const Numbers values{3.0, not_a_number, -1.0, 0.0, 7.0};
  const Discretization bins = equal_width(values, 4);
  EXPECT_CLOSE(bins.cuts(), (Numbers{1.0, 3.0, 5.0}), 1e-15);
  EXPECT_EQ(bins.bin(100.0), 3U);  // what lies outside belongs to the outer bins
  EXPECT_EQ(bins.bin(-100.0), 0U);
  EXPECT_EQ(equal_width(values, 1).size(), 1U);
  const double huge = std::numeric_limits<double>::max();
  EXPECT_CLOSE(equal_width(Numbers{-huge, huge}, 2).cuts(), (Numbers{0.0}), 0.0);
}

/// Restated: the bins of a list of ranks, by what stands before and after.
PROPERTY(EqualFrequency, CutsAsThePlainRestatement) {
  Numbers values;
  for (std::size_t i = 0, n = *rc::gen::inRange<std::size_t>(2, 60); i < n; ++i)
    values.push_back(*rc::gen::inRange(0, *rc::gen::element(2, 5, 30)));
  values.push_back(-1.0);
  const auto bins = *rc::gen::inRange<std::size_t>(1, 12);
  Numbers ascending = values;
  std::sort(ascending.begin(), ascending.end());
  std::set<double> expected;
  const std::set<double> different(ascending.begin(), ascending.end());
  for (const double value : different) {
    if (different.size() <= bins) {  // each has one
      if (value > ascending.front()) expected.insert(value);
      continue;
    }
    std::size_t cuts_here = value == ascending.front() ? 1 : 0;  // below the least the first bin begins
    for (std::size_t j = 1; j < bins; ++j) cuts_here += ascending[j * ascending.size() / bins] == value;
    if (cuts_here > 0 && value > ascending.front()) expected.insert(value);
    if (cuts_here < 2) continue;
    for (const double next : ascending)
      if (next > value) {
        expected.insert(next);
        break;
      }
  }
  RC_ASSERT(equal_frequency(values, bins).cuts() == Numbers(expected.begin(), expected.end()));
}

TEST(Fitting, RefusesWhatCannotBeCut) {
  for (const auto& fit : {&equal_width, &equal_frequency}) {
    EXPECT_INVALID(("every value is 3.5"), fit(Numbers{3.5, 3.5, not_a_number}, 2));
    EXPECT_INVALID(("no value"), fit(Numbers{not_a_number}, 2));
    EXPECT_INVALID(("infinite"), fit(Numbers{1.0, infinity}, 2));
    EXPECT_INVALID(("one bin"), fit(Numbers{1.0, 2.0}, 0));
    EXPECT_EQ(fit(Numbers{3.5, 3.5}, 1).size(), 1U);
  }
}

}  // namespace discretization_test
