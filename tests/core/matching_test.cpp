#include "laws/generate.hpp"

namespace matching_test {

constexpr std::size_t none = no_column;

/// A user's own kind: what the library knows by name takes shortest paths.
struct OwnMax : Max {};
struct Possible : Fuzzy {
  using Algebra = OwnMax;
};

template <class P, class Q>
struct Mixture {
  using Pattern = P;
  using Permutation = Q;
  static constexpr bool one_name = std::is_same_v<P, Q>;
  static Matching match(const Choices& weights, const MatchingOptions& options = {}) {
    return sigmax::match<P, Q>(weights, options);
  }
};
template <class K>
constexpr By by = std::is_base_of_v<Random, K> ? By::sum : By::max;

/// A table of log weights: dense rows, absent columns being −∞, and the weights of no column.
struct Weights {
  Rows rows;
  Numbers none;

  Choices choices() const {
    Choices result;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      result.add_row(none[i]);
      for (std::size_t j = 0; j < rows[i].size(); ++j)
        if (rows[i][j] != log_zero || (i + j) % 2 == 0) result.add(j, rows[i][j]);  // some zeros are listed
    }
    return result;
  }
};
std::ostream& operator<<(std::ostream& out, const Weights& weights) {
  for (std::size_t i = 0; i < weights.rows.size(); ++i)
    out << "\nnone " << weights.none[i] << ", columns " << testing::PrintToString(weights.rows[i]);
  return out;
}

/// Logarithms that are exact in sums and often tie, or any; a fifth of them huge, as of almost no clutter.
Weights any_weights(bool exact, std::size_t n, std::size_t m) {
  return any([=](rc::Random& random) {
    const std::uint64_t sparse = random.next() % 3, certain = random.next() % 4;
    const auto log = [&] {
      const auto bits = random.next();
      if (exact) return static_cast<double>(bits % 4) * 0.5 + (bits % 5 == 4 ? 800.0 : 0.0);
      return static_cast<double>(bits >> 11) * 0x1p-50 - 4.0 + (bits % 5 == 0 ? 800.0 : 0.0);
    };
    Weights result{Rows(n, Numbers(m, log_zero)), Numbers(n)};
    for (double& number : result.none) number = random.next() % 4 < certain ? log_zero : log();
    for (Numbers& row : result.rows)
      for (double& number : row)
        if (random.next() % 3 >= sparse) number = log();
    return result;
  });
}

/// The definition, by all events one by one; they come in the order that decides which one is the best.
struct Events {
  using Columns = std::vector<std::size_t>;
  struct Event {
    Columns columns;
    long double log = 0;
  };
  using Pattern = std::pair<std::vector<bool>, std::set<std::size_t>>;  // rows that have a column, columns used
  std::vector<Event> all;
  std::map<Pattern, std::vector<Event>> of_pattern;

  explicit Events(const Weights& weights) {
    extend(weights, {});
    for (const Event& event : all) {
      Pattern pattern{{}, {event.columns.begin(), event.columns.end()}};
      for (const std::size_t column : event.columns) pattern.first.push_back(column != none);
      of_pattern[pattern].push_back(event);
    }
  }

  void extend(const Weights& weights, const Event& event) {
    const std::size_t row = event.columns.size();
    if (row == weights.rows.size()) return all.push_back(event);
    for (std::size_t j = 0; j <= weights.rows[row].size(); ++j) {
      const bool last = j == weights.rows[row].size();
      const double log = last ? weights.none[row] : weights.rows[row][j];
      const std::size_t column = last ? none : j;
      if (log == log_zero) continue;
      if (!last && std::count(event.columns.begin(), event.columns.end(), column) > 0) continue;
      Event longer{event.columns, event.log + log};
      longer.columns.push_back(column);
      extend(weights, longer);
    }
  }
  static const Event& best(const std::vector<Event>& events) {
    long double greatest = -infinity;
    for (const Event& event : events) greatest = std::max(greatest, event.log);
    return *std::find_if(events.begin(), events.end(), [&](const Event& e) { return e.log >= greatest - 1e-9L; });
  }

  /// The events that may count for a pattern whose permutation is fuzzy: the best of all, or those of it that tie.
  std::vector<Event> may_count(const std::vector<Event>& events) const {
    std::vector<Event> result;
    for (const Event& event : events) {
      if (event.columns == best(all).columns) return {event};
      if (event.log >= best(events).log - 1e-9L) result.push_back(event);
    }
    return result;
  }

