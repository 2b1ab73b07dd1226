#include "support/core.hpp"

/// What is normalised by law stays so along any chain of compositions, though rows are one only to within 1e-9.
namespace drift_test {

constexpr double third = 0.3333333333;  // three of them are accepted as one

template <Uncertainty Kind>
Relation<Kind, Kind> loose_step(const Variable<Kind>& x, double scale) {
  return {x,
          x,
          {{third * scale, third * scale, third * scale},
           {third * scale, third * scale, third * scale},
           {third * scale, third * scale, third * scale}}};
}

TEST(Drift, OfADistributionThroughManyStepsIsDividedOut) {
  const RandomVariable x{"x", 3};
  const Relation step = loose_step(x, 1.0);
  Distribution p{x, {0.2, 0.3, 0.5}};
  for (int k = 0; k < 100000; ++k) p = compose(step, p);
  EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1.0, drift_tolerance);
  EXPECT_NEAR(p[1], 1.0 / 3.0, 1e-12);
}

TEST(Drift, OfARelationThatIsSquaredIsDividedOut) {
  const RandomVariable x{"x", 3};
  Relation power = loose_step(x, 1.0);
  for (int k = 0; k < 40; ++k) power = compose(power, power);
  for (std::size_t from = 0; from < 3; ++from) EXPECT_NEAR(power(from, 0), 1.0 / 3.0, 1e-12);

  const FuzzyVariable y{"y", 3};
  Relation possible = loose_step(y, 3.0);  // every row's maximum is 0.9999999999
  for (int k = 0; k < 40; ++k) possible = compose(possible, possible);
  EXPECT_EQ(possible(0, 0), 1.0);
}

TEST(Drift, OfSparseAndBandedRowsIsDividedOutAsOfTheirTable) {
  const RandomVariable x{"x", 3};
  const Relation<Random, Random> banded{x, x, BandedRows{{0, {third, third, third}}, {0, {0.6, 0.4}}, {2, {1.0}}}};
  const Relation<Random, Random> sparse{
      x, x, SparseRows{{{0, third}, {1, third}, {2, third}}, {{0, 0.6}, {1, 0.4}}, {{2, 1.0}}}};
  Relation dense = banded.dense(), by_bands = banded, by_entries = sparse;
  for (int k = 0; k < 30; ++k) {
    dense = compose(dense, dense);
    by_bands = compose(by_bands, by_bands);
    by_entries = compose(by_entries, by_entries);
  }
  EXPECT_EQ(by_bands, dense);
  EXPECT_EQ(by_entries, dense);
  EXPECT_NEAR(dense(0, 2), 1.0, 1e-9);
}

TEST(Drift, LeavesWhatIsNormalisedToRoundingUnchanged) {
  const RandomVariable x{"x", 2};
  const Relation step{x, x, {{0.9, 0.1}, {0.3, 0.7}}};
  const Distribution p = compose(step, Distribution{x, {0.6, 0.4}});
  EXPECT_EQ(p[0], 0.9 * 0.6 + 0.3 * 0.4);
  EXPECT_EQ(p[1], 0.1 * 0.6 + 0.7 * 0.4);
  const RandomVariable y{"y", 3};
  const Distribution q{y, {0.7, 0.2, 0.1}};  // in doubles the sum is 1 − 2⁻⁵³
  EXPECT_EQ(compose(Relation{y, y, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}, q), q);
}

}  // namespace drift_test
