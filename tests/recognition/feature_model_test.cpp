#include "laws/generate.hpp"
#include "support/sigmax.hpp"

/// Every kind of sensor over every kind of feature and pattern, by plain loops, and the small worlds with known
/// answers.
namespace feature_model_test {

template <class PatternKind, class FeatureKind, class ReadingKind>
struct Kinds {
  using Pattern = PatternKind;
  using Feature = FeatureKind;
  using Reading = ReadingKind;
};

template <class>
class FeatureModelOf : public testing::Test {};
using AllKinds = testing::Types<Kinds<Random, Random, Random>,  // (41)–(43)
                                Kinds<Fuzzy, Fuzzy, Fuzzy>,     // (44)–(46)
                                Kinds<Fuzzy, Fuzzy, Random>,    // sigma-max: (17), (19)
                                Kinds<Random, Random, Fuzzy>,   // (18), (20)
                                Kinds<Fuzzy, Random, Random>, Kinds<Fuzzy, Random, Fuzzy>, Kinds<Random, Fuzzy, Random>,
                                Kinds<Random, Fuzzy, Fuzzy>>;
TYPED_TEST_SUITE(FeatureModelOf, AllKinds, support::TypeNames);

TYPED_PROPERTY(FeatureModelOf, ReadByASensorIsThePlainRecursion) {
  using K = TypeParam;
  const auto pattern = any_variable<typename K::Pattern>("pattern");
  const auto feature = any_variable<typename K::Feature>("feature");
  const auto reading = any_variable<typename K::Reading>("reading");
  const auto prior = any_distribution(pattern);
  const auto feature_given_pattern = any_relation(feature, pattern);
  const auto reading_given_feature = any_relation(reading, feature);
  const Classifier classifier{prior, std::vector{FeatureModel{feature_given_pattern, reading_given_feature}}};
  const Rows rows = rows_of(feature_given_pattern.table()), sensor = rows_of(reading_given_feature.table());
  for (std::size_t z = 0; z < reading.size(); ++z) {
    Numbers likelihood;  // L(z|c) = ⊕ over f of L(z|f) L(f|c), where the feature's kind chooses ⊕; no β
    for (const Numbers& row : rows)
      likelihood.push_back(
          static_cast<double>(plain::evidence(by_kind<typename K::Feature>, row, plain::column(sensor, z))));
    constexpr plain::By by = by_kind<typename K::Pattern>;
    if (plain::evidence(by, numbers_of(prior.values()), likelihood) <= 1e-200L) continue;  // few digits left
    require_near(classifier.posterior(InOrder{z}).distribution().values(),
                 plain::update(by, numbers_of(prior.values()), likelihood));
    // A sensor's crisp reading is the graded report of its column.
    Belief belief{prior};
    classifier.observe(belief, reading_given_feature.likelihood(z));
    require_near(belief.distribution().values(), plain::update(by, numbers_of(prior.values()), likelihood));
  }
}

TYPED_PROPERTY(FeatureModelOf, ReadItselfIsTheColumnOfItsRelation) {
  using K = TypeParam;
  const auto pattern = any_variable<typename K::Pattern>("pattern");
  const auto feature = any_variable<typename K::Feature>("feature");
  const auto relation = any_relation(feature, pattern);
  const FeatureModel model{relation};
  for (std::size_t f = 0; f < feature.size(); ++f)
    for (std::size_t c = 0; c < pattern.size(); ++c)
      require_near(model.log_likelihoods(f)[c], std::log(relation(c, f)), 1e-15);
}

TEST(FeatureModel, KnowsWhatIsRead) {
  const FuzzyVariable target{"target", {"T1", "T2"}}, emitter{"emitter", {"e1", "e2"}};
  const RandomVariable reading{"reading", {"z1", "z2", "z3"}};
  const Relation emitter_given_target{emitter, target, {{1.0, 0.5}, {0.25, 1.0}}};
  const Relation reading_given_emitter{reading, emitter, {{0.5, 0.25, 0.25}, {0.0, 0.25, 0.75}}};
  const FeatureModel alone{emitter_given_target};
  EXPECT_FALSE(alone.has_sensor());
  EXPECT_EQ(alone.readings(), emitter);
  EXPECT_EQ(alone.reading_symbol(), "π");
  EXPECT_EQ(alone.evidence(1)["e1"], 0.0);
  EXPECT_EQ(alone.evidence(1)["e2"], 1.0);
  const FeatureModel with_sensor{emitter_given_target, reading_given_emitter};
  EXPECT_TRUE(with_sensor.has_sensor());
  EXPECT_EQ(with_sensor.readings(), reading);
  EXPECT_EQ(with_sensor.reading_symbol(), "p");
  EXPECT_EQ(with_sensor.evidence(2)["e2"], 0.75);
  // max over e of p(z1|e) π(e|c)
  EXPECT_CLOSE(with_sensor.log_likelihoods(0), (Numbers{std::log(0.5), std::log(0.125)}), 1e-15);
}

TEST(FeatureModel, RefusesASensorOfAnotherFeatureAndReadingsThatItHasNot) {
  const RandomVariable target{"target", 2}, emitter{"emitter", 2}, band{"band", 2}, reading{"reading", 3};
  const Relation emitter_given_target{emitter, target, {{1.0, 0.0}, {0.0, 1.0}}};
  const Relation reading_given_band{reading, band, {{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
  EXPECT_INVALID(("'emitter'", "'band'"), FeatureModel(emitter_given_target, reading_given_band));
  const FeatureModel model{emitter_given_target};
  EXPECT_INVALID(("'emitter'", "2"), model.log_likelihoods(2));
  EXPECT_INVALID(("'emitter'"), model.evidence(missing));
}

// The authors' kinematic recognition tables: manoeuvres weak, medium, strong; classes airliner, bomber, fighter.

}  // namespace feature_model_test
