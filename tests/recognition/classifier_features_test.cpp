#include "laws/generate.hpp"
#include "support/sigmax.hpp"

/// Several features a report, any of them missing; batches, forgetting, and relations that change with every step.
namespace classifier_features_test {

using plain::By;

using Readings = std::vector<std::size_t>;

/// Numbers in [1/64, 1]: whatever is multiplied here, plain numbers can follow.
Numbers moderate_numbers(std::size_t n) {
  return any([n](rc::Random& random) {
    Numbers numbers(n);
    for (double& number : numbers) number = static_cast<double>(1 + random.next() % 64) / 64.0;
    return numbers;
  });
}
Numbers moderate_distribution(By by, std::size_t n) {
  Numbers numbers = moderate_numbers(n);
  const Numbers ones(n, 1.0);
  return plain::update(by, numbers, ones);
}
Rows moderate_rows(By by, std::size_t rows, std::size_t columns) {
  Rows result;
  for (std::size_t i = 0; i < rows; ++i) result.push_back(moderate_distribution(by, columns));
  return result;
}

/// A classifier with one to four features, and the numbers that it was made of.
template <class Kind>
struct Case {
  Variable<Kind> pattern{"pattern", laws::any_size()};
  Numbers prior = moderate_distribution(by_kind<Kind>, pattern.size());
  std::vector<Variable<Kind>> features;
  std::vector<Rows> rows;

  Case() {
    const auto n = *rc::gen::inRange<std::size_t>(1, 5);
    for (std::size_t i = 0; i < n; ++i) {
      features.emplace_back("feature " + std::to_string(i), laws::any_size());
      rows.push_back(moderate_rows(by_kind<Kind>, pattern.size(), features[i].size()));
    }
  }

  Classifier<Kind, Kind> classifier() const {
    std::vector<Relation<Kind, Kind>> relations;
    for (std::size_t i = 0; i < rows.size(); ++i) relations.emplace_back(features[i], pattern, rows[i]);
    return {Distribution<Kind>{pattern, prior}, relations};
  }

  Readings any_readings() const {
    Readings result;
    for (const auto& feature : features) {
      const auto reading = *rc::gen::inRange<std::size_t>(0, feature.size() + 1);
      result.push_back(reading == feature.size() ? missing : reading);
    }
    return result;
  }

  /// The product over what was read, by plain loops.
  Numbers likelihood(const Readings& readings) const {
    Numbers result(pattern.size(), 1.0);
    for (std::size_t i = 0; i < readings.size(); ++i)
      for (std::size_t c = 0; c < result.size(); ++c)
        if (readings[i] != missing) result[c] *= rows[i][c][readings[i]];
    return result;
  }
};

TYPED_SUITE(ClassifierWithFeatures, Random, Fuzzy);

TYPED_PROPERTY(ClassifierWithFeatures, MultipliesWhatTheFeaturesSaySkipsWhatIsMissingAndForgetsByPowersOfTheBelief) {
  const Case<TypeParam> with;
  const auto classifier = with.classifier();
  Belief belief{classifier.prior()};
  const double forgetting = *rc::gen::element(1.0, 0.75);
  Numbers expected = with.prior;
  for (int k = 0; k < 4; ++k) {
    const Readings readings = with.any_readings();
    for (double& value : expected) value = std::pow(value, forgetting);
    expected = plain::update(by_kind<TypeParam>, expected, with.likelihood(readings));
    classifier.observe(belief, InOrder{readings}, forgetting);
    require_near(belief.distribution().values(), expected);
  }
}

TYPED_PROPERTY(ClassifierWithFeatures, TakesCrispAndGradedFindingsInOneReport) {
  const Case<TypeParam> with;
  const auto classifier = with.classifier();
  Belief belief{classifier.prior()};
  const Readings readings = with.any_readings();
  Report<TypeParam> report;
  Numbers likelihood(with.pattern.size(), 1.0);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (*rc::gen::inRange(0, 2) == 0) {
      if (readings[i] == missing) continue;
      report.emplace_back(Reading{with.features[i], readings[i]});
      for (std::size_t c = 0; c < likelihood.size(); ++c) likelihood[c] *= with.rows[i][c][readings[i]];
    } else {
      const Numbers graded = moderate_numbers(with.features[i].size());
      report.emplace_back(Likelihood{with.features[i], graded});
      for (std::size_t c = 0; c < likelihood.size(); ++c)
        likelihood[c] *= static_cast<double>(plain::evidence(by_kind<TypeParam>, with.rows[i][c], graded));
    }
  }
  if (*rc::gen::inRange(0, 2) == 0) std::ranges::reverse(report);
  classifier.observe(belief, report);
  require_near(belief.distribution().values(), plain::update(by_kind<TypeParam>, with.prior, likelihood));
  Numbers found(with.pattern.size());
  const auto library = classifier.likelihood(report);
  for (std::size_t c = 0; c < found.size(); ++c) found[c] = library[c];
  require_near(found, likelihood);
}

