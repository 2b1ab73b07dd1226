#include <sigmax/recognition/classifier.hpp>

#include "laws/generate.hpp"

namespace {

/// Sigma inference (41)–(43) for Random and max inference (44)–(46) for Fuzzy: one classifier.
TYPED_SUITE(ClassifierOf, Random, Fuzzy);

TYPED_PROPERTY(ClassifierOf, EachKindIsThePlainRecursion) {
  constexpr plain::By by = by_kind<TypeParam>;
  const auto pattern = any_variable<TypeParam>("pattern"), feature = any_variable<TypeParam>("feature");
  const auto prior = any_distribution(pattern);
  const auto pattern_given_feature = any_relation(pattern, feature);
  const auto feature_prior = any_distribution(feature);

  // (43), (46): the static relation, built once; by the library and by plain loops.
  const auto inverse = invert(pattern_given_feature, feature_prior);
  Rows feature_given_pattern =
      plain::invert(by, rows_of(pattern_given_feature.table()), numbers_of(feature_prior.values()));
  for (Numbers& row : feature_given_pattern)  // a pattern that no feature leads to says nothing of its features
    if (row.empty()) row.assign(feature.size(), by == plain::By::sum ? 1.0 / static_cast<double>(feature.size()) : 1.0);

  Classifier classifier{prior, inverse.relation};
  Numbers expected = numbers_of(prior.values());
  for (int k = 0; k < 4; ++k) {
    Numbers report = any_unit_numbers(feature.size());
    for (double& value : report) value += 1e-3;  // far from underflow, where plain numbers cannot follow
    Numbers likelihood;                          // (42), (45)
    for (const Numbers& row : feature_given_pattern)
      likelihood.push_back(static_cast<double>(plain::evidence(by, row, report)));
    expected = plain::update(by, expected, likelihood);  // (41), (44)
    classifier.observe(Likelihood{feature, report});
    require_near(classifier.belief().values(), expected);
  }
}

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
  Classifier classifier{prior, feature_given_pattern};
  const Likelihood evidence{feature, report};
  // Between the two only subnormal numbers explain the report, and the sum of their products has few digits.
  if (plain::evidence(by, numbers_of(prior.values()), likelihood) > 1e-200L) {
    classifier.observe(evidence);
    require_near(classifier.belief().values(), plain::update(by, numbers_of(prior.values()), likelihood));
  } else if (!possible) {
    RC_ASSERT_THROWS_AS(classifier.observe(evidence), std::domain_error);
    require_near(classifier.belief().values(), prior.values());
  }
}

TYPED_TEST(ClassifierOf, AReportThatExcludesEveryPatternIsRefusedAndForgotten) {
  const Variable<TypeParam> target{"target", {"T1", "T2"}}, emitter{"emitter", {"e1", "e2", "e3"}};
  const Relation<TypeParam, TypeParam> emitter_given_target{emitter, target, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};
  Classifier classifier{uninformative(target), emitter_given_target};
  classifier.observe(Likelihood{emitter, {0.25, 0.125, 0.5}});
  const Distribution before = classifier.belief();
  EXPECT_REFUSED(std::domain_error, ("'target'"), classifier.observe(Likelihood{emitter, {0.0, 0.0, 1.0}}));
  EXPECT_CLOSE(classifier.belief().values(), before.values(), 1e-15);
  EXPECT_EQ(most_likely(classifier.belief()), "T1");
}

template <class Prior, class FeatureGivenPattern>
concept Classifies = requires(const Prior& prior, const FeatureGivenPattern& relation) {
  Classifier{prior, relation};
};
static_assert(Classifies<Distribution<Fuzzy>, Relation<Fuzzy, Fuzzy>>);
static_assert(!Classifies<Distribution<Fuzzy>, Relation<Fuzzy, Random>>);
static_assert(!Classifies<Distribution<Random>, Induced<Relation<Random, Random>>>);

// Sigma-max inference: a random sensor reports on a fuzzy feature of a fuzzy pattern, (17) and (19).

