#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace classifier_test {

/// Sigma inference (41)–(43) for Random and max inference (44)–(46) for Fuzzy: one classifier.
TYPED_SUITE(ClassifierOf, Random, Fuzzy);

TYPED_PROPERTY(ClassifierOf, OneReportThatAllowsFewFeaturesIsThePlainRecursionToo) {
  constexpr plain::By by = by_kind<TypeParam>;
  const auto pattern = any_variable<TypeParam>("pattern"), feature = any_variable<TypeParam>("feature");
  const auto prior = any_distribution(pattern);
  const auto feature_given_pattern = any_relation(feature, pattern);
  const Numbers report = any_unit_numbers(feature.size());
  const Rows rows = rows_of(feature_given_pattern.table());
  Numbers likelihood;
  bool possible = false;
  for (std::size_t c = 0; c < pattern.size(); ++c) {
    likelihood.push_back(static_cast<double>(plain::evidence(by, rows[c], report)));
    for (std::size_t f = 0; f < feature.size(); ++f)
      possible = possible || (prior[c] > 0.0 && rows[c][f] > 0.0 && report[f] > 0.0);
  }
  const Classifier classifier{prior, feature_given_pattern};
  Belief belief{prior};
  const Likelihood evidence{feature, report};
  // Between the two only subnormal numbers explain the report, and the sum of their products has few digits.
  if (plain::evidence(by, numbers_of(prior.values()), likelihood) > 1e-200L) {
    classifier.observe(belief, evidence);
    require_near(belief.distribution().values(), plain::update(by, numbers_of(prior.values()), likelihood));
  } else if (!possible) {
    RC_ASSERT_THROWS_AS(classifier.observe(belief, evidence), std::domain_error);
    require_near(belief.distribution().values(), prior.values());
  }
}

TYPED_TEST(ClassifierOf, AReportThatExcludesEveryPatternIsRefusedAndForgotten) {
  const Variable<TypeParam> target{"target", {"T1", "T2"}}, emitter{"emitter", {"e1", "e2", "e3"}};
  const Relation<TypeParam, TypeParam> emitter_given_target{emitter, target, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};
  const Classifier classifier{uninformative(target), emitter_given_target};
  Belief belief{classifier.prior()};
  classifier.observe(belief, Likelihood{emitter, {0.25, 0.125, 0.5}});
  const Distribution before = belief.distribution();
  EXPECT_REFUSED(std::domain_error, ("'target'"), classifier.observe(belief, Likelihood{emitter, {0.0, 0.0, 1.0}}));
  EXPECT_CLOSE(belief.distribution().values(), before.values(), 1e-15);
  EXPECT_EQ(most_likely(belief), "T1");
}

template <class Prior, class FeatureGivenPattern>
concept Classifies = requires(const Prior& prior, const FeatureGivenPattern& relation) {
  Classifier{prior, relation};
};
static_assert(Classifies<Distribution<Fuzzy>, Relation<Fuzzy, Fuzzy>>);
static_assert(!Classifies<Distribution<Fuzzy>, Relation<Fuzzy, Random>>);
static_assert(!Classifies<Distribution<Random>, Induced<Relation<Random, Random>>>);

}  // namespace classifier_test
