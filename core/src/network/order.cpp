#include "order.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

namespace sigmax::elimination {
namespace {

/// The graph of variables that some factor joins, with the fill of each: the edges that its elimination would add.
/// Every change costs about as much as it changes.
class Interactions {
 public:
  explicit Interactions(const OrderProblem& problem) : around_(problem.sizes.size()), fill_(problem.sizes.size(), 0) {
    for (const auto& scope : problem.scopes) join_all(scope);
    changed_.clear();
  }

  const std::vector<Vertex>& around(Vertex v) const { return around_[v]; }
  std::size_t fill(Vertex v) const { return fill_[v]; }

  /// Joins the neighbours of `v` and takes it away. Returns the vertices whose fill or neighbours changed.
  std::vector<Vertex> eliminate(Vertex v) {
    const std::vector<Vertex> neighbours = around_[v];
    join_all(neighbours);
    for (const Vertex w : neighbours) {
      fill_[w] -= around_[w].size() - neighbours.size();  // the pairs of v and what v is not joined to
      around_[w].erase(std::lower_bound(around_[w].begin(), around_[w].end(), v));
      changed_.push_back(w);
    }
    around_[v].clear();
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    return std::exchange(changed_, {});
  }

 private:
  bool joined(Vertex a, Vertex b) const { return std::binary_search(around_[a].begin(), around_[a].end(), b); }

  void join_all(const std::vector<Vertex>& scope) {
    for (std::size_t i = 0; i < scope.size(); ++i)
      for (std::size_t j = i + 1; j < scope.size(); ++j)
        if (!joined(scope[i], scope[j])) join(scope[i], scope[j]);
  }

  void join(Vertex a, Vertex b) {
    if (around_[a].size() > around_[b].size()) std::swap(a, b);
    std::size_t common = 0;
    for (const Vertex c : around_[a])
      if (joined(b, c)) {
        ++common;
        --fill_[c];
        changed_.push_back(c);
      }
    for (const auto& [v, other] : {std::pair{a, b}, std::pair{b, a}}) {
      fill_[v] += around_[v].size() - common;
      around_[v].insert(std::lower_bound(around_[v].begin(), around_[v].end(), other), other);
      changed_.push_back(v);
    }
  }

