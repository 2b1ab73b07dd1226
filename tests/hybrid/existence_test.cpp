#include "support/sigmax.hpp"

namespace existence_test {

/// Marginals of a target that is alone, by the weights of its detections over those of clutter.
template <class Kind>
Existence<Kind> seen(Existence<Kind> existence, const DetectionWeights& weights, const Numbers& ratios) {
  Choices table;
  table.add_row(existence.log_none(weights));
  for (std::size_t j = 0; j < ratios.size(); ++j)
    table.add(j, existence.log_presence() + weights.log_detected + std::log(ratios[j]));
  const Matching events = match<Kind, Kind>(table);
  double any = log_zero;
  for (std::size_t j = 0; j < ratios.size(); ++j) {
    const double log_weight = events.marginals.entries(0).value(j);
    any = std::is_same_v<Kind, Random> ? std::log(std::exp(any) + std::exp(log_weight)) : std::max(any, log_weight);
  }
  existence.update(weights, events.marginals.none(0), any);
  return existence;
}

Numbers drawn_ratios() {
  Numbers ratios(*rc::gen::inRange<std::size_t>(0, 5));
  for (double& ratio : ratios) ratio = std::exp(*rc::gen::inRange(-60, 60) / 10.0);
  return ratios;
}
double drawn_share() { return *rc::gen::inRange(1, 1000) / 1000.0; }

PROPERTY(Existence, OfARandomPatternIsThatOfIntegratedPda) {
  const double r = drawn_share(), P_D = drawn_share(), P_G = drawn_share();
  const Numbers ratios = drawn_ratios();
  const auto posterior = seen(Existence<Random>(r), DetectionWeights::of<Random>(P_D, P_G), ratios);
  double total = 1.0 - r * P_D * P_G;
  for (const double ratio : ratios) total += r * P_D * ratio;
  const double beta = (1.0 - r * P_D * P_G) / total;
  const double expected = 1.0 - beta + beta * (1.0 - P_D * P_G) * r / (1.0 - P_D * P_G * r);
  require_near(posterior.presence(), expected, 1e-12);
  require_near(posterior.necessity(), expected, 1e-12);
}

PROPERTY(Existence, OfAFuzzyPatternIsThatOfThePossibilisticBernoulliFilter) {
  const double q1 = drawn_share(), P_D = drawn_share();
  const Numbers ratios = drawn_ratios();
  const auto posterior = seen(Existence<Fuzzy>(q1), DetectionWeights::of<Fuzzy>(P_D, 1.0), ratios);
  const double d0 = (1.0 - P_D) / std::max(P_D, 1.0 - P_D), d1 = P_D / std::max(P_D, 1.0 - P_D);
  double present = q1 * d0;
  for (const double ratio : ratios) present = std::max(present, q1 * d1 * ratio);
  require_near(posterior.presence(), present / std::max(1.0, present), 1e-12);
  require_near(posterior.necessity(), 1.0 - 1.0 / std::max(1.0, present), 1e-12);
}

TEST(Existence, EndsWithTime) {
  Existence<Random> random(0.8);
  random.predict(Existence<Random>::survival(0.9));
  EXPECT_CLOSE(random.presence(), 0.72, 1e-15);
  Existence<Fuzzy> fuzzy(1.0);
  const double surely = std::log(1e6);
  fuzzy.update(DetectionWeights::of<Fuzzy>(0.9, 1.0), -surely, 0.0);
  EXPECT_CLOSE(fuzzy.necessity(), 1.0 - 1e-6, 1e-12);
  fuzzy.predict(Existence<Fuzzy>::survival(0.8));
  EXPECT_CLOSE(fuzzy.necessity(), 0.75, 1e-12);
  EXPECT_EQ(fuzzy.presence(), 1.0);
}

TEST(Existence, OfATargetThatIsNeverMissedLeavesNoneWithoutADetection) {
  const auto always = DetectionWeights::of<Random>(1.0, 1.0);
  EXPECT_EQ(Existence<Random>(1.0).log_none(always), log_zero);
  Existence<Random> existence(0.5);
  EXPECT_THROW(existence.update(always, log_zero, log_zero), std::domain_error);
  existence.update(always, 0.0, log_zero);
  EXPECT_EQ(existence.presence(), 0.0);
}

TEST(Existence, LearnsNothingOfAMissIfDetectionIsUnknown) {
  const DetectionWeights unknown{0.0, 0.0};
  EXPECT_EQ(seen(Existence<Fuzzy>(1.0), unknown, {}).necessity(), 0.0);
  EXPECT_EQ(seen(Existence<Fuzzy>(1.0), unknown, {}).presence(), 1.0);
  EXPECT_CLOSE(seen(Existence<Fuzzy>(0.1), unknown, {100.0}).necessity(), 0.9, 1e-12);
}

}  // namespace existence_test
