#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/successive_shortest_path_nonnegative_weights.hpp>

#include <boost/graph/find_flow_cost.hpp>  // after what it does not include

#include "laws/generate.hpp"

namespace alternating_paths_test {

/// Draws log weights that are integers, so that sums are exact and often tie.
Choices any_weights(rc::Random& random, std::size_t rows, std::size_t columns) {
  const auto log = [&] { return -static_cast<double>(random.next() % 1001); };
  Choices weights;
  for (std::size_t row = 0; row < rows; ++row) {
    weights.add_row(random.next() % 4 == 0 ? log_zero : log());
    for (std::size_t column = 0; column < columns; ++column)
      if (random.next() % 2 == 0) weights.add(column, random.next() % 8 == 0 ? log_zero : log() + 1.0);
  }
  return weights;
}

/// The least cost by Boost's minimum cost flow of as many units as there are rows. Its sums overflow integers.
long cost_by_flow(const Choices& weights) {
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Edge = boost::property<boost::edge_capacity_t, long,
                               boost::property<boost::edge_residual_capacity_t, long,
                                               boost::property<boost::edge_reverse_t, Traits::edge_descriptor,
                                                               boost::property<boost::edge_weight_t, double>>>>;
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, Edge>;
  const std::size_t rows = weights.rows(), columns = weights.columns(), from = rows + columns, to = from + 1;
  Graph graph(to + 1);
  const auto link = [&](std::size_t a, std::size_t b, double log) {
    if (log == log_zero) return;
    const auto there = add_edge(a, b, graph).first, back = add_edge(b, a, graph).first;
    const double units = 1.0 - log;  // one more for each row, since +1 occurs
    put(boost::edge_capacity, graph, there, 1), put(boost::edge_capacity, graph, back, 0);
    put(boost::edge_weight, graph, there, units), put(boost::edge_weight, graph, back, -units);
    put(boost::edge_reverse, graph, there, back), put(boost::edge_reverse, graph, back, there);
  };
  for (std::size_t row = 0; row < rows; ++row) {
    link(from, row, 1.0);
    link(row, to, weights.none(row));
    const auto entries = weights.entries(row);
    for (std::size_t k = 0; k < entries.size(); ++k) link(row, rows + entries.index(k), entries.value(k));
  }
  for (std::size_t column = 0; column < columns; ++column) link(rows + column, to, 1.0);
  successive_shortest_path_nonnegative_weights(graph, from, to);
  return find_flow_cost(graph) - static_cast<long>(rows);
}

TEST(AlternatingPaths, CostWhatFlowsCost) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    rc::Random random(seed);
    const Choices weights = any_weights(random, 1 + seed % 29, 1 + seed % 31);
    try {
      EXPECT_EQ((match<Fuzzy, Fuzzy>(weights, {.marginals = false}).log_best),
                -static_cast<double>(cost_by_flow(weights)))
          << seed;
      ++compared;
    } catch (const std::domain_error&) {
    }
  }
  EXPECT_GT(compared, 20);
}

}  // namespace alternating_paths_test
