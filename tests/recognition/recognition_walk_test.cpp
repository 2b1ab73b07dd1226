#include "support/sigmax.hpp"

/// Every line of code in docs/recognition.md and docs/learning.md, in its order, and the values that it claims.
namespace recognition_walk_test {

const RandomVariable type{"type", {"airliner", "bomber", "fighter"}};
const RandomVariable manoeuvre{"manoeuvre", {"weak", "medium", "strong"}};
const Relation type_given_manoeuvre{
    type, manoeuvre, {{1.0 / 3, 1.0 / 3, 1.0 / 3}, {0.0, 0.5, 0.5}, {0.0, 0.0, 1.0}}};  // a row per manoeuvre

const FuzzyVariable fuzzy_type = as_fuzzy(type);
const FuzzyVariable fuzzy_manoeuvre = as_fuzzy(manoeuvre);
const Relation fuzzy_type_given_manoeuvre{
    fuzzy_type, fuzzy_manoeuvre, {{1.0, 1.0, 1.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}}};

const FuzzyVariable platform{"platform", {"T1", "T2"}};
const FuzzyVariable emitter{"emitter", {"e1", "e2", "e3"}};
const RandomVariable reading{"reading", {"e1", "e2", "e3"}};
const Relation emitter_given_platform{emitter, platform, {{1.0, 0.5, 0.0}, {0.0, 1.0, 1.0}}};
const Relation reading_given_emitter{reading, emitter, {{0.8, 0.1, 0.1}, {0.1, 0.8, 0.1}, {0.1, 0.1, 0.8}}};

TEST(RecognitionWalk, Sigma) {
  const auto inverse = invert(type_given_manoeuvre, uninformative(manoeuvre));
  EXPECT_TRUE(inverse.unreachable.empty());
  EXPECT_CLOSE(inverse.relation.row(0), (Numbers{1, 0, 0}), 1e-15);
  EXPECT_CLOSE(inverse.relation.row(1), (Numbers{0.4, 0.6, 0}), 1e-15);
  EXPECT_CLOSE(inverse.relation.row(2), (Numbers{2.0 / 11, 3.0 / 11, 6.0 / 11}), 1e-15);

  const Classifier classifier{uninformative(type), inverse};
  Belief belief{classifier.prior()};
  classifier.observe(belief, Likelihood{manoeuvre, {0.7, 0.2, 0.1}});
  const Distribution p = belief.distribution();
  // (42): 0.7; 0.28 + 0.12; (1.4 + 0.6 + 0.6)/11
  const double sum = 0.7 + 0.4 + 2.6 / 11;
  EXPECT_CLOSE(p.values(), (Numbers{0.7 / sum, 0.4 / sum, 2.6 / 11 / sum}), 1e-14);
  EXPECT_CLOSE(p["airliner"], 0.524, 5e-4);
  EXPECT_CLOSE(p["bomber"], 0.299, 5e-4);
  EXPECT_CLOSE(p["fighter"], 0.177, 5e-4);
}

TEST(RecognitionWalk, Max) {
  const auto inverse = invert(fuzzy_type_given_manoeuvre, uninformative(fuzzy_manoeuvre));
  EXPECT_CLOSE(inverse.relation.table().values(), (Numbers{1, 0, 0, 1, 1, 0, 1, 1, 1}), 0.0);

  const Classifier classifier{uninformative(fuzzy_type), inverse};
  Belief belief{classifier.prior()};
  classifier.observe(belief, Likelihood{fuzzy_manoeuvre, {0.2, 1.0, 0.5}});
  static_assert(std::same_as<decltype(belief), Belief<Fuzzy>>);
  EXPECT_CLOSE(belief.distribution().values(), (Numbers{0.2, 1.0, 1.0}), 1e-15);

  const auto never = dominated_patterns(classifier);
  ASSERT_EQ(never.size(), 2U);
  EXPECT_EQ(type.label(never[0].pattern), "airliner");
  EXPECT_EQ(type.label(never[0].dominator), "fighter");
  EXPECT_EQ(type.label(never[1].pattern), "bomber");
  EXPECT_EQ(type.label(never[1].dominator), "fighter");
}

TEST(RecognitionWalk, SigmaMax) {
  const Classifier by_report{uninformative(platform), emitter_given_platform};
  Belief belief{by_report.prior()};
  by_report.observe(belief, reading_given_emitter.likelihood("e2"));
  EXPECT_CLOSE(belief.distribution().values(), (Numbers{0.5, 1.0}), 1e-15);

  const Classifier classifier{uninformative(platform),
                              std::vector{FeatureModel{emitter_given_platform, reading_given_emitter}}};
  const Belief by_index = classifier.posterior({Reading{reading, "e2"}});
  EXPECT_CLOSE(by_index.distribution().values(), belief.distribution().values(), 1e-15);

  const Induced induced = compose(reading_given_emitter, emitter_given_platform);  // (17)
  const Distribution the_same = update(uninformative(platform), induced.likelihood("e2"));
  EXPECT_CLOSE(the_same.values(), belief.distribution().values(), 1e-15);

  const Relation scaled = to_possibility(reading_given_emitter, RatioScale{});
  const Classifier max{uninformative(platform), std::vector{FeatureModel{emitter_given_platform, scaled}}};
  EXPECT_CLOSE(max.posterior({Reading{reading, "e2"}}).distribution().values(), belief.distribution().values(), 1e-15);
}

TEST(RecognitionWalk, TheOtherMixture) {
  const FuzzyVariable look{"look", {"small", "large"}};
  const auto inverse = invert(type_given_manoeuvre, uninformative(manoeuvre));
  const Relation manoeuvre_given_type = inverse.relation;
  const Relation look_given_manoeuvre{look, manoeuvre, {{0.2, 1.0}, {1.0, 0.8}, {1.0, 0.1}}};

  const Classifier by_look{uninformative(type), std::vector{FeatureModel{manoeuvre_given_type, look_given_manoeuvre}}};
  const Belief looked = by_look.posterior({Reading{look, "small"}});  // π⁺ = 0.2, 0.68, (0.4 + 3 + 6)/11
  const double sum = 0.2 + 0.68 + 9.4 / 11;
  EXPECT_CLOSE(looked.distribution().values(), (Numbers{0.2 / sum, 0.68 / sum, 9.4 / 11 / sum}), 1e-14);

  const Classifier direct{uninformative(fuzzy_type), with_fuzzy_condition(manoeuvre_given_type)};
  EXPECT_CLOSE(direct.posterior({Reading{manoeuvre, "medium"}}).distribution().values(),
               (Numbers{0.0, 1.0, (3.0 / 11) / 0.6}), 1e-15);

  const Distribution prior = to_possibility(uninformative(type), RatioScale{});
  EXPECT_CLOSE(prior.values(), (Numbers{1, 1, 1}), 0.0);
}

TEST(RecognitionWalk, APredictionForEveryStep) {
  const Distribution prediction{manoeuvre, {0.6, 0.3, 0.1}};
  const Classifier classifier{compose(type_given_manoeuvre, prediction), invert(type_given_manoeuvre, prediction)};
  Belief belief{classifier.prior()};
  const Likelihood report{manoeuvre, {0.1, 0.3, 0.6}};
  classifier.observe_predicted(belief, report, type_given_manoeuvre, prediction);
  EXPECT_CLOSE(belief.distribution().values(), compose(type_given_manoeuvre, update(prediction, report)).values(),
               1e-14);
}

const FuzzyVariable animal{"animal", {"cat", "hen", "frog"}};
const FuzzyVariable legs{"legs", {"0", "2", "4"}};
const FuzzyVariable skin{"skin", {"fur", "feathers", "bare"}};
const Relation legs_given_animal{legs, animal, {{0.0, 0.1, 1.0}, {0.0, 1.0, 0.0}, {0.2, 0.0, 1.0}}};
const Relation skin_given_animal{skin, animal, {{1.0, 0.0, 0.2}, {0.1, 1.0, 0.2}, {0.0, 0.0, 1.0}}};

TEST(RecognitionWalk, SeveralFeatures) {
  const Classifier classifier{uninformative(animal), std::vector{legs_given_animal, skin_given_animal}};
  const Report<Fuzzy> four_legs{Reading{legs, "4"}};
  Belief belief = classifier.posterior(four_legs);
  EXPECT_CLOSE(belief.distribution().values(), (Numbers{1, 0, 1}), 0.0);
  const Report<Fuzzy> graded{Likelihood{skin, {0.3, 0.1, 1.0}}};
  classifier.observe(belief, graded);
  EXPECT_CLOSE(belief.distribution().values(), (Numbers{0.3, 0, 1}), 1e-15);

  const Decision decision = decide(belief);
  EXPECT_EQ(animal.label(decision.pattern), "frog");
  EXPECT_CLOSE(decision.margin, 0.7, 1e-15);
  const auto sure_enough = decide_or_reject(belief, 0.9);
  EXPECT_FALSE(sure_enough);
  const auto order = best_patterns(belief, 2);
  EXPECT_EQ(order, (std::vector<std::size_t>{2, 0}));

  const std::vector reports{four_legs, graded};
  const auto why = explain(classifier, std::span(reports), order[0], order[1]);
  EXPECT_CLOSE(why.log_ratio(), std::log(1.0 / 0.3), 1e-14);
  ASSERT_EQ(why.contributions.size(), 2U);
  EXPECT_EQ(why.contributions[0].equation, "π(legs = 4|animal = frog) = 1");
  EXPECT_EQ(why.contributions[1].equation,
            "L(report|animal = frog) = max over skin of L(report|skin) π(skin|animal = frog) = 1; skin = bare: 1 · 1");

  Belief fading{classifier.prior()};
  classifier.observe_all(fading, reports, 0.9);
  EXPECT_CLOSE(fading.distribution().values(), (Numbers{0.3, 0, 1}), 1e-15);
}

TEST(RecognitionWalk, ATable) {
  testing::internal::CaptureStdout();
  const std::vector<TableColumn> columns{{"height", {12, 31, 9, 28}}, {"leaf", {"broad", "needle", "broad", "needle"}}};
  const auto trees = TableClassifier::fit(columns, {"tree", {"oak", "pine", "oak", "pine"}});
  std::cout << trees.predict({30.0, "needle"}).label << '\n';
  for (const auto& why : trees.explain({30.0, "needle"}).contributions) std::cout << why.equation << '\n';
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "pine\np(height = 28 to 31|tree = pine) = 0.3333\np(leaf = needle|tree = pine) = 0.75\n");