  std::vector<std::vector<Vertex>> around_;  // ascending
  std::vector<std::size_t> fill_;
  std::vector<Vertex> changed_;
};

bool is_ranked(Role role) { return role == Role::eliminated || role == Role::kept; }

/// Innermost first, calls visit(c, all), all being the variables outside of `c` that are joined to it, be it through
/// what is within it.
template <class Visit>
void for_each_outside(const Interactions& graph, const std::vector<Role>& roles, const Visit& visit) {
  // What has been visited falls into parts that are joined, each with the variables outside of it.
  const std::size_t n = roles.size();
  std::vector<std::size_t> part(n, n);
  std::vector<std::set<Vertex>> outside(n);
  const auto root = [&part](Vertex v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  for (Vertex c = n; c-- > 0;) {
    if (!is_ranked(roles[c])) continue;
    part[c] = c;
    std::set<Vertex> all;
    for (const Vertex u : graph.around(c)) {
      if (!is_ranked(roles[u])) continue;
      if (u < c) {
        all.insert(u);
      } else if (const Vertex r = root(u); r != c) {
        if (outside[r].size() > all.size()) std::swap(outside[r], all);
        all.insert(outside[r].begin(), outside[r].end());
        outside[r].clear();
        part[r] = c;
      }
    }
    all.erase(c);
    visit(c, all);
    outside[c] = std::move(all);
  }
}

/// Which variables cannot be brought innermost: a variable of another kind within such a one, its blocker, is joined to
/// it, be it through variables within the blocker. A blocker blocks until it is eliminated itself.
class Blocking {
 public:
  Blocking(const Interactions& graph, const OrderProblem& problem, const std::vector<Role>& roles)
      : graph_(&graph), kinds_(&problem.kinds), roles_(&roles), blocked_(roles.size(), false), by_(roles.size()) {
    if (of_two_kinds(problem)) find_all();
  }

  bool blocked(Vertex v) const { return blocked_[v]; }

  /// After `v` was eliminated: the variables that are free now.
  std::vector<Vertex> freed_by(Vertex v) {
    std::vector<Vertex> freed;
    for (const Vertex u : std::exchange(by_[v], {}))
      if ((*roles_)[u] != Role::absent && !find(u)) freed.push_back(u);
    return freed;
  }

 private:
  bool ranked(Vertex v) const { return is_ranked((*roles_)[v]); }

  void block(Vertex u, Vertex by) {
    blocked_[u] = true;
    by_[by].push_back(u);
  }

  void find_all() {
    const std::size_t n = roles_->size();
    std::vector<Vertex> blocker(n, n);
    for_each_outside(*graph_, *roles_, [&](Vertex c, const std::set<Vertex>& outside) {
      for (const Vertex u : outside)
        if ((*kinds_)[u] != (*kinds_)[c]) blocker[u] = c;
    });
    for (Vertex u = 0; u < n; ++u)
      if (blocker[u] < n) block(u, blocker[u]);
  }

  /// Looks for a blocker of `u`: the path to each variable within u whose outermost variable is as far within as can
  /// be.
  bool find(Vertex u) {
    blocked_[u] = false;
    std::priority_queue<std::pair<Vertex, Vertex>> open;  // outermost of the path, its end
    std::set<Vertex> seen;
    const auto extend = [&](Vertex from, Vertex outermost) {
      for (const Vertex x : graph_->around(from))
        if (x > u && ranked(x) && !seen.contains(x)) open.push({std::min(outermost, x), x});
    };
    extend(u, roles_->size());
    while (!open.empty()) {
      const auto [outermost, x] = open.top();
      open.pop();
      if (!seen.insert(x).second) continue;
      if (outermost == x && (*kinds_)[x] != (*kinds_)[u]) {
        block(u, x);
        return true;
      }
      extend(x, outermost);
    }
    return false;
  }

  const Interactions* graph_;
  const std::vector<std::size_t>* kinds_;
  const std::vector<Role>* roles_;
  std::vector<bool> blocked_;
  std::vector<std::vector<Vertex>> by_;  // whom each is known to block
};

/// The variables that are left, by fill, then by table, then innermost first.
class Candidates {
 public:
  Candidates(const Interactions& graph, const std::vector<std::size_t>& sizes)
      : graph_(&graph), sizes_(&sizes), keys_(sizes.size()) {}

  struct Key {
    std::size_t fill = 0;
    double table = 0.0;  // the outcomes that the elimination ranges over; of no candidate zero
    Vertex v = 0;
    bool operator<(const Key& other) const {
      return std::tie(fill, table, other.v) < std::tie(other.fill, other.table, v);
    }
  };

  bool empty() const { return order_.empty(); }
  bool contains(Vertex v) const { return keys_[v].table > 0.0; }
  void insert(Vertex v) {
    double table = static_cast<double>((*sizes_)[v]);
    for (const Vertex u : graph_->around(v)) table *= static_cast<double>((*sizes_)[u]);
    order_.insert(keys_[v] = {graph_->fill(v), table, v});
  }
  void erase(Vertex v) { order_.erase(std::exchange(keys_[v], {})); }
  const Key& first() const { return *order_.begin(); }

 private:
  const Interactions* graph_;
  const std::vector<std::size_t>* sizes_;
  std::vector<Key> keys_;
  std::set<Key> order_;
};

}  // namespace

bool of_two_kinds(const OrderProblem& problem) {
  const std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t first = none;
  for (Vertex v = 0; v < problem.roles.size(); ++v) {
    if (!is_ranked(problem.roles[v])) continue;
    if (first != none && first != problem.kinds[v]) return true;
    first = problem.kinds[v];
  }
  return false;
}

std::vector<bool> can_be_last(const OrderProblem& problem) {
  const std::size_t n = problem.roles.size();
  std::vector<bool> can(n);
  for (Vertex v = 0; v < n; ++v) can[v] = problem.roles[v] == Role::eliminated;
  std::vector<std::vector<Vertex>> followers(n);  // of its own kind, that cannot be last if it cannot
  const Interactions graph(problem);
  for_each_outside(graph, problem.roles, [&](Vertex c, const std::set<Vertex>& outside) {
    for (const Vertex u : outside) {
      if (problem.kinds[u] == problem.kinds[c])
        followers[u].push_back(c);
      else
        can[c] = false;
    }
  });
  for (Vertex u = 0; u < n; ++u)  // outermost first
    if (!can[u])
      for (const Vertex c : followers[u]) can[c] = false;
  return can;
}

Order order_of_elimination(const OrderProblem& problem) {
  Order order;
  Interactions graph(problem);
  std::vector<Role> roles = problem.roles;
  Blocking blocking(graph, problem, roles);
  Candidates free(graph, problem.sizes), blocked(graph, problem.sizes);
  for (Vertex v = 0; v < roles.size(); ++v)
    if (roles[v] == Role::eliminated) (blocking.blocked(v) ? blocked : free).insert(v);
  while (!free.empty()) {
    const auto [fill, outcomes, v] = free.first();
    if (!blocked.empty() && blocked.first().fill < fill) order.forced = true;
    order.vertices.push_back(v);
    if (outcomes > order.greatest_table) {
      order.greatest_table = outcomes;
      order.greatest_scope = graph.around(v);
      order.greatest_scope.push_back(v);
    }
    free.erase(v);
    const std::vector<Vertex> changed = graph.eliminate(v);
    roles[v] = Role::absent;
    for (const Vertex u : changed)
      for (Candidates* const candidates : {&free, &blocked})
        if (candidates->contains(u)) candidates->erase(u), candidates->insert(u);
    for (const Vertex u : blocking.freed_by(v))
      if (blocked.contains(u)) blocked.erase(u), free.insert(u);
  }
  order.complete = blocked.empty();
  return order;
}

}  // namespace sigmax::elimination
