#include "support/plain.hpp"

namespace forward_backward_test {

using Rows = std::vector<Numbers>;

/// A chain as plain numbers, and what it is of: by the sum, or by the maximum.
struct Plain {
  plain::By by;
  Numbers start;
  std::vector<Rows> steps;       // of each a row per outcome before
  std::vector<Numbers> weights;  // after each step
};

/// By every path: ⊕ of all that go through each outcome at each time, divided by the ⊕ of all; and that.
std::pair<Rows, double> by_all_paths(const Plain& chain) {
  const std::size_t n = chain.start.size(), times = chain.steps.size() + 1;
  std::vector<std::vector<std::vector<long double>>> through(times, std::vector<std::vector<long double>>(n));
  std::vector<long double> all;
  std::vector<std::size_t> path(times, 0);
  while (true) {
    long double value = chain.start[path[0]];
    for (std::size_t t = 0; t + 1 < times; ++t)
      value *= static_cast<long double>(chain.steps[t][path[t]][path[t + 1]]) * chain.weights[t][path[t + 1]];
    all.push_back(value);
    for (std::size_t t = 0; t < times; ++t) through[t][path[t]].push_back(value);
    std::size_t t = 0;
    while (t < times && ++path[t] == n) path[t++] = 0;
    if (t == times) break;
  }
  const long double total = plain::eliminate(chain.by, all);
  Rows rows(times);
  for (std::size_t t = 0; t < times; ++t)
    for (const auto& values : through[t])
      rows[t].push_back(static_cast<double>(plain::eliminate(chain.by, values) / total));
  return {rows, static_cast<double>(std::log(total))};
}

template <Uncertainty Kind>
Plain any_chain(std::size_t n, std::size_t length, std::mt19937_64& generator) {
  const auto number = [&] {
    const auto bits = generator();
    return bits % 5 == 0 ? 0.0 : static_cast<double>((bits >> 11) + 1) * 0x1p-53;
  };
  const auto distribution = [&] {
    Numbers row(n);
    for (double& value : row) value = number();
    row[generator() % n] = 1.0;
    condition<AlgebraOf<Kind>>(row);
    return row;
  };
  Plain chain{std::is_same_v<Kind, Random> ? plain::By::sum : plain::By::max, distribution(), {}, {}};
  for (std::size_t t = 0; t < length; ++t) {
    Rows rows;
    for (std::size_t i = 0; i < n; ++i) rows.push_back(distribution());
    chain.steps.push_back(rows);
    Numbers weights(n);
    for (double& weight : weights) weight = number() * (t % 2 == 0 ? 1.0 : 0x1p-200);
    chain.weights.push_back(weights);
  }
  return chain;
}

TYPED_SUITE(ForwardBackwardOf, Random, Fuzzy);

TYPED_TEST(ForwardBackwardOf, IsOverAllPaths) {
  std::mt19937_64 generator(7);
  std::size_t excluded = 0;
  for (int round = 0; round < 200; ++round) {
    const std::size_t n = 1 + generator() % 4, length = generator() % 5;
    const Plain chain = any_chain<TypeParam>(n, length, generator);
    const Variable<TypeParam> x{"x", n};
    std::vector<Relation<TypeParam, TypeParam>> transitions;
    std::vector<Likelihood<TypeParam>> reports;
    for (std::size_t t = 0; t < length; ++t) {
      transitions.emplace_back(x, x, chain.steps[t]);
      reports.emplace_back(x, chain.weights[t]);
    }
    const auto [expected, log_total] = by_all_paths(chain);
    const Distribution<TypeParam> start{x, chain.start};
    if (std::isinf(log_total)) {
      ++excluded;
      std::size_t step = length + 1;  // the first one with which nothing is left
      for (Plain until = chain; std::isinf(by_all_paths(until).second); --step) {
        until.steps.pop_back();
        until.weights.pop_back();
      }
      EXPECT_REFUSED(std::domain_error, ("up to step " + std::to_string(step) + " ", "'x'"),
                     forward_backward(start, transitions, reports));
      continue;
    }
    const auto found = forward_backward(start, transitions, reports);
    ASSERT_EQ(found.size(), length + 1);
    for (std::size_t t = 0; t <= length; ++t) EXPECT_CLOSE(found.at(t).values(), expected[t], 1e-13);
    EXPECT_CLOSE(found.log_total(), log_total, 1e-13);
  }
  EXPECT_GT(excluded, 0U);
  EXPECT_LT(excluded, 100U);
}

/// The last time, and the evidence, against a Chain; all rows against those of a relation that is stored otherwise.
template <Uncertainty Kind>
void expect_as_chain(const Relation<Kind, Kind>& next, const std::vector<Likelihood<Kind>>& reports) {
  const auto found = forward_backward(uninformative(next.to()), next, reports);
  Chain chain{uninformative(next.to())};
  for (const auto& report : reports) chain = update(compose(next, std::move(chain)), report);
  EXPECT_CLOSE(found.log_total(), chain.log_total(), 1e-12);
  EXPECT_CLOSE(found.at(reports.size()).values(), chain.normalized().values(), 1e-12);
  const auto again = forward_backward(uninformative(next.to()), next.dense(), reports);
  for (std::size_t t = 0; t < found.size(); t += 97) EXPECT_CLOSE(found.at(t).values(), again.at(t).values(), 1e-13);
}

TEST(ForwardBackward, NeitherUnderflowsNorMindsHowRowsAreStored) {
  const auto walk = []<class Kind>(const Variable<Kind>& x) {
    BandedRows rows;
    const bool sums = std::is_same_v<Kind, Random>;
    for (std::size_t i = 0; i < x.size(); ++i)
      rows.append(i == 0 ? 0 : i - 1, i == 0 || i + 1 == x.size()
                                          ? (sums ? Numbers{0.5, 0.5} : Numbers{1.0, 1.0})
                                          : (sums ? Numbers{0.25, 0.5, 0.25} : Numbers{0.5, 1.0, 0.5}));
    return Relation<Kind, Kind>{x, x, std::move(rows)};
  };
  const auto reports = []<class Kind>(const Variable<Kind>& x) {
    std::vector<Likelihood<Kind>> all;
    for (std::size_t t = 0; t < 3000; ++t) {
      Numbers weights(x.size());
      for (std::size_t i = 0; i < x.size(); ++i) weights[i] = std::ldexp(1.0, -static_cast<int>((i * 7 + t) % 11));
      all.emplace_back(x, weights);
    }
    return all;
  };
  const RandomVariable x{"x", 20};
  expect_as_chain(walk(x), reports(x));
  const FuzzyVariable y{"y", 20};
  expect_as_chain(walk(y), reports(y));
}

TEST(ForwardBackward, KeepsWhatNoDoubleHoldsTogether) {
  // Fifty reports make the second outcome 2⁻¹⁰⁰ times as likely, each; the next fifty undo it. It never changes.
  const FuzzyVariable x{"x", 2};
  const Relation stays{x, x, {{1.0, 0.0}, {0.0, 1.0}}};
  std::vector<Likelihood<Fuzzy>> reports(50, Likelihood{x, {1.0, 0x1p-100}});
  reports.insert(reports.end(), 50, Likelihood{x, {0x1p-100, 1.0}});
  const auto found = forward_backward(Distribution{x, {1.0, 0.25}}, stays, reports);
  for (std::size_t t = 0; t <= 100; ++t) EXPECT_CLOSE(found.at(t).values(), (Numbers{1.0, 0.25}), 0.0) << t;
  EXPECT_CLOSE(found.log_total(), -5000 * std::log(2.0), 1e-14);
  // A number of the transition that is far below the others is not lost either.
  const Relation leaks{x, x, {{1.0, 0x1p-1000}, {0.0, 1.0}}};
  const std::vector<Likelihood<Fuzzy>> sees(2, Likelihood{x, {0x1p-600, 1.0}});
  const auto leaked = forward_backward(Distribution{x, {1.0, 0.0}}, leaks, sees);
  EXPECT_CLOSE(leaked.at(1).values(), (Numbers{0.0, 1.0}), 0x1p-190);
  EXPECT_CLOSE(leaked.log_total(), -1000 * std::log(2.0), 1e-14);
}

TEST(ForwardBackward, KeepsWhatNoDoubleHoldsInAReport) {
  // Nor any exponent of a double: twelve bits would take 2⁻⁴⁰⁹⁶ for one.
  const FuzzyVariable x{"x", 2};
  const Relation stays{x, x, {{1.0, 0.0}, {0.0, 1.0}}};
  for (const int power : {-290, -310, -1000, -1100, -2048, -4096, -8192}) {
    std::vector<Likelihood<Fuzzy>> reports(2, Likelihood<Fuzzy>{x});
    reports[0].set_log(1, power * std::log(2.0));
    const auto found = forward_backward(Distribution{x, {1.0, 0.25}}, stays, reports);
    EXPECT_CLOSE(found.at(2).values(), (Numbers{1.0, std::ldexp(0.25, power)}), 1e-15) << power;
    EXPECT_EQ(found.log_total(), 0.0) << power;
    reports[1].set_log(0, power * std::log(2.0));
    const auto undone = forward_backward(Distribution{x, {1.0, 0.25}}, stays, reports);
    EXPECT_CLOSE(undone.at(1).values(), (Numbers{1.0, 0.25}), 1e-15) << power;
    EXPECT_CLOSE(undone.log_total(), power * std::log(2.0), 1e-15) << power;
  }
}

TEST(ForwardBackward, RefusesWhatDoesNotFit) {
  const RandomVariable x{"x", 2}, y{"y", 2};
  const Distribution start{x, {1.0, 0.0}};
  const Relation stays{x, x, {{1.0, 0.0}, {0.0, 1.0}}};
  const std::vector<Likelihood<Random>> other{Likelihood{y, {1.0, 0.5}}}, never{Likelihood{x, {0.0, 1.0}}};
  EXPECT_INVALID(("'x'", "'y'"), forward_backward(start, stays, other));
  EXPECT_REFUSED(std::domain_error, ("step 1", "'x'"), forward_backward(start, stays, never));
  EXPECT_INVALID(("2 transitions", "1 reports"), forward_backward(start, std::vector{stays, stays}, never));
  const Relation leaves{y, x, {{1.0, 0.0}, {0.0, 1.0}}};
  EXPECT_INVALID(("'x'", "'y'"), forward_backward(start, leaves, never));
  EXPECT_INVALID(("time 1", "1 times"), forward_backward(start, stays, {}).at(1));
}

}  // namespace forward_backward_test
