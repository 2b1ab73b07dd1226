#include <boost/multiprecision/cpp_int.hpp>

#include "laws/generate.hpp"

namespace route_test {

using boost::multiprecision::cpp_rational;
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

/// A generated chain: numbers drawn by `draw`, in the order start, then relation and evidence in turn.
template <class Kind>
struct Case {
  std::vector<Variable<Kind>> stages;
  Numbers start;
  std::vector<Rows> relations;
  std::vector<Numbers> evidence;

  /// The factors along a route.
  Numbers along(const Way& route) const {
    Numbers factors{start[route[0]]};
    for (std::size_t s = 0; s + 1 < route.size(); ++s) {
      factors.push_back(relations[s][route[s]][route[s + 1]]);
      factors.push_back(evidence[s][route[s + 1]]);
    }
    return factors;
  }

  Routes<Kind> routes() const {
    Routes<Kind> result{Distribution<Kind>{stages[0], start}};
    for (std::size_t s = 0; s + 1 < stages.size(); ++s) {
      const Relation<Kind, Kind> next{stages[s + 1], stages[s], relations[s]};
      result = update(compose(next, std::move(result)), Likelihood<Kind>{stages[s + 1], evidence[s]});
    }
    return result;
  }

  /// visit(route) for every route whose last outcomes are `tail`, in the order in which ties are decided.
  void for_each_route(Way tail, const std::function<void(const Way&)>& visit) const {
    if (tail.size() == stages.size()) return visit(tail);
    const auto& stage = stages[stages.size() - tail.size() - 1];
    for (std::size_t i = 0; i < stage.size(); ++i) {
      Way longer{i};
      longer.insert(longer.end(), tail.begin(), tail.end());
      for_each_route(longer, visit);
    }
  }
};

/// Zeros, subnormals and repeated maxima; `powers`: powers of two only, so that products are exact and ties real.
template <class Kind>
Case<Kind> any_case(bool powers) {
  Case<Kind> c;
  const std::size_t length = *rc::gen::inRange<std::size_t>(1, 5);
  for (std::size_t s = 0; s < length; ++s)
    c.stages.push_back({"stage " + std::to_string(s), *rc::gen::inRange<std::size_t>(1, 5)});
  const auto rounded = [&](Numbers numbers) {
    if (powers)
      for (double& number : numbers) number = number == 0.0 ? 0.0 : std::exp2(std::floor(std::log2(number)));
    return numbers;
  };
  c.start = rounded(laws::any_normalized_numbers(plain::By::max, c.stages[0].size()));
  for (std::size_t s = 0; s + 1 < length; ++s) {
    Rows rows = laws::any_normalized_rows(plain::By::max, c.stages[s].size(), c.stages[s + 1].size());
    for (Numbers& row : rows) row = rounded(row);
    c.relations.push_back(rows);
    // The evidence is kept as logarithms, which only a power of two of few bits survives: so these are 0, ½ and 1.
    Numbers evidence = laws::any_unit_numbers(c.stages[s + 1].size());
    for (double& value : evidence) value = value >= 0.5 ? 1.0 : value > 0.0 ? 0.5 : 0.0;
    c.evidence.push_back(evidence);
  }
  return c;
}

cpp_rational product(const Numbers& factors) {
  cpp_rational result = 1;
  for (const double factor : factors) result *= cpp_rational(factor);
  return result;
}
double least(const Numbers& factors) { return *std::min_element(factors.begin(), factors.end()); }

/// The best route by brute force; empty if none is possible.
template <class Value, class Kind>
std::pair<Way, Value> best_of_all(const Case<Kind>& c, const std::function<Value(const Numbers&)>& value) {
  std::pair<Way, Value> best{{}, Value(0)};
  c.for_each_route({}, [&](const Way& route) {
    if (const Value found = value(c.along(route)); found > best.second) best = {route, found};
  });
  return best;
}

/// The route, or an empty one if the evidence excludes all.
template <class Kind>
Way found_route(const Case<Kind>& c) {
  try {
    return best_route(c.routes()).outcomes;
  } catch (const std::domain_error&) {
    return {};
  }
}

PROPERTY(BestRoute, OfExactProductsIsThatOfBruteForceTiesIncluded) {
  const auto c = any_case<Fuzzy>(true);
  const auto [route, value] = best_of_all<cpp_rational>(c, product);
  RC_ASSERT(found_route(c) == route);
}

PROPERTY(BestRoute, OfAnyProductsIsThatOfBruteForceToRounding) {
  const auto c = any_case<Fuzzy>(false);
  const auto [route, value] = best_of_all<cpp_rational>(c, product);
  const Way found = found_route(c);
  RC_ASSERT(found.empty() == route.empty());
  if (!found.empty()) RC_ASSERT(product(c.along(found)) * cpp_rational(1.0 + 1e-14) >= value);
}

PROPERTY(BestRoute, OfOrdinalRelationsIsThatOfBruteForce) {
  const auto c = any_case<Ordinal>(false);
  const auto [route, value] = best_of_all<double>(c, least);
  const Way found = found_route(c);
  RC_ASSERT(found.empty() == route.empty());
  if (found.empty()) return;
  RC_ASSERT(least(c.along(found)) == value);
  RC_ASSERT(found.back() == route.back());
}

PROPERTY(BestRoute, HasTheLogarithmOfItsProduct) {
  const auto c = any_case<Fuzzy>(false);
  if (found_route(c).empty()) return;
  const Route route = best_route(c.routes());
  double log = 0.0;
  for (const double factor : c.along(route.outcomes)) log += std::log(factor);
  support::require_near(route.log_value, log, 1e-13);
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