  const auto by_max = trees.by(TableInference::max_by_dubois_prade);
  const TablePrediction unsure = by_max.predict({not_a_number, "needle"});
  EXPECT_EQ(unsure.label, "pine");
  EXPECT_CLOSE(unsure.margin, 0.75, 1e-14);
}

TEST(RecognitionWalk, Learning) {
  const RandomVariable kind{"kind", {"cat", "hen"}};
  const RandomVariable limbs{"legs", {"2", "4"}}, milk{"milk", {"no", "yes"}};
  Counts counts{kind, {limbs, milk}};
  counts.observe(0, std::vector<std::size_t>{1, 1});
  counts.observe(0, std::vector<std::size_t>{1, missing});
  counts.observe(1, std::vector<std::size_t>{0, 0});
  Classifier sigma{pattern_prior(counts), learned_relations(counts, 1.0)};
  Classifier max{uninformative(as_fuzzy(kind)), learned_relations(counts, 1.0, DuboisPrade{})};
  EXPECT_CLOSE(learned_relation(counts, 0, 1.0).row(0), (Numbers{0.25, 0.75}), 0.0);
  EXPECT_CLOSE(max.features()[0].relation().row(0), (Numbers{0.25, 1.0}), 0.0);
  EXPECT_CLOSE(sigma.posterior(InOrder{1, 1})["cat"], (2.0 / 3 * 0.75 * 2 / 3) / (2.0 / 3 * 0.75 * 2 / 3 + 1.0 / 27),
               1e-14);

  const std::vector training{3.1, 4.7, 2.2, 5.0, 3.8, 2.9};
  const Discretization bins = equal_frequency(training, 3);
  const std::size_t bin = bins.bin(3.1);
  EXPECT_EQ(bins.labels(), (std::vector<std::string>{"below 3.1", "3.1 to 4.7", "4.7 and above"}));
  EXPECT_EQ(bin, 1U);

  const FuzzyVariable speed = bins.variable<Fuzzy>("speed");
  const Distribution possible = triangular(speed, bins, Triangle{2.0, 4.0, 5.0});
  EXPECT_CLOSE(possible.values(), (Numbers{0.55, 1.0, 0.3}), 1e-14);
}

