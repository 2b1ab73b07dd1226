#include "order.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/depth_first_search.hpp>

namespace sigmax::elimination {
namespace {

/// Two variables are joined if some factor has both.
using Interactions = boost::adjacency_list<boost::setS, boost::vecS, boost::undirectedS>;

auto neighbours(const Interactions& graph, Vertex v) {
  const auto [first, last] = boost::adjacent_vertices(v, graph);
  return std::vector<Vertex>(first, last);
}

Interactions interactions(const OrderProblem& problem) {
  Interactions graph(problem.sizes.size());
  for (const auto& scope : problem.scopes)
    for (std::size_t i = 0; i < scope.size(); ++i)
      for (std::size_t j = i + 1; j < scope.size(); ++j) boost::add_edge(scope[i], scope[j], graph);
  return graph;
}

/// Edges that eliminating `v` would add; counting stops where they exceed `enough`.
std::size_t fill(const Interactions& graph, Vertex v, std::size_t enough) {
  const auto around = neighbours(graph, v);
  std::size_t count = 0;
  for (std::size_t i = 0; i < around.size(); ++i)
    for (std::size_t j = i + 1; j < around.size(); ++j) {
      if (!boost::edge(around[i], around[j], graph).second) ++count;
      if (count > enough) return count;
    }
  return count;
}

double table_of(const Interactions& graph, const std::vector<std::size_t>& sizes, Vertex v) {
  auto outcomes = static_cast<double>(sizes[v]);
  for (const Vertex u : neighbours(graph, v)) outcomes *= static_cast<double>(sizes[u]);
  return outcomes;
}

/// Which variables cannot be brought innermost, for one of another kind within them is joined to them, be it through
/// variables within that one.
std::vector<bool> blocked(const Interactions& graph, const OrderProblem& problem, const std::vector<Role>& roles) {
  const auto ranked = [&](Vertex v) { return roles[v] == Role::eliminated || roles[v] == Role::kept; };
  std::vector<bool> result(roles.size(), false);
  std::vector<Vertex> seen_from(roles.size(), roles.size());
  std::vector<Vertex> open;
  for (Vertex c = roles.size(); c-- > 0;) {
    if (!ranked(c)) continue;
    open.assign(1, c);
    seen_from[c] = c;
    while (!open.empty()) {
      const Vertex w = open.back();
      open.pop_back();
      const auto [first, last] = boost::adjacent_vertices(w, graph);
      for (auto u = first; u != last; ++u) {
        if (!ranked(*u) || seen_from[*u] == c) continue;
        if (*u < c) {
          if (problem.fuzzy[*u] != problem.fuzzy[c]) result[*u] = true;
          continue;
        }
        seen_from[*u] = c;
        open.push_back(*u);
      }
    }
  }
  return result;
}

bool of_two_kinds(const OrderProblem& problem) {
  std::optional<bool> first;
  for (Vertex v = 0; v < problem.roles.size(); ++v) {
    if (problem.roles[v] != Role::eliminated && problem.roles[v] != Role::kept) continue;
    if (first && *first != problem.fuzzy[v]) return true;
    first = problem.fuzzy[v];
  }
  return false;
}

}  // namespace

Order order_of_elimination(const OrderProblem& problem) {
  Order order;
  Interactions graph = interactions(problem);
  std::vector<Role> roles = problem.roles;
  const bool mixed = of_two_kinds(problem);
  while (true) {
    const std::vector<bool> forbidden = mixed ? blocked(graph, problem, roles) : std::vector<bool>(roles.size(), false);
    struct Choice {
      std::optional<Vertex> vertex;
      std::size_t fill = std::numeric_limits<std::size_t>::max();
      double table = std::numeric_limits<double>::infinity();
    };
    Choice allowed, any;
    const auto consider = [&](Choice& best, Vertex v) {
      const std::size_t f = fill(graph, v, best.fill);
      if (f > best.fill) return;
      const double t = table_of(graph, problem.sizes, v);
      if (f < best.fill || t < best.table) best = {v, f, t};
    };
    for (Vertex v = roles.size(); v-- > 0;) {
      if (roles[v] != Role::eliminated) continue;
      if (!forbidden[v]) consider(allowed, v);
      if (mixed) consider(any, v);
    }
    if (!allowed.vertex) {
      order.complete = !any.vertex;
      break;
    }
    if (mixed && any.fill < allowed.fill) order.forced = true;
    const Vertex v = *allowed.vertex;
    order.vertices.push_back(v);
    order.greatest_table = std::max(order.greatest_table, allowed.table);
    const auto around = neighbours(graph, v);
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = i + 1; j < around.size(); ++j) boost::add_edge(around[i], around[j], graph);
    boost::clear_vertex(v, graph);
    roles[v] = Role::absent;
  }
  double left = 1.0;
  for (Vertex v = 0; v < roles.size(); ++v)
    if (roles[v] != Role::absent) left *= static_cast<double>(problem.sizes[v]);
  order.greatest_table = std::max(order.greatest_table, left);
  return order;
}

std::vector<Vertex> parents_first(const std::vector<std::vector<Vertex>>& parents,
                                  const std::function<void(Vertex child, Vertex parent)>& on_cycle) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
  Graph graph(parents.size());
  for (Vertex child = 0; child < parents.size(); ++child)
    for (const Vertex parent : parents[child]) boost::add_edge(child, parent, graph);

  struct Visitor : boost::default_dfs_visitor {
    Visitor(std::vector<Vertex>& order, const std::function<void(Vertex, Vertex)>& on_cycle)
        : order_(&order), on_cycle_(&on_cycle) {}
    void back_edge(const Graph::edge_descriptor& edge, const Graph& g) const {
      (*on_cycle_)(boost::source(edge, g), boost::target(edge, g));
    }
    void finish_vertex(Vertex v, const Graph&) const { order_->push_back(v); }
    std::vector<Vertex>* order_;
    const std::function<void(Vertex, Vertex)>* on_cycle_;
  };
  std::vector<Vertex> order;
  boost::depth_first_search(graph, boost::visitor(Visitor(order, on_cycle)));
  return order;
}

}  // namespace sigmax::elimination
