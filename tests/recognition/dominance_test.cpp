#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace dominance_test {

const FuzzyVariable pattern{"pattern", 3}, feature{"feature", 2};

TEST(DominatedPatterns, MayBeSavedByTheirPrior) {
  const Relation nested{feature, pattern, {{1.0, 0.0}, {1.0, 0.5}, {1.0, 1.0}}};
  EXPECT_EQ(dominated_patterns(nested).size(), 2U);
  const auto left = dominated_patterns(nested, Distribution{pattern, {1.0, 0.25, 0.5}});
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].pattern, 1U);
  EXPECT_EQ(left[0].dominator, 2U);
}

TEST(DominatedPatterns, AreTheLaterOfEqualOnes) {
  const Relation twins{feature, pattern, {{1.0, 0.5}, {0.5, 1.0}, {1.0, 0.5}}};
  const auto dominated = dominated_patterns(twins);
  ASSERT_EQ(dominated.size(), 1U);
  EXPECT_EQ(dominated[0].pattern, 2U);
  EXPECT_EQ(dominated[0].dominator, 0U);
  EXPECT_TRUE(dominated[0].equal);
}

TEST(DominatedPatterns, MustBeSoInEveryFeature) {
  const Relation nested{feature, pattern, {{1.0, 0.0}, {1.0, 0.5}, {1.0, 1.0}}};
  const Relation reversed{feature, pattern, {{1.0, 1.0}, {1.0, 0.5}, {1.0, 0.0}}};
  EXPECT_TRUE(dominated_patterns(Classifier{uninformative(pattern), std::vector{nested, reversed}}).empty());
  EXPECT_EQ(dominated_patterns(Classifier{uninformative(pattern), std::vector{nested, nested}}).size(), 2U);
}

/// A relation whose numbers are 0, ½ or 1, so that dominance is frequent.
Relation<Fuzzy, Fuzzy> any_coarse_relation(const FuzzyVariable& to, const FuzzyVariable& from) {
  return {to, from, laws::any([&](rc::Random& random) {
            Rows rows(from.size(), plain::Numbers(to.size()));
            for (auto& row : rows) {
              for (double& value : row) value = static_cast<double>(random.next() % 3) / 2.0;
              row[random.next() % row.size()] = 1.0;
            }
            return rows;
          })};
}

/// And the others can win: brute force over the reports that allow one feature value, or any set of them.
PROPERTY(DominatedPatterns, AreAllThatDominatesByBruteForce) {
  const auto patterns = laws::any_variable<Fuzzy>("pattern"), features = laws::any_variable<Fuzzy>("feature");
  const auto relation = any_coarse_relation(features, patterns);
  std::vector<bool> found(patterns.size(), false), expected(patterns.size(), false);
  for (const Dominance& each : dominated_patterns(relation)) {
    RC_ASSERT(!found[each.pattern]);
    found[each.pattern] = true;
  }
  const Rows rows = laws::rows_of(relation.table());
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t b = 0; b < rows.size(); ++b) {
      bool below = true, equal = true;
      for (std::size_t f = 0; f < rows[a].size(); ++f) {
        below = below && rows[a][f] <= rows[b][f];
        equal = equal && rows[a][f] == rows[b][f];
      }
      if (a != b && below && (!equal || b < a)) expected[a] = true;
    }
  RC_ASSERT(found == expected);
}

}  // namespace dominance_test