TEST(RecognitionWalk, Evaluation) {
  const RandomVariable kind{"kind", {"cat", "hen"}};
  const RandomVariable limbs{"legs", {"2", "4"}};
  const std::vector<std::size_t> labels{0, 0, 0, 0, 1, 1, 1, 1};
  const std::vector<std::vector<std::size_t>> rows{{1}, {1}, {1}, {0}, {0}, {0}, {0}, {0}};

  std::mt19937_64 generator(1);
  const auto fold_of = stratified_folds(labels, 4, generator);
  Evaluation<Random> sigma{kind};
  Evaluation<Fuzzy> max{as_fuzzy(kind)};
  RunningMean paired;
  for (std::size_t fold = 0; fold < 4; ++fold) {
    Counts counts{kind, {limbs}};
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (fold_of[i] != fold) counts.observe(labels[i], rows[i]);
    Classifier by_sum{pattern_prior(counts), learned_relations(counts, 1.0)};
    Classifier by_max{uninformative(as_fuzzy(kind)), learned_relations(counts, 1.0, RatioScale{})};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (fold_of[i] != fold) continue;
      const double right = sigma.add(labels[i], by_sum.posterior(InOrder{rows[i]}));
      paired.add(right - max.add(labels[i], by_max.posterior(InOrder{rows[i]})));
    }
  }
  const double accuracy = sigma.confusion().accuracy();
  const double log_loss = sigma.log_loss();
  const double necessity_of_truth = max.necessity();
  const Interval difference = paired.interval();

  EXPECT_EQ(accuracy, 7.0 / 8.0);  // the cat with two legs is a hen
  // Without that cat p(4|cat) = 4/5, with two others and it 3/5; p(2|hen) = 4/5 always.
  const double expected = std::log(5.0) - std::log(0.8) - 3 * (std::log(0.75) + std::log(2.0 / 3));
  EXPECT_CLOSE(log_loss, expected / 8, 1e-14);
  EXPECT_CLOSE(necessity_of_truth, 0.5, 1e-14);
  EXPECT_EQ(difference.mean, 0.0);
  EXPECT_EQ(difference.upper(), 0.0);
}

}  // namespace recognition_walk_test