  /// The ⊕ over patterns of the ⊕ over their events, of all and of each row → column, divided by the best event. Where
  /// kinds differ and the permutation is fuzzy, a pattern has one event only. If several may count, this is the most
  /// that a row → column can have, or the least.
  using Key = std::pair<std::size_t, std::size_t>;
  static constexpr Key total{none, none};
  std::map<Key, long double> sums(By outer, By inner, bool most) const {
    std::map<Key, long double> result;
    const auto add = [](By by, long double& sum, long double number) {
      sum = by == By::sum ? sum + number : std::max(sum, number);
    };
    const long double top = best(all).log;
    for (const auto& [pattern, events] : of_pattern) {
      std::map<Key, long double> within;
      std::map<Key, std::size_t> counts;
      const bool selects = outer == By::sum && inner == By::max;
      const std::vector<Event> counted = selects ? may_count(events) : events;
      for (const Event& event : counted) {
        std::vector<Key> keys{total};
        for (std::size_t row = 0; row < event.columns.size(); ++row) keys.emplace_back(row, event.columns[row]);
        for (const Key& key : keys) {
          add(inner, within[key], std::exp(event.log - top));
          ++counts[key];
        }
      }
      for (const auto& [key, number] : within)
        if (!selects || most || counts[key] == counted.size()) add(outer, result[key], number);
    }
    return result;
  }
};

/// Two results that should be the same but for rounding.
void require_same(const Matching& found, const Matching& expected, double tolerance) {
  require_near(found.log_total, expected.log_total, tolerance);
  RC_ASSERT(found.marginals.rows() == expected.marginals.rows());
  for (std::size_t row = 0; row < found.marginals.rows(); ++row) {
    require_near(found.marginals.entries(row).values, expected.marginals.entries(row).values, tolerance);
    require_near(found.marginals.none(row), expected.marginals.none(row), tolerance);
  }
}

/// The logarithm of a marginal, by the column instead of its place; −∞ if it has no place and no weight.
double marginal(const Matching& found, std::size_t row, std::size_t column, double weight) {
  if (column == none) return found.marginals.none(row);
  const auto entries = found.marginals.entries(row);
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (entries.index(k) == column) return entries.value(k);
  return weight == log_zero ? log_zero : not_a_number;
}

TYPED_SUITE(Matchings, Mixture<Random, Random>, Mixture<Random, Fuzzy>, Mixture<Fuzzy, Fuzzy>, Mixture<Fuzzy, Random>,
            Mixture<Possible, Possible>);

TYPED_PROPERTY(Matchings, AreWhatAllEventsSay) {
  const auto n = any_size(), m = *rc::gen::inRange<std::size_t>(1, n > 4 ? 10 - n : 7);
  const Weights weights = any_weights(*rc::gen::arbitrary<bool>(), n, m);
  const Events events(weights);
  const Choices choices = weights.choices();
  if (events.all.empty()) {
    RC_ASSERT_THROWS_AS(TypeParam::match(choices), std::domain_error);
    return;
  }
  const auto outer = by<typename TypeParam::Pattern>, inner = by<typename TypeParam::Permutation>;
  auto least = events.sums(outer, inner, false), most = events.sums(outer, inner, true);
  const Matching found = TypeParam::match(choices);
  const Events::Event& best = Events::best(events.all);
  RC_ASSERT(found.exact);
  RC_ASSERT(found.best == best.columns);
  require_near(found.log_best, static_cast<double>(best.log), 1e-12);
  require_near(found.log_total, static_cast<double>(best.log + std::log(most[Events::total])), 1e-12);
  for (std::size_t row = 0; row < n; ++row) {
    Events::Columns columns;
    for (const std::uint32_t column : choices.entries(row).columns) columns.push_back(column);
    columns.push_back(none);
    std::vector<long double> numbers, greatest;
    for (const std::size_t column : columns) greatest.push_back(most[{row, column}]);
    const long double own = outer == By::sum ? most[Events::total] : plain::eliminate(outer, greatest);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double log = columns[k] == none ? found.marginals.none(row) : found.marginals.entries(row).value(k);
      const auto bound = [&](long double sum) { return static_cast<double>(std::log(sum / own)); };
      require_near(log, std::clamp(log, bound(least[{row, columns[k]}]), bound(greatest[k])), 1e-12);
      numbers.push_back(std::exp(static_cast<long double>(log)));
    }
    require_near(static_cast<double>(plain::eliminate(outer, numbers)), 1.0, 1e-12);
    // The winner has the greatest marginal; if several tie it is the best event's, otherwise the first of them.
    Events::Columns winners;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (numbers[k] >= plain::eliminate(By::max, numbers) * (1.0L - 1e-9L)) winners.push_back(columns[k]);
    const bool best_wins = std::ranges::count(winners, best.columns[row]) > 0;
    RC_ASSERT(found.winners[row] == (best_wins ? best.columns[row] : winners.front()));
  }
}