TYPED_PROPERTY(ClassifierWithFeatures, InABatchIsTheSequenceForgettingIncluded) {
  const Case<TypeParam> with;
  const auto classifier = with.classifier();
  Belief one_by_one{classifier.prior()}, at_once = one_by_one;
  const double factor = any([](rc::Random& random) { return static_cast<double>(1 + random.next() % 8) / 8.0; });
  std::vector<Readings> reports;
  for (int k = 0; k < 7; ++k) reports.push_back(with.any_readings());
  for (const Readings& readings : reports) classifier.observe(one_by_one, InOrder{readings}, factor);
  classifier.observe_all(at_once, std::vector<InOrder>(reports.begin(), reports.end()), factor);
  require_near(at_once.logs(), one_by_one.logs());
}

/// Many reports for one pattern and as many for the other end where they began, however they are split into batches.
TYPED_TEST(ClassifierWithFeatures, AsManyReportsForOnePatternAsForTheOtherEndInATie) {
  const Variable<TypeParam> pattern{"pattern", 2}, feature{"feature", 2};
  const Rows rows = by_kind<TypeParam> == By::sum ? Rows{{0.9, 0.1}, {0.1, 0.9}} : Rows{{1.0, 0.1}, {0.1, 1.0}};
  const Readings zero{0}, one{1};
  for (const std::size_t n : {1U, 17U, 1000U, 50000U}) {
    const Classifier classifier{uninformative(pattern), Relation{feature, pattern, rows}};
    Belief belief{classifier.prior()}, at_once = belief;
    classifier.observe_all(belief, std::vector(n, InOrder{zero}));
    classifier.observe_all(belief, std::vector(n, InOrder{one}));
    EXPECT_NEAR(belief.log(0), belief.log(1), tie_tolerance) << n;
    std::vector mixed(n, InOrder{zero});
    mixed.resize(2 * n, InOrder{one});
    classifier.observe_all(at_once, mixed);
    EXPECT_NEAR(at_once.log(0), at_once.log(1), tie_tolerance) << n;
  }
}

TEST(Classifier, TakesAListOfReadings) {
  const RandomVariable pattern{"pattern", 2}, feature{"feature", 2};
  const Relation relation{feature, pattern, {{0.75, 0.25}, {0.25, 0.75}}};
  const Classifier one{uninformative(pattern), relation};
  Belief belief{one.prior()};
  one.observe(belief, InOrder{1});
  EXPECT_CLOSE(belief.distribution().values(), (Numbers{0.25, 0.75}), 1e-15);
  const Classifier two{uninformative(pattern), std::vector{relation, relation}};
  EXPECT_CLOSE(two.posterior(InOrder{1, missing}).distribution().values(), (Numbers{0.25, 0.75}), 1e-15);
  EXPECT_THROW(two.posterior(InOrder{1}), std::invalid_argument);
}

TEST(Classifier, TakesAListOfFindings) {
  const RandomVariable pattern{"pattern", 2}, feature{"feature", 2};
  const Relation relation{feature, pattern, {{0.75, 0.25}, {0.25, 0.75}}};
  const Likelihood graded{feature, {0.5, 1.0}};
  const Classifier one{uninformative(pattern), relation};
  Belief plain{one.prior()}, listed = plain, both = plain;
  one.observe(plain, graded);
  one.observe(listed, {graded});
  EXPECT_EQ(listed.distribution(), plain.distribution());
  const Classifier two{uninformative(pattern), std::vector{relation, relation}};
  two.observe(both, {graded, Reading{feature, 1}});
  one.observe(plain, Reading{feature, 1});
  EXPECT_CLOSE(both.distribution().values(), plain.distribution().values(), 1e-15);
}

/// A pattern that no feature reaches had an uninformative row, and under maxima was fully possible for ever.
TYPED_TEST(ClassifierWithFeatures, APatternThatNoFeatureReachesIsImpossible) {
  using Kind = TypeParam;
  const Variable<Kind> pattern{"pattern", 3}, feature{"feature", 2};
  const double half = by_kind<Kind> == By::sum ? 0.5 : 1.0;
  const Relation<Kind, Kind> pattern_given_feature{pattern, feature, {{1.0, 0.0, 0.0}, {half, half, 0.0}}};
  const auto inverse = invert(pattern_given_feature, uninformative(feature));
  ASSERT_EQ(inverse.unreachable, std::vector<std::size_t>{2});
  const Classifier<Kind, Kind> classifier{uninformative(pattern), inverse};
  EXPECT_EQ(classifier.prior()[2], 0.0);
  EXPECT_EQ(classifier.posterior(Reading{feature, 1})[2], 0.0);

  const Classifier<Kind, Kind> predicted{uninformative(pattern), inverse.relation};
  Belief belief{predicted.prior()};
  predicted.observe_predicted(belief, Likelihood{feature, {0.5, 1.0}}, pattern_given_feature, uninformative(feature));
  EXPECT_EQ(belief[2], 0.0);
}

