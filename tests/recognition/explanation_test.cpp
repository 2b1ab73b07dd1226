#include "laws/generate.hpp"
#include "support/sigmax.hpp"

namespace explanation_test {

const FuzzyVariable platform{"platform", {"T1", "T2"}}, emitter{"emitter", {"e1", "e2"}};
const RandomVariable reading{"reading", {"z1", "z2"}};
const Relation emitter_given_platform{emitter, platform, {{1.0, 0.5}, {0.25, 1.0}}};
const Relation reading_given_emitter{reading, emitter, {{0.5, 0.5}, {0.125, 0.875}}};

TEST(Explain, NamesTheWinningValueOfAMaximumAndItsEquation) {
  const Classifier classifier{uninformative(platform),
                              std::vector{FeatureModel{emitter_given_platform, reading_given_emitter}}};
  const auto why = explain(classifier, {Reading{reading, "z2"}}, 0, 1);
  EXPECT_EQ(why.pattern, 0U);
  EXPECT_EQ(why.rival, 1U);
  EXPECT_EQ(why.log_prior_ratio, 0.0);
  ASSERT_EQ(why.contributions.size(), 1U);
  const Contribution& only = why.contributions.front();
  EXPECT_EQ(only.reading, "z2");
  EXPECT_EQ(only.value, 0U);  // 0.5 · 1 beats 0.875 · 0.5
  EXPECT_EQ(only.share, 1.0);
  EXPECT_CLOSE(std::exp(only.log_likelihood), 0.5, 1e-15);
  EXPECT_CLOSE(std::exp(only.rival_log_likelihood), 0.875, 1e-15);
  EXPECT_CLOSE(only.log_ratio, std::log(0.5 / 0.875), 1e-15);
  EXPECT_EQ(only.equation,
            "p(reading = z2|platform = T1) = max over emitter of p(reading = z2|emitter) π(emitter|platform = T1) = "
            "0.5; emitter = e1: 0.5 · 1");
}

TEST(Explain, TellsTheShareOfTheGreatestTermOfASum) {
  const RandomVariable type{"type", 2}, manoeuvre{"manoeuvre", {"weak", "strong"}};
  const Relation manoeuvre_given_type{manoeuvre, type, {{0.75, 0.25}, {0.5, 0.5}}};
  const Classifier classifier{Distribution{type, {0.8, 0.2}}, manoeuvre_given_type};
  const std::vector<Report<Random>> reports{{Likelihood{manoeuvre, {0.25, 0.5}}}};
  const auto why = explain(classifier, std::span(reports), 1, 0);
  EXPECT_CLOSE(why.log_prior_ratio, std::log(0.25), 1e-14);
  const Contribution& only = why.contributions.front();
  EXPECT_EQ(only.reading, "");
  EXPECT_EQ(only.value, 1U);
  EXPECT_CLOSE(only.share, 0.25 / 0.375, 1e-14);
  EXPECT_EQ(only.equation,
            "L(report|type = 1) = sum over manoeuvre of L(report|manoeuvre) p(manoeuvre|type = 1) = 0.375; "
            "manoeuvre = strong: 0.5 · 0.5");
}

TEST(Explain, ReadsACrispFeatureOffItsTable) {
  const FuzzyVariable size{"size", 2};
  const Relation size_given_platform{size, platform, {{1.0, 0.5}, {0.25, 1.0}}};
  const Classifier classifier{uninformative(platform), std::vector{size_given_platform, emitter_given_platform}};
  const auto why = explain(classifier, classifier.report(InOrder{missing, 1}), 0, 1);
  ASSERT_EQ(why.contributions.size(), 1U);  // what is missing says nothing
  EXPECT_EQ(why.contributions.front().feature, 1U);
  EXPECT_EQ(why.contributions.front().equation, "π(emitter = e2|platform = T1) = 0.5");
}

TEST(Explain, TellsTheReportAndTheFeatureOfEachFinding) {
  const Classifier classifier{uninformative(platform), std::vector{emitter_given_platform, emitter_given_platform}};
  const std::vector<Report<Fuzzy>> reports{
      {Reading{emitter, 1}}, {}, {Reading{emitter, 0}, Reading{emitter, 1}, Reading{emitter, 0}}};
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const Contribution& each : explain(classifier, std::span(reports), 0, 1).contributions)
    found.emplace_back(each.report, each.feature);
  EXPECT_EQ(found, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {2, 0}, {2, 1}, {2, 0}}));
}

