#include "laws/generate.hpp"

namespace route_test {

using Way = std::vector<std::size_t>;

template <class Kind>
concept HasRoutes = requires {
  typename Routes<Kind>;
};
static_assert(HasRoutes<Fuzzy> && HasRoutes<Ordinal> && !HasRoutes<Random>);  // a sum goes by all ways

const FuzzyVariable mood{"mood", {"calm", "wild"}};

TEST(BestRoute, WithoutRelationsIsTheMostPossibleStart) {
  const Route route = best_route(Routes{Distribution{mood, {0.5, 1.0}}});
  EXPECT_EQ(route.outcomes, (Way{1}));
  EXPECT_EQ(route.log_value, 0.0);
}

TEST(BestRoute, WeighsStartRelationsAndEvidence) {
  const Relation next{mood, mood, {{1.0, 0.5}, {0.25, 1.0}}};
  const Route route = best_route(Distribution{mood, {1.0, 0.5}}, next, Likelihood{mood, {0.5, 1.0}}, next,
                                 Likelihood{mood, {0.1, 1.0}});
  EXPECT_EQ(route.outcomes, (Way{0, 1, 1}));  // ½, as wild, wild, wild has, which starts later
  EXPECT_CLOSE(route.log_value, std::log(0.5), 1e-15);
}

TYPED_SUITE(RoutesOf, Fuzzy, Ordinal);

/// There is no way to an impossible outcome; the one that is named is of first outcomes.
TYPED_TEST(RoutesOf, ToAnImpossibleOutcomeAreOfFirstOutcomes) {
  const Variable<TypeParam> start{"start", 3}, middle{"middle", 3}, end{"end", 2};
  const Routes routes = compose(Relation{end, middle, {{1.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}}},
                                compose(Relation{middle, start, {{0.0, 1.0, 0.5}, {0.0, 0.5, 1.0}, {0.0, 1.0, 1.0}}},
                                        Routes{uninformative(start)}));
  EXPECT_EQ(routes.to(1).outcomes, (Way{0, 0, 1}));
  EXPECT_EQ(routes.to(1).log_value, log_zero);
  EXPECT_EQ(routes.to(0).outcomes, (Way{0, 1, 0}));
}

/// All routes of short chains, compared from the last outcome backwards as the documentation says.
TYPED_TEST(RoutesOf, FollowTheDocumentedTieRule) {
  std::mt19937 random(7);
  const auto grade = [&] { return static_cast<double>(random() % 5) / 4.0; };  // dyadic: products are exact
  int ties = 0;
  for (int repetition = 0; repetition < 1000; ++repetition) {
    const std::size_t length = 2 + random() % 3;
    std::vector<Variable<TypeParam>> variables;
    for (std::size_t k = 0; k <= length; ++k) variables.push_back({"v" + std::to_string(k), 1 + random() % 3});
    const auto row = [&](std::size_t n) {
      Numbers values(n);
      for (double& value : values) value = grade();
      values[random() % n] = 1.0;
      return values;
    };
    const Distribution first{variables[0], row(variables[0].size())};
    Routes routes{first};
    std::vector<Relation<TypeParam, TypeParam>> relations;
    std::vector<Likelihood<TypeParam>> reports;
    bool possible = true;
    for (std::size_t k = 1; k <= length && possible; ++k) {
      Rows rows;
      for (std::size_t i = 0; i < variables[k - 1].size(); ++i) rows.push_back(row(variables[k].size()));
      relations.emplace_back(variables[k], variables[k - 1], rows);
      reports.emplace_back(variables[k], row(variables[k].size()));
      try {
        routes = update(compose(relations.back(), std::move(routes)), reports.back());
      } catch (const std::domain_error&) {
        possible = false;
      }
    }
    if (!possible) continue;
    Way way(length + 1, 0), best;
    double greatest = 0.0;
    int tied = 0;
    const auto before = [](const Way& a, const Way& b) {
      return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
    };
    while (true) {
      double value = first[way[0]];
      for (std::size_t k = 1; k <= length; ++k) {
        value = AlgebraOf<TypeParam>::times(value, relations[k - 1](way[k - 1], way[k]));
        value = AlgebraOf<TypeParam>::times(value, reports[k - 1][way[k]]);
      }
      tied = value > greatest ? 1 : tied + (value == greatest);
      if (value > greatest || (value == greatest && (best.empty() || before(way, best)))) greatest = value, best = way;
      std::size_t k = 0;
      while (k <= length && ++way[k] == variables[k].size()) way[k++] = 0;
      if (k > length) break;
    }
    ties += tied > 1;
    ASSERT_EQ(best_route(routes).outcomes, best) << "repetition " << repetition;
    ASSERT_NEAR(best_route(routes).log_value, std::log(greatest), 1e-13);
  }
  EXPECT_GT(ties, 100);
}

TEST(Routes, StayAsTheyWereWhereEvidenceExcludesAll) {
  const Relation next{mood, mood, {{1.0, 0.0}, {0.5, 1.0}}};
  Routes routes{Distribution{mood, {1.0, 0.0}}};
  const Likelihood report{mood, {0.5, 1.0}};
  for (std::size_t step = 0; step < 3; ++step) {
    EXPECT_THROW(routes = update(compose(next, std::move(routes)), Likelihood(mood, {0.0, 1.0})), std::domain_error);
    EXPECT_EQ(best_route(routes).outcomes, Way(step + 1, 0));
    EXPECT_EQ(best_route(routes).log_value, std::log(std::pow(0.5, static_cast<double>(step))));
    routes = update(compose(next, std::move(routes)), report);
  }
  const Routes kept = routes;
  routes = compose(next, std::move(routes));
  EXPECT_EQ(best_route(kept).outcomes.size(), 4U);
  EXPECT_EQ(best_route(routes).outcomes.size(), 5U);
}

TEST(BestRoute, ThroughEvidenceThatExcludesEveryRouteIsADomainError) {
  const Relation stays{mood, mood, {{1.0, 0.0}, {0.0, 1.0}}};
  EXPECT_REFUSED(std::domain_error, ("evidence", "'mood'"),
                 best_route(Distribution{mood, {1.0, 0.0}}, stays, Likelihood{mood, {0.0, 1.0}}));
}

TEST(BestRoute, RefusesARelationFromAnotherVariable) {
  const FuzzyVariable age{"age", {"young", "old"}};
  const Relation other{mood, age, {{1.0, 1.0}, {1.0, 1.0}}};
  EXPECT_INVALID(("'age'", "'mood'"), best_route(uninformative(mood), other));
}

TEST(BestRoute, ThroughAHundredThousandRelationsDoesNotUnderflow) {
  // Staying costs ½ and changing nothing, reports alternate: the best route changes at every step.
  const Relation next{mood, mood, {{0.5, 1.0}, {1.0, 0.5}}};
  Routes routes{Distribution{mood, {1.0, 0.25}}};
  constexpr std::size_t length = 100000;
  for (std::size_t step = 1; step <= length; ++step)
    routes = update(compose(next, std::move(routes)),
                    Likelihood{mood, step % 2 == 1 ? Numbers{0.0, 0.5} : Numbers{0.5, 0.0}});
  const Route route = best_route(routes);
  EXPECT_CLOSE(route.log_value, -100000.0 * std::log(2.0), 1e-13);
  ASSERT_EQ(route.outcomes.size(), length + 1);
  for (std::size_t step = 0; step <= length; ++step) ASSERT_EQ(route.outcomes[step], step % 2);
}

}  // namespace route_test