template <class Kind>
concept CanBeClassified = requires {
  typename Classifier<Kind, Kind>;
};
static_assert(CanBeClassified<Random> && CanBeClassified<Fuzzy>);
static_assert(!CanBeClassified<Ordinal>, "min cannot be undone: refused by the constraint, not inside");

TYPED_PROPERTY(ClassifierWithFeatures, WithThePredictedFeatureIsThePrintedRecursion) {  // (41)–(43), (44)–(46)
  constexpr By by = by_kind<TypeParam>;
  const Variable<TypeParam> pattern{"pattern", laws::any_size()}, feature{"feature", laws::any_size()};
  const Rows pattern_given_feature = moderate_rows(by, feature.size(), pattern.size());
  const Numbers prior = moderate_distribution(by, pattern.size());
  Classifier classifier{Distribution{pattern, prior},
                        Relation{feature, pattern, moderate_rows(by, pattern.size(), feature.size())}};  // not used
  Belief belief{classifier.prior()};
  Numbers expected = prior;
  for (int k = 0; k < 3; ++k) {
    const Numbers prediction = moderate_distribution(by, feature.size()), report = moderate_numbers(feature.size());
    Numbers likelihood;
    for (const Numbers& row : plain::invert(by, pattern_given_feature, prediction))  // (43), (46)
      likelihood.push_back(static_cast<double>(plain::evidence(by, row, report)));   // (42), (45)
    expected = plain::update(by, expected, likelihood);                              // (41), (44)
    classifier.observe_predicted(belief, Likelihood{feature, report}, Relation{pattern, feature, pattern_given_feature},
                                 Distribution{feature, prediction});
    require_near(belief.distribution().values(), expected);
  }
}

/// With the pattern independent of earlier reports given the feature, all that is known of it comes by the prediction
/// of the feature: its own prior cancels.
TYPED_PROPERTY(ClassifierWithFeatures, ThePriorCancelsIfTheFeatureCarriesAllThatIsKnown) {
  constexpr By by = by_kind<TypeParam>;
  const Variable<TypeParam> pattern{"pattern", laws::any_size()}, feature{"feature", laws::any_size()};
  const Rows pattern_given_feature = moderate_rows(by, feature.size(), pattern.size());
  Numbers of_feature = moderate_distribution(by, feature.size());
  Classifier classifier{Distribution{pattern, plain::compose(by, pattern_given_feature, of_feature)},
                        Relation{feature, pattern, moderate_rows(by, pattern.size(), feature.size())}};
  Belief belief{classifier.prior()};
  for (int k = 0; k < 3; ++k) {
    const Numbers report = moderate_numbers(feature.size());
    classifier.observe_predicted(belief, Likelihood{feature, report}, Relation{pattern, feature, pattern_given_feature},
                                 Distribution{feature, of_feature});
    of_feature = plain::update(by, of_feature, report);
    require_near(belief.distribution().values(), plain::compose(by, pattern_given_feature, of_feature));
  }
}

TYPED_TEST(ClassifierWithFeatures, SurvivesAMillionReports) {
  const Variable<TypeParam> pattern{"pattern", 3}, hair{"hair", 2}, legs{"legs", 3};
  const bool random = by_kind<TypeParam> == By::sum;
  const Rows of_hair = random ? Rows{{0.5, 0.5}, {0.25, 0.75}, {0.75, 0.25}} : Rows{{1, 1}, {0.25, 1}, {1, 0.25}};
  const Rows of_legs = random ? Rows{{0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.1, 0.1, 0.8}}
                              : Rows{{1, 0.5, 0.5}, {0.5, 1, 0.5}, {0.125, 0.125, 1}};
  Classifier classifier{uninformative(pattern),
                        std::vector{Relation{hair, pattern, of_hair}, Relation{legs, pattern, of_legs}}};
  Belief belief{classifier.prior()};
  std::mt19937_64 generator(1);
  std::vector<long double> sums(3, 0.0L);
  for (int k = 0; k < 1000000; ++k) {
    const std::size_t h = generator() % 3, l = generator() % 4;  // the last of each: missing
    classifier.observe(belief, InOrder{h == 2 ? missing : h, l == 3 ? missing : l});
    for (std::size_t c = 0; c < 3; ++c)
      sums[c] += (h == 2 ? 0.0L : std::log(static_cast<long double>(of_hair[c][h]))) +
                 (l == 3 ? 0.0L : std::log(static_cast<long double>(of_legs[c][l])));
  }
  const long double greatest = *std::max_element(sums.begin(), sums.end());
  for (std::size_t c = 0; c < 3; ++c)  // the losers are far below any double
    EXPECT_CLOSE(belief.log(c), static_cast<double>(sums[c] - greatest), 1e-9);
  EXPECT_LT(belief.log(2), -10000.0);
}

