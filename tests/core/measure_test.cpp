#include "support/core.hpp"

namespace measure_test {

const FuzzyVariable age{"age", {"child", "young", "middle", "old"}};

const RandomVariable weather{"weather", {"dry", "wet", "snow"}};
const Distribution belief{age, {0.2, 1.0, 0.7, 0.1}};

// Each measure is of its own kind.
template <class Kind>
concept HasProbability = requires(const Distribution<Kind>& d, const Event<Kind>& e) {
  probability(d, e);
};
template <class Kind>
concept HasPossibility = requires(const Distribution<Kind>& d, const Event<Kind>& e) {
  possibility(d, e);
  necessity(d, e);
};
static_assert(HasProbability<Random> && !HasProbability<Fuzzy>);
static_assert(HasPossibility<Fuzzy> && !HasPossibility<Random>);

TEST(Event, IsWrittenByLabelsOrByIndices) {
  const Event by_labels{age, {"young", "middle"}};
  const std::vector<std::size_t> indices{2, 1, 2};
  EXPECT_EQ(by_labels, (Event{age, {1, 2}}));
  EXPECT_EQ(by_labels, (Event{age, indices}));
  EXPECT_TRUE(by_labels.contains("young") && by_labels.contains(2));
  EXPECT_FALSE(by_labels.contains("child") || by_labels.contains(3));
  EXPECT_EQ(by_labels.variable(), age);
}

TEST(Event, OfOneOutcomeMayBeTheFirst) { EXPECT_EQ((Event{age, {0}}), (Event{age, {"child"}})); }

TEST(Event, IsUnitedIntersectedAndComplemented) {
  const Event a{age, {"child", "young"}}, b{age, {"young", "old"}};
  EXPECT_EQ(a | b, (Event{age, {"child", "young", "old"}}));
  EXPECT_EQ(a & b, (Event{age, {"young"}}));
  EXPECT_EQ(~a, (Event{age, {"middle", "old"}}));
  EXPECT_EQ(a & ~a, empty_event(age));
  EXPECT_EQ(a | ~a, ~empty_event(age));
  EXPECT_NE(a, b);
}

TEST(Event, OfAnotherVariableIsAnotherEvent) {
  const FuzzyVariable years{"years", {"child", "young", "middle", "old"}};
  EXPECT_NE(~empty_event(age), ~empty_event(years));
}

TEST(Event, DescribesItself) {
  EXPECT_EQ((Event{age, {"old", "child"}}.description()), "age in {child, old}");
  EXPECT_EQ(empty_event(weather).description(), "weather in {}");
}

TEST(Event, RefusesAnOutcomeThatTheVariableDoesNotHave) {
  EXPECT_INVALID(("'age'", "'ancient'"), Event{age, {"young", "ancient"}});
  EXPECT_INVALID(("'age'", "4"), Event{age, {1, 4}});
}

TEST(Event, RefusesOperationsWithEventsOfAnotherVariable) {
  const FuzzyVariable mood{"mood", {"calm", "wild"}};
  EXPECT_INVALID(("union", "'age'", "'mood'"), ~empty_event(age) | ~empty_event(mood));
  EXPECT_INVALID(("intersection", "'age'", "'mood'"), ~empty_event(age) & ~empty_event(mood));
  EXPECT_INVALID(("measure", "'age'", "'mood'"), possibility(belief, ~empty_event(mood)));
}

TEST(Given, IsExactForEventsOfSubnormalMeasure) {
  const Distribution rare{weather, {1.0, least_subnormal, 3 * least_subnormal}};
  EXPECT_EQ(probability(given(rare, Event{weather, {"wet", "snow"}}), Event{weather, {"snow"}}), 0.75);
}

TEST(Given, RefusesAConditionOfMeasureZeroByItsName) {
  const Distribution dry{weather, {1.0, 0.0, 0.0}};
  const Distribution young{age, {0.0, 1.0, 0.0, 0.0}};
  EXPECT_REFUSED(std::domain_error, ("weather in {wet, snow}", "probability 0"),
                 given(dry, Event{weather, {"wet", "snow"}}));
  EXPECT_REFUSED(std::domain_error, ("age in {old}", "possibility 0"), given(young, Event{age, {"old"}}));
  EXPECT_REFUSED(std::domain_error, ("age in {}"), given(young, empty_event(age)));
}

using Features = std::set<std::string>;
const Features man{"dark hair", "reading glasses", "runs daily", "two children"};
const Features young_features{"dark hair", "runs daily", "student"};

TEST(Compatibility, WeighsFeaturesByTheirMeasure) {
  const auto weight = [](const std::string& feature) { return feature == "two children" ? 5.0 : 1.0; };
  EXPECT_EQ(compatibility(man, young_features, weight), 0.25);
}

TEST(Compatibility, RefusesAnObjectWithoutFeatures) {
  EXPECT_INVALID(("positive", "0"), compatibility(Features{}, young_features));
  EXPECT_THROW(compatibility(man, young_features, [](const std::string&) { return 0.0; }), std::invalid_argument);
}

TEST(Compatibility, RefusesWhatIsNoDegreeOrNoMeasure) {
  const std::vector<double> one{1.0}, two{1.0, 1.0};
  const auto refused = [](const std::vector<double>& object, const std::vector<double>& outcome,
                          const std::vector<double>& weights, std::string_view word) {
    return throws<std::invalid_argument>([&] { compatibility(object, outcome, weights); }, {"compatibility", word});
  };
  EXPECT_TRUE(refused({1.5}, one, one, "object's degree of feature 0 is 1.5"));
  EXPECT_TRUE(refused(one, {-0.5}, one, "outcome's degree of feature 0 is -0.5"));
  EXPECT_TRUE(refused({not_a_number}, one, one, "object's degree"));
  EXPECT_TRUE(refused(two, two, {1.0, -1.0}, "measure of feature 1 is -1"));
  EXPECT_TRUE(refused(one, one, {not_a_number}, "measure"));
  EXPECT_TRUE(refused(one, one, {infinity}, "finite"));
  EXPECT_TRUE(refused(two, one, two, "2, 1 and 2"));
}

}  // namespace measure_test