/// The sensor's crisp reading leads through the first value that attains the maximum.
PROPERTY(Explain, NamesTheWitnessOfTheComposition) {
  const auto pattern = any_variable<Fuzzy>("pattern"), feature = any_variable<Fuzzy>("feature");
  const auto sensed = any_variable<Random>("sensed");
  // Numbers that products keep apart, or exactly equal: 2⁻ᵏ.
  const auto powers = [](const auto& to, const auto& from, auto measure) {
    return laws::any([&](rc::Random& random) {
      Rows rows(from.size(), Numbers(to.size()));
      for (Numbers& row : rows) {
        for (double& value : row) value = std::ldexp(1.0, -static_cast<int>(random.next() % 6));
        measure(row);
      }
      return rows;
    });
  };
  const Relation<Fuzzy, Fuzzy> relation{feature, pattern, powers(feature, pattern, [](Numbers& row) { row[0] = 1.0; })};
  const Relation<Random, Fuzzy> sensor{sensed, feature, powers(sensed, feature, [](Numbers& row) {
                                         double rest = 1.0;
                                         for (double& value : row) rest -= value = value / 64.0;
                                         row[0] += rest;
                                       })};
  const FeatureModel model{relation, sensor};
  for (std::size_t z = 0; z < sensed.size(); ++z)
    for (std::size_t c = 0; c < pattern.size(); ++c) {
      const Contribution found = contribution(model, Finding<Fuzzy>{Reading{sensed, z}}, c, c);
      Numbers ways;
      for (std::size_t x = 0; x < feature.size(); ++x) ways.push_back(relation(c, x) * sensor(x, z));
      const auto greatest = std::max_element(ways.begin(), ways.end());
      RC_ASSERT(found.value == static_cast<std::size_t>(greatest - ways.begin()));
      require_near(found.share, 1.0);
      require_near(std::exp(found.log_likelihood), *greatest);
    }
}

TYPED_SUITE(ExplainKind, Random, Fuzzy);

TYPED_PROPERTY(ExplainKind, AddsUpToTheRatioOfTheBeliefsForgettingIncluded) {
  const auto pattern = any_variable<TypeParam>("pattern");
  const auto first = any_variable<TypeParam>("first"), second = any_variable<TypeParam>("second");
  const Classifier classifier{laws::any_distribution(pattern),
                              std::vector{any_relation(first, pattern), any_relation(second, pattern)}};
  const double forgetting = *rc::gen::element(1.0, 0.75);
  Belief belief{classifier.prior()};
  std::vector<Report<TypeParam>> reports;
  for (int k = 0; k < 4; ++k) {
    Report<TypeParam> report{Likelihood{second, laws::any_unit_numbers(second.size())}};
    if (*rc::gen::inRange(0, 3) != 0) report.push_back(Reading{first, *rc::gen::inRange<std::size_t>(0, first.size())});
    try {
      classifier.observe(belief, report, forgetting);
    } catch (const std::domain_error&) {
      continue;
    }
    reports.push_back(report);
  }
  for (std::size_t a = 0; a < pattern.size(); ++a)
    for (std::size_t b = 0; b < pattern.size(); ++b) {
      const double expected = belief.log(a) == belief.log(b) ? 0.0 : belief.log(a) - belief.log(b);
      require_near(explain(classifier, std::span<const Report<TypeParam>>(reports), a, b, forgetting).log_ratio(),
                   expected);
    }
}

TEST(Explain, OfAnExcludedRivalIsInfinite) {
  const Relation certain{emitter, platform, {{1.0, 0.0}, {0.0, 1.0}}};
  const Classifier classifier{uninformative(platform), certain};
  EXPECT_EQ(explain(classifier, {Reading{emitter, 0}}, 0, 1).log_ratio(), infinity);
  EXPECT_EQ(explain(classifier, {Reading{emitter, 0}}, 1, 0).log_ratio(), log_zero);
  EXPECT_EQ(explain(classifier, {Reading{emitter, 0}}, 1, 1).log_ratio(), 0.0);
  EXPECT_EQ(explain(classifier, {Reading{emitter, 0}}, 1, 0).contributions.front().share, 0.0);
}

TEST(Explain, RefusesWhatTheClassifierRefuses) {
  const Classifier classifier{uninformative(platform), emitter_given_platform};
  EXPECT_INVALID(("1 features"), classifier.report(InOrder{0, 1}));
  EXPECT_INVALID(("no feature 'reading'"), explain(classifier, {Reading{reading, 0}}, 0, 1));
  EXPECT_INVALID(("'emitter'", "2"), classifier.report(InOrder{2}));
  EXPECT_INVALID(("'platform'", "2"), explain(classifier, {Reading{emitter, 0}}, 0, 2));
}

}  // namespace explanation_test