TYPED_TEST(ClassifierWithFeatures, IsLeftAsItWasByABatchThatExcludesEveryPattern) {
  const Variable<TypeParam> pattern{"pattern", 2}, feature{"feature", 2};
  Classifier classifier{uninformative(pattern), Relation{feature, pattern, Rows{{1.0, 0.0}, {0.0, 1.0}}}};
  Belief belief{classifier.prior()};
  const Report<TypeParam> first{Reading{feature, 0}}, second{Reading{feature, 1}};
  EXPECT_REFUSED(std::domain_error, ("'pattern'"), classifier.observe_all(belief, std::vector{first, second}, 0.5));
  EXPECT_CLOSE(belief.distribution().values(), uninformative(pattern).values(), 0.0);
  classifier.observe(belief, second, 0.5);
  // Forgetting does not bring back what is excluded.
  EXPECT_THROW(classifier.observe(belief, first, 0.5), std::domain_error);
  EXPECT_EQ(belief[1], 1.0);
}

TYPED_TEST(ClassifierWithFeatures, ForgetsALongBatchWithoutLosingWhatIsExcluded) {
  const Variable<TypeParam> pattern{"pattern", 3}, feature{"feature", 2};
  const Rows rows = by_kind<TypeParam> == By::sum ? Rows{{0.5, 0.5}, {0.25, 0.75}, {0.75, 0.25}}
                                                  : Rows{{1.0, 1.0}, {0.25, 1.0}, {1.0, 0.25}};
  const Numbers prior = by_kind<TypeParam> == By::sum ? Numbers{0.5, 0.0, 0.5} : Numbers{1.0, 0.0, 1.0};
  Classifier classifier{Distribution{pattern, prior}, Relation{feature, pattern, rows}};
  Belief belief{classifier.prior()};
  // 0.25²⁰⁰⁰ is no double
  classifier.observe_all(belief, std::vector(2000, Report<TypeParam>{Reading{feature, 0}}), 0.25);
  EXPECT_EQ(belief.log(1), log_zero);
  // What is left of the reports is a geometric series: Σ 4⁻ᵏ = 4/3.
  const double ratio = std::pow(rows[2][0] / rows[0][0], 4.0 / 3.0);
  EXPECT_CLOSE(belief[2] / belief[0], ratio, 1e-12);
}

TEST(Classifier, RefusesWhatDoesNotFit) {
  const RandomVariable animal{"animal", {"cat", "hen"}}, legs{"legs", {"2", "4"}}, milk{"milk", {"no", "yes"}};
  const RandomVariable other{"plant", {"oak", "fern"}};
  const Relation legs_given_animal{legs, animal, {{0.0, 1.0}, {1.0, 0.0}}};
  const Relation milk_given_animal{milk, animal, {{0.0, 1.0}, {1.0, 0.0}}};
  const Relation milk_given_plant{milk, other, {{1.0, 0.0}, {1.0, 0.0}}};
  const std::vector<Relation<Random, Random>> none;
  EXPECT_INVALID(("'animal'", "one feature"), Classifier(uninformative(animal), none));
  EXPECT_INVALID(("'animal'", "'plant'"),
                 Classifier(uninformative(animal), std::vector{legs_given_animal, milk_given_plant}));
  const Classifier classifier{uninformative(animal), std::vector{legs_given_animal, milk_given_animal}};
  Belief belief{classifier.prior()};
  EXPECT_INVALID(("'animal'", "2", "1 indices"), classifier.observe(belief, InOrder{0}));
  EXPECT_INVALID(("'milk'", "2"), classifier.observe(belief, InOrder{0, 2}));
  EXPECT_INVALID(("'milk'", "2"), (Reading{milk, 2}));
  EXPECT_INVALID(("'animal'", "no feature 'plant'"), classifier.observe(belief, Likelihood{other}));
  EXPECT_INVALID(("'animal'", "no feature 'legs' with 3"),
                 classifier.observe(belief, Reading{RandomVariable{"legs", 3}, 2}));
  for (const double factor : {0.0, -0.5, 1.5, not_a_number})
    EXPECT_INVALID(("(0, 1]", std::to_string(factor)), classifier.observe(belief, InOrder{0, 0}, factor));
  EXPECT_CLOSE(belief.distribution().values(), (Numbers{0.5, 0.5}), 0.0);
}

}  // namespace classifier_features_test