PROPERTY(SigmaMaxClassifier, IsThePlainRecursion) {
  const auto pattern = any_variable<Fuzzy>("pattern"), feature = any_variable<Fuzzy>("feature");
  const auto reading = any_variable<Random>("reading");
  const auto feature_given_pattern = any_relation(feature, pattern);
  const auto reading_given_feature = any_relation(reading, feature);
  const auto prior = any_distribution(pattern);
  for (std::size_t z = 0; z < reading.size(); ++z) {
    Numbers likelihood;  // p⁺(z|c) = max over f of p(z|f) π(f|c), without β
    for (const Numbers& row : rows_of(feature_given_pattern.table()))
      likelihood.push_back(static_cast<double>(
          plain::evidence(plain::By::max, row, plain::column(rows_of(reading_given_feature.table()), z))));
    if (plain::evidence(plain::By::max, numbers_of(prior.values()), likelihood) <= 1e-200L) continue;
    const Numbers expected = plain::update(plain::By::max, numbers_of(prior.values()), likelihood);
    Classifier classifier{prior, feature_given_pattern};
    classifier.observe(reading_given_feature.likelihood(z));
    require_near(classifier.belief().values(), expected);
    // The same by the induced relation of the reading given the pattern.
    const Induced reading_given_pattern = compose(reading_given_feature, feature_given_pattern);
    require_near(update(prior, reading_given_pattern.likelihood(z)).values(), expected);
  }
}

TEST(SigmaMaxClassifier, IsMaxInferenceOnTheRatioScaledSensorIfItsMaximaAreEqual) {
  const FuzzyVariable target{"target", {"T1", "T2", "T3"}}, emitter{"emitter", {"e1", "e2", "e3"}};
  const RandomVariable reading{"reading", {"e1", "e2", "e3"}};
  const Relation emitter_given_target{emitter, target, {{1.0, 1.0, 0.2}, {0.3, 1.0, 1.0}, {1.0, 0.0, 1.0}}};
  const Relation reading_given_emitter{reading, emitter, {{0.7, 0.2, 0.1}, {0.15, 0.7, 0.15}, {0.1, 0.2, 0.7}}};
  const Relation scaled{FuzzyVariable{"scaled reading", {"e1", "e2", "e3"}},
                        emitter,
                        {{1.0, 2.0 / 7.0, 1.0 / 7.0}, {1.5 / 7.0, 1.0, 1.5 / 7.0}, {1.0 / 7.0, 2.0 / 7.0, 1.0}}};
  Classifier sigma_max{uninformative(target), emitter_given_target};
  Classifier max{uninformative(target), emitter_given_target};
  for (const char* z : {"e2", "e3", "e2", "e1", "e3", "e3"}) {
    sigma_max.observe(reading_given_emitter.likelihood(z));
    max.observe(scaled.likelihood(z));
    EXPECT_CLOSE(sigma_max.belief().values(), max.belief().values(), 1e-12);
  }
}

// What using it should feel like.

using Reports = std::vector<std::vector<double>>;

template <Uncertainty Kind>
std::string recognize(const Relation<Kind, Kind>& emitter_given_target, const Reports& reports) {
  Classifier classifier{uninformative(emitter_given_target.from()), emitter_given_target};
  for (const auto& report : reports) classifier.observe(Likelihood{emitter_given_target.to(), report});
  return most_likely(classifier.belief());
}

TEST(Usage, OneRecognizerServesBothKinds) {
  const RandomVariable target{"target", {"T1", "T2"}}, emitter{"emitter", {"e1", "e2", "e3"}};
  const FuzzyVariable fuzzy_target{"target", {"T1", "T2"}}, fuzzy_emitter{"emitter", {"e1", "e2", "e3"}};
  const Relation random{emitter, target, {{0.5, 0.5, 0.0}, {0.0, 0.5, 0.5}}};
  const Relation fuzzy{fuzzy_emitter, fuzzy_target, {{1.0, 1.0, 0.0}, {0.0, 1.0, 1.0}}};
  const Reports reports{{0.1, 0.8, 0.1}, {0.1, 0.2, 0.7}};
  EXPECT_EQ(recognize(random, reports), "T2");
  EXPECT_EQ(recognize(fuzzy, reports), "T2");
  EXPECT_EQ(recognize(fuzzy, {}), "T1");
}

}  // namespace