/// Weights of some event, and without ties unless they are to be exact.
Weights any_possible_weights(bool exact = false) {
  const auto n = any_size(), m = *rc::gen::inRange<std::size_t>(1, n > 3 ? 8 - n : 5);
  const Weights weights = any_weights(exact, n, m);
  RC_PRE(!Events(weights).all.empty());
  return weights;
}

TYPED_PROPERTY(Matchings, DoNotDependOnTheOrder) {
  const bool exact = TypeParam::one_name && *rc::gen::arbitrary<bool>();
  const Weights weights = any_possible_weights(exact);
  const std::size_t n = weights.rows.size(), m = weights.rows[0].size();
  const Choices choices = weights.choices();
  const auto rows = any_order(n), columns = any_order(m);
  Weights other{Rows(n, Numbers(m)), Numbers(n)};
  for (std::size_t i = 0; i < n; ++i) {
    other.none[rows[i]] = weights.none[i];
    for (std::size_t j = 0; j < m; ++j) other.rows[rows[i]][columns[j]] = weights.rows[i][j];
  }
  const Matching one = TypeParam::match(choices), two = TypeParam::match(other.choices());
  const double tolerance = exact && std::is_same_v<TypeParam, Mixture<Fuzzy, Fuzzy>> ? 0.0 : 1e-12;
  require_near(two.log_total, one.log_total, tolerance);
  for (std::size_t i = 0; i < n; ++i) {
    require_near(two.marginals.none(rows[i]), one.marginals.none(i), tolerance);
    for (const std::uint32_t j : choices.entries(i).columns)
      require_near(marginal(two, rows[i], columns[j], weights.rows[i][j]), marginal(one, i, j, 0.0), tolerance);
    if (!exact) RC_ASSERT(two.best[rows[i]] == (one.best[i] == none ? none : columns[one.best[i]]));
  }
}

TYPED_PROPERTY(Matchings, DoNotDependOnTheScaleOfARow) {
  const Weights weights = any_possible_weights();
  Weights scaled = weights;
  scaled.none[0] += 3.5;
  for (double& number : scaled.rows[0]) number += 3.5;
  Matching found = TypeParam::match(scaled.choices());
  found.log_total -= 3.5;
  require_same(found, TypeParam::match(weights.choices()), 1e-12);
}

TYPED_PROPERTY(Matchings, OfOneEventAreThatEvent) {
  Weights weights = any_possible_weights();
  const Events events(weights);
  const auto& chosen = events.all[*rc::gen::inRange<std::size_t>(0, events.all.size())].columns;
  for (std::size_t i = 0; i < weights.rows.size(); ++i) {
    if (chosen[i] != none) weights.none[i] = log_zero;
    for (std::size_t j = 0; j < weights.rows[i].size(); ++j)
      if (j != chosen[i]) weights.rows[i][j] = log_zero;
  }
  const Matching found = TypeParam::match(weights.choices());
  RC_ASSERT(found.best == chosen);
  RC_ASSERT(found.winners == chosen);
  RC_ASSERT(found.log_total == found.log_best);
  for (std::size_t i = 0; i < chosen.size(); ++i) RC_ASSERT(marginal(found, i, chosen[i], 0.0) == 0.0);
}

// On a tree a pattern has one event, so that messages by the pattern's ⊕ are exact.

TYPED_PROPERTY(Matchings, AreExactOnTreesWithoutStates) {
  const Weights weights = any([](rc::Random& random) {
    constexpr std::size_t n = 8, m = 12;
    Weights tree{Rows(n, Numbers(m, log_zero)), Numbers(n)};
    const auto log = [&] { return static_cast<double>(random.next() >> 11) * 0x1p-50 - 4.0; };
    for (std::size_t row = 0, fresh = 0; row < n; ++row) {
      tree.none[row] = row % 3 == 2 && fresh < m ? log_zero : log();
      if (fresh > 0) tree.rows[row][random.next() % fresh] = log();
      for (std::size_t k = 0; k < 2 && fresh < m; ++k) tree.rows[row][fresh++] = log();
    }
    return tree;
  });
  const Matching found = TypeParam::match(weights.choices(), {.max_states = 0});
  RC_ASSERT(found.exact == (std::is_same_v<typename TypeParam::Pattern, Fuzzy>));
  require_same(found, TypeParam::match(weights.choices()), 1e-9);
}

