#include "support/core.hpp"

namespace update_test {

template <class Prior, class Evidence>
concept Updates = requires(const Prior& prior, const Evidence& evidence) {
  update(prior, evidence);
};
static_assert(Updates<Distribution<Fuzzy>, Likelihood<Fuzzy>> && Updates<Belief<Random>, Likelihood<Random>>);
static_assert(!Updates<Distribution<Fuzzy>, Likelihood<Random>> && !Updates<Belief<Random>, Likelihood<Fuzzy>>);
static_assert(!Updates<Induced<Distribution<Random>>, Likelihood<Random>>);  // say .normalized() first

const RandomVariable weather{"weather", {"dry", "wet", "snow"}};

const FuzzyVariable mood{"mood", {"calm", "wild"}};

TEST(Update, ByEvidenceThatExcludesEverythingIsADomainErrorAndChangesNothing) {
  const Distribution prior{weather, {0.5, 0.5, 0.0}};
  const Likelihood impossible{weather, {0.0, 0.0, 1.0}};
  EXPECT_REFUSED(std::domain_error, ("'weather'"), update(prior, impossible));
  Belief belief{prior};
  EXPECT_REFUSED(std::domain_error, ("'weather'"), update(belief, impossible, belief));
  EXPECT_CLOSE(belief.distribution().values(), (std::vector{0.5, 0.5, 0.0}), 1e-15);
  EXPECT_THROW(update(uninformative(mood), Likelihood(mood, {0.0, 0.0})), std::domain_error);
}

TEST(Update, RefusesAnotherVariableByBothNames) {
  const RandomVariable sky{"sky", {"dry", "wet", "snow"}};
  EXPECT_INVALID(("update", "'weather'", "'sky'"), update(uninformative(weather), Likelihood{sky}));
  Belief other{uninformative(sky)};
  EXPECT_INVALID(("update", "'weather'", "'sky'"), update(Belief{uninformative(weather)}, Likelihood{weather}, other));
}

TEST(Update, BySubnormalEvidenceIsExact) {
  const Distribution prior{weather, {0.5, 0.5, 0.0}};
  EXPECT_CLOSE(update(prior, Likelihood{weather, {least_subnormal, 3 * least_subnormal, 1.0}}).values(),
               (std::vector{0.25, 0.75, 0.0}), 1e-12);
}

TEST(Update, ByAnOutlierSoFarThatEveryLikelihoodUnderflowsIsExact) {
  Likelihood outlier{weather};  // ½ · (10⁶ standard deviations)²
  outlier.set_log(0, -5e11);
  outlier.set_log(1, -5e11 + 1.0);
  outlier.set_log(2, -6e11);
  const double e = std::exp(1.0);
  EXPECT_CLOSE(update(uninformative(weather), outlier).values(), (std::vector{1.0 / (1.0 + e), e / (1.0 + e), 0.0}),
               1e-12);
}

TEST(Update, BringsBackAnOutcomeThatWasAlmostExcluded) {
  Belief belief{uninformative(mood)};
  const Likelihood against{mood, {1.0, 1e-3}}, in_favour{mood, {1e-3, 1.0}};
  for (int k = 0; k < 1000; ++k) update(belief, against, belief);
  EXPECT_EQ(belief.distribution()["wild"], 0.0);  // 10^−3000
  for (int k = 0; k < 1000; ++k) update(belief, in_favour, belief);
  EXPECT_CLOSE(belief.distribution().values(), (std::vector{1.0, 1.0}), 1e-9);
}

TEST(Invert, ReachesWhatOnlyAVanishingPriorReaches) {
  const RandomVariable from{"from", 3}, to{"to", 2};
  const Relation relation{to, from, {{1.0, 0.0}, {0.5, 0.5}, {0.5, 0.5}}};
  Belief prior{uninformative(from)};
  prior.assign([](std::size_t i) { return i == 0 ? 0.0 : -5000.0 + std::log(static_cast<double>(i)); });
  const auto inverse = invert(relation, prior);
  EXPECT_TRUE(inverse.unreachable.empty());
  EXPECT_CLOSE(inverse.relation.row(0), (std::vector{1.0, 0.0, 0.0}), 1e-15);
  EXPECT_CLOSE(inverse.relation.row(1), (std::vector{0.0, 1.0 / 3.0, 2.0 / 3.0}), 1e-12);
}

TEST(Invert, IsExactWhereOnlySubnormalNumbersLead) {
  const RandomVariable from{"from", 2}, to{"to", 2};
  const Relation relation{to, from, {{1.0, least_subnormal}, {1.0, least_subnormal}}};
  EXPECT_CLOSE(invert(relation, Distribution{from, {0.75, 0.25}}).relation.row(1), (std::vector{0.75, 0.25}), 1e-12);
}

TEST(Invert, IntoAResultIsTheSameAsTheValue) {
  const RandomVariable from{"from", 2}, to{"to", 3};
  const Relation first{to, from, {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  const Relation second{to, from, {{0.5, 0.25, 0.25}, {0.25, 0.75, 0.0}}};
  const Belief prior{uninformative(from)};
  auto result = invert(first, prior);
  EXPECT_EQ(result.unreachable.size(), 2U);
  invert(second, prior, result);
  EXPECT_TRUE(result.unreachable.empty());
  EXPECT_CLOSE(result.relation.table().values(), invert(second, prior).relation.table().values(), 0.0);
}

TEST(Invert, RefusesOtherVariablesByTheirNames) {
  const RandomVariable from{"from", 2}, to{"to", 2}, other{"other", 2};
  const Relation relation{to, from, {{0.5, 0.5}, {0.5, 0.5}}};
  EXPECT_INVALID(("invert", "'from'", "'other'"), invert(relation, uninformative(other)));
  const Relation to_given_other{to, other, {{0.5, 0.5}, {0.5, 0.5}}};
  auto result = invert(to_given_other, uninformative(other));
  EXPECT_INVALID(("invert", "'from'", "'other'"), invert(relation, Belief{uninformative(from)}, result));
}

}  // namespace update_test
