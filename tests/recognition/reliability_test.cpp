#include <boost/math/distributions/normal.hpp>

#include "support/sigmax.hpp"

namespace reliability_test {

TEST(Reliability, CountsByHand) {
  Reliability reliability{4};
  reliability.add(0.25, false);  // an edge belongs to the bin above it
  reliability.add(0.30, true);
  reliability.add(0.49, false);
  reliability.add(1.0, true);  // the last bin has both its edges
  const auto bins = reliability.bins();
  ASSERT_EQ(bins.size(), 2U);  // the empty ones are left out
  EXPECT_EQ(bins[0].from, 0.25);
  EXPECT_EQ(bins[0].to, 0.5);
  EXPECT_EQ(bins[0].count, 3.0);
  EXPECT_CLOSE(bins[0].mean_degree, 1.04 / 3.0, 1e-15);
  EXPECT_CLOSE(bins[0].share, 1.0 / 3.0, 1e-15);
  EXPECT_EQ(bins[1].from, 0.75);
  EXPECT_EQ(bins[1].share, 1.0);
  EXPECT_CLOSE(reliability.calibration_error(), 0.04 / 4.0, 1e-15);
}

/// The ends of Wilson's interval are the shares p from which the observed one is just 1.96 standard deviations of p
/// away.
TEST(Reliability, HasWilsonsInterval) {
  const double z = boost::math::quantile(boost::math::normal{}, 0.975);
  for (const int n : {1, 7, 100})
    for (const int k : {0, n / 3, n}) {
      Reliability reliability{1};
      for (int i = 0; i < n; ++i) reliability.add(0.5, i < k);
      const auto bin = reliability.bins().front();
      for (const double p : {bin.lower, bin.upper})
        if (p > 0.0 && p < 1.0) {
          EXPECT_CLOSE(std::abs(bin.share - p) / std::sqrt(p * (1.0 - p) / n), z, 1e-9) << n << ' ' << k;
        }
      EXPECT_LE(bin.lower, bin.share + 1e-15);
      EXPECT_GE(bin.upper, bin.share - 1e-15);
      EXPECT_GT(bin.upper - bin.lower, 0.0);
    }
}

TEST(Reliability, CountsWhatWasRepeatedOnce) {
  Reliability once, often;
  for (int i = 0; i < 30; ++i) {
    once.add(0.05 * (i % 20), i % 3 == 0);
    for (int repeated = 0; repeated < 5; ++repeated) often.add(0.05 * (i % 20), i % 3 == 0);
  }
  const auto expected = once.bins(), found = often.bins(5.0);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].count, expected[i].count);
    EXPECT_CLOSE(found[i].mean_degree, expected[i].mean_degree, 1e-14);
    EXPECT_CLOSE(found[i].lower, expected[i].lower, 1e-14);
    EXPECT_CLOSE(found[i].upper, expected[i].upper, 1e-14);
  }
}

TEST(Reliability, TakesEachPatternOfABelief) {
  const RandomVariable animal{"animal", {"cat", "hen", "cow"}};
  Reliability beliefs{10}, statements{10}, parts{10};
  beliefs.add(1, Belief{Distribution{animal, {0.5, 0.375, 0.125}}});
  parts.add(1, Belief{Distribution{animal, {0.5, 0.375, 0.125}}});
  parts.add(Reliability{10});
  statements.add(0.5, false);
  statements.add(0.375, true);
  statements.add(0.125, false);
  for (const Reliability* one : {&beliefs, &parts}) {
    ASSERT_EQ(one->bins().size(), statements.bins().size());
    for (std::size_t i = 0; i < one->bins().size(); ++i) {
      EXPECT_CLOSE(one->bins()[i].mean_degree, statements.bins()[i].mean_degree, 1e-15);
      EXPECT_EQ(one->bins()[i].share, statements.bins()[i].share);
    }
  }
}

TEST(Reliability, RefusesWhatIsNoDegree) {
  using Bad = std::invalid_argument;
  Reliability reliability;
  EXPECT_REFUSED(Bad, ("[0, 1]", "1.5"), reliability.add(1.5, true));
  EXPECT_REFUSED(Bad, ("[0, 1]"), reliability.add(not_a_number, true));
  EXPECT_REFUSED(Bad, ("bin"), Reliability{0});
  EXPECT_REFUSED(Bad, ("10", "3"), reliability.add(Reliability{3}));
  EXPECT_REFUSED(Bad, ("0.5"), reliability.bins(0.5));
  EXPECT_REFUSED(std::domain_error, ("nothing"), reliability.calibration_error());
  const RandomVariable coin{"coin", {"heads", "tails"}};
  EXPECT_THROW(reliability.add(2, Belief{Distribution{coin, {0.5, 0.5}}}), std::exception);
}

}  // namespace reliability_test
