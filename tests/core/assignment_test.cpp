#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/successive_shortest_path_nonnegative_weights.hpp>

#include <boost/graph/find_flow_cost.hpp>  // after what it does not include

#include "laws/generate.hpp"

namespace assignment_test {

constexpr std::size_t none = no_column;

/// Draws a table of costs that are integers, so that sums are exact and often tie.
Choices any_costs(rc::Random& random, std::size_t rows, std::size_t columns, std::uint64_t greatest) {
  const auto cost = [&] { return static_cast<double>(random.next() % (greatest + 1)); };
  Choices costs;
  for (std::size_t row = 0; row < rows; ++row) {
    costs.add_row(random.next() % 4 == 0 ? infinity : cost());
    for (std::size_t column = 0; column < columns; ++column)
      if (random.next() % 2 == 0) costs.add(column, random.next() % 8 == 0 ? infinity : cost() - 1.0);
  }
  return costs;
}

/// The first of the cheapest assignments, by trying all.
struct Tried {
  std::vector<std::size_t> columns;
  double cost = infinity;
};
void try_all(const Choices& costs, std::vector<std::size_t>& taken, double cost, Tried& best) {
  if (taken.size() == costs.rows()) {
    if (cost < best.cost) best = {taken, cost};
    return;
  }
  const std::size_t row = taken.size();
  const auto entries = costs.entries(row);
  for (std::size_t k = 0; k <= entries.size(); ++k) {
    const std::size_t column = k < entries.size() ? entries.index(k) : none;
    if (column != none && std::find(taken.begin(), taken.end(), column) != taken.end()) continue;
    taken.push_back(column);
    try_all(costs, taken, cost + (column == none ? costs.none(row) : entries.value(k)), best);
    taken.pop_back();
  }
}

PROPERTY(Assignment, IsTheFirstOfTheCheapest) {
  const auto rows = any_size(), columns = any_size();
  const Choices costs = any([&](rc::Random& random) { return any_costs(random, rows, columns, 3); });
  Tried best;
  std::vector<std::size_t> taken;
  try_all(costs, taken, 0.0, best);
  if (best.cost == infinity) {
    RC_ASSERT_THROWS_AS(assign(costs), std::domain_error);
    return;
  }
  const Assignment found = assign(costs);
  RC_ASSERT(found.columns == best.columns);
  RC_ASSERT(found.cost == best.cost);
}

/// The least cost by Boost's minimum cost flow of as many units as there are rows.
long cost_by_flow(const Choices& costs) {
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Edge = boost::property<boost::edge_capacity_t, long,
                               boost::property<boost::edge_residual_capacity_t, long,
                                               boost::property<boost::edge_reverse_t, Traits::edge_descriptor,
                                                               boost::property<boost::edge_weight_t, long>>>>;
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Edge>;
  const std::size_t rows = costs.rows(), columns = costs.columns(), from = rows + columns, to = from + 1;
  Graph graph(to + 1);
  const auto link = [&](std::size_t a, std::size_t b, double cost) {
    if (cost == infinity) return;
    const auto there = add_edge(a, b, graph).first, back = add_edge(b, a, graph).first;
    const long units = static_cast<long>(cost) + 1;  // one more for each row, since −1 occurs
    put(boost::edge_capacity, graph, there, 1), put(boost::edge_capacity, graph, back, 0);
    put(boost::edge_weight, graph, there, units), put(boost::edge_weight, graph, back, -units);
    put(boost::edge_reverse, graph, there, back), put(boost::edge_reverse, graph, back, there);
  };
  for (std::size_t row = 0; row < rows; ++row) {
    link(from, row, -1.0);
    link(row, to, costs.none(row));
    const auto entries = costs.entries(row);
    for (std::size_t k = 0; k < entries.size(); ++k) link(row, rows + entries.index(k), entries.value(k));
  }
  for (std::size_t column = 0; column < columns; ++column) link(rows + column, to, -1.0);
  successive_shortest_path_nonnegative_weights(graph, from, to);
  return find_flow_cost(graph) - static_cast<long>(rows);
}

TEST(Assignment, CostsWhatFlowsCost) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    rc::Random random(seed);
    const Choices costs = any_costs(random, 1 + seed % 40, 1 + seed % 31, 1000);
    try {
      EXPECT_EQ(assign(costs).cost, static_cast<double>(cost_by_flow(costs))) << seed;
      ++compared;
    } catch (const std::domain_error&) {
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Assignment, NamesTheRowThatFindsNothing) {
  Choices costs;
  costs.add_row(infinity, {{0, 1.0}});
  costs.add_row(2.0, {{0, 1.0}});
  EXPECT_EQ(assign(costs).columns, (std::vector<std::size_t>{0, none}));
  costs.add_row(infinity, {{0, 1.0}, {1, infinity}});
  EXPECT_REFUSED(std::domain_error, ("row 2"), assign(costs));
  EXPECT_EQ(assign(Choices{}).cost, 0.0);
}

TEST(Assignment, RefusesWhatIsNoCost) {
  Choices costs;
  EXPECT_INVALID(("no row"), costs.add(0, 1.0));
  EXPECT_INVALID(("row 0", "ascend", "1 follows 1"), costs.add_row(0.0, {{1, 0.0}, {1, 0.0}}));
  costs.add_row(0.0, {{3, not_a_number}});
  EXPECT_INVALID(("cost", "row 1", "column 3", "nan"), assign(costs));
  costs.clear();
  costs.add_row(-infinity);
  EXPECT_INVALID(("cost", "row 0", "no column", "-inf"), assign(costs));
}

}  // namespace assignment_test