/// Targets and detections at random on a line: each target has those within a gate.
Choices on_a_line(std::size_t targets, std::size_t detections, double length, double log_none, unsigned seed) {
  std::mt19937_64 draw(seed);
  std::uniform_real_distribution<double> anywhere(0.0, length);
  Numbers places(detections);
  for (double& place : places) place = anywhere(draw);
  Choices result;
  for (std::size_t i = 0; i < targets; ++i) {
    result.add_row(log_none);
    const double target = anywhere(draw);
    for (std::size_t j = 0; j < detections; ++j)
      if (std::abs(places[j] - target) < 3.0) result.add(j, 1.0 - 0.5 * std::pow(places[j] - target, 2));
  }
  return result;
}

TEST(MessagePassing, IsNearTheSumsOfSparseScans) {
  const Choices weights = on_a_line(100, 150, 600.0, std::log(0.1), 1);
  const Matching exact = match<Random, Random>(weights), messages = match<Random, Random>(weights, {.max_states = 0});
  EXPECT_TRUE(exact.exact);
  EXPECT_FALSE(messages.exact);
  double worst = 0.0;
  for (std::size_t row = 0; row < weights.rows(); ++row)
    worst = std::max(worst, std::abs(std::exp(messages.marginals.none(row)) - std::exp(exact.marginals.none(row))));
  EXPECT_GT(worst, 1e-6);
  EXPECT_LT(worst, 0.1);
  EXPECT_CLOSE(messages.log_total, exact.log_total, 0.05);  // of 43, over 100 rows
}

template <class M>
void end_without_nan(const Choices& weights, bool exact) {
  const Matching found = M::match(weights);
  EXPECT_EQ(found.exact, exact);
  EXPECT_TRUE(std::isfinite(found.log_total));
  for (std::size_t row = 0; row < weights.rows(); ++row) {
    EXPECT_FALSE(std::isnan(found.marginals.none(row)));
    for (const double log : found.marginals.entries(row).values) EXPECT_FALSE(std::isnan(log) || log > 1e-9);
  }
}

TEST(Matching, OfManyRowsThatContendEnds) {
  for (const Choices& weights : {on_a_line(300, 40, 2.0, std::log(0.1), 2), on_a_line(60, 62, 2.0, log_zero, 3)}) {
    end_without_nan<Mixture<Random, Random>>(weights, false);
    end_without_nan<Mixture<Random, Fuzzy>>(weights, false);
    end_without_nan<Mixture<Fuzzy, Fuzzy>>(weights, true);
    end_without_nan<Mixture<Fuzzy, Random>>(weights, false);
  }
}

TEST(Matching, NamesTheRowThatFindsNothing) {
  Choices weights;
  weights.add_row(0.0, {{1, 2.0}});
  weights.add_row(log_zero, {{0, log_zero}, {3, 1.0}});
  EXPECT_EQ((match<Random, Fuzzy>(weights).best), (std::vector<std::size_t>{1, 3}));
  weights.add_row(log_zero, {{3, 0.0}});
  EXPECT_REFUSED(std::domain_error, ("row 2"), match<Random, Random>(weights));
  weights.add_row(not_a_number);
  EXPECT_INVALID(("log weight", "row 3", "no column", "nan"), match<Random, Random>(weights));
  weights.clear();
  weights.add_row(0.0, {{3, infinity}});
  EXPECT_INVALID(("log weight", "row 0", "column 3", "inf"), match<Fuzzy, Fuzzy>(weights));
  EXPECT_EQ((match<Random, Random>(Choices{}).log_total), 0.0);
}

TEST(Choices, RefuseColumnsThatDoNotAscend) {
  Choices choices;
  EXPECT_INVALID(("no row"), choices.add(0, 1.0));
  EXPECT_INVALID(("row 0", "ascend", "1 follows 1"), choices.add_row(0.0, {{1, 0.0}, {1, 0.0}}));
}

TEST(Matching, LeavesMaxMarginalsOutIfNobodyWantsThem) {
  Choices weights;
  weights.add_row(0.0, {{0, 2.0}, {1, 1.0}});
  weights.add_row(0.0, {{0, 2.0}});
  const Matching found = match<Fuzzy, Fuzzy>(weights, {.marginals = false});
  EXPECT_EQ(found.winners, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(found.marginals.rows(), 0);
  EXPECT_EQ(found.log_total, 3.0);
}

}  // namespace matching_test
