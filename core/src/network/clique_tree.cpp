#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "exponents.hpp"
#include "solve.hpp"

namespace sigmax::elimination {
namespace {

/// Rank of a variable in the order of elimination.
using Place = std::size_t;

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

struct Clique {
  std::vector<Place> scope;          // ascending: who goes first varies slowest
  std::size_t own;                   // how many of the first of the scope no clique after it has
  std::size_t parent = none;         // the clique that has all the others, its separator: it comes later
  std::vector<std::size_t> factors;  // that are in no other clique
  std::vector<std::size_t> children;

  std::span<const Place> separator() const { return std::span(scope).subspan(own); }
};

struct Tree {
  std::vector<std::size_t> sizes;           // by place
  std::vector<std::vector<Place>> factors;  // the scope of each, as it has it
  std::vector<Clique> cliques;              // children before parents
};

/// The maximal cliques of the elimination.
Tree tree_of(const std::vector<Factor>& factors, const std::vector<Vertex>& order,
             const std::vector<std::size_t>& sizes) {
  const std::size_t n = order.size();
  Tree tree;
  std::vector<Place> place(sizes.size(), n);
  for (Place k = 0; k < n; ++k) {
    place[order[k]] = k;
    tree.sizes.push_back(sizes[order[k]]);
  }
  std::vector<std::vector<Place>> reach(n);  // of each elimination, ascending
  for (Place k = 0; k < n; ++k) reach[k] = {k};
  std::vector<Place> both;
  const auto include = [&](Place k, std::span<const Place> scope) {
    both.clear();
    std::set_union(reach[k].begin(), reach[k].end(), scope.begin(), scope.end(), std::back_inserter(both));
    std::swap(reach[k], both);
  };
  std::vector<Place> ascending;
  for (const Factor& factor : factors) {
    auto& scope = tree.factors.emplace_back();
    for (const Vertex v : factor.scope) scope.push_back(place[v]);
    ascending = scope;
    std::sort(ascending.begin(), ascending.end());
    if (!scope.empty()) include(ascending.front(), ascending);
  }
  for (Place k = 0; k < n; ++k)
    if (reach[k].size() > 1) include(reach[k][1], std::span(reach[k]).subspan(1));

  // An elimination that has all that is left of one before it belongs to the clique of that.
  std::vector<Place> first(n);
  std::vector<bool> joins(n, false);
  std::vector<std::size_t> clique_of(n);
  for (Place k = 0; k < n; ++k) {
    if (!joins[k]) first[k] = k;
    if (reach[k].size() > 1) {
      const Place next = reach[k][1];
      if (!joins[next] && reach[next].size() + 1 == reach[k].size()) {
        joins[next] = true;
        first[next] = first[k];
        continue;
      }
    }
    Clique clique{reach[first[k]], 1 + reach[first[k]].size() - reach[k].size(), none, {}, {}};
    for (std::size_t i = 0; i < clique.own; ++i) clique_of[clique.scope[i]] = tree.cliques.size();
    tree.cliques.push_back(std::move(clique));
  }
  for (std::size_t c = 0; c < tree.cliques.size(); ++c) {
    if (tree.cliques[c].separator().empty()) continue;
    tree.cliques[c].parent = clique_of[tree.cliques[c].separator().front()];
    tree.cliques[tree.cliques[c].parent].children.push_back(c);
  }
  for (std::size_t f = 0; f < factors.size(); ++f) {
    const auto& scope = tree.factors[f];
    if (!scope.empty()) tree.cliques[clique_of[*std::min_element(scope.begin(), scope.end())]].factors.push_back(f);
  }
  return tree;
}

std::size_t outcomes_of(std::span<const Place> scope, const Tree& tree) {
  return elimination::outcomes_of(scope, tree.sizes);
}

/// How a part of a scope, in any order, lies in it.
class Walk {
 public:
  void prepare(std::span<const Place> scope, std::span<const Place> part, const Tree& tree) {
    extents_.clear();
    for (std::size_t i = scope.size(); i-- > 0;) {
      const auto found = std::find(part.begin(), part.end(), scope[i]);
      const std::size_t step =
          found == part.end() ? 0 : outcomes_of(part.subspan(static_cast<std::size_t>(found - part.begin()) + 1), tree);
      if (extents_.empty() || step != extents_.back().step * extents_.back().count) extents_.push_back({1, step, 0});
      extents_.back().count *= tree.sizes[scope[i]];
    }
  }

  /// Calls visit(index in the scope, index in the part, count, step in the part) for every run of the scope.
  template <class Visit>
  void operator()(const Visit& visit) {
    const auto [run, run_step, unused] = extents_.front();
    for (std::size_t at = 0, in_part = 0;; at += run) {
      visit(at, in_part, run, run_step);
      std::size_t d = 1;
      for (; d < extents_.size(); ++d) {
        auto& [count, step, digit] = extents_[d];
        in_part += step;
        if (++digit < count) break;
        in_part -= step * count;
        digit = 0;
      }
      if (d == extents_.size()) return;
    }
  }

 private:
  struct Extent {
    std::size_t count, step, digit;
  };
  std::vector<Extent> extents_;  // neighbours that go along, fastest first
};

/// Doubles, in units of a power of two for each table.
template <ScalingAlgebra A>
struct Plain {
  using Number = double;
  static constexpr std::int64_t deepest = 900;  // no product below 2^-900 of its unit

  template <class AnyNumber>
  static detail::Exponents range(const std::vector<AnyNumber>& numbers) {
    return detail::exponents_of(numbers);
  }
  static void scale(std::span<double> numbers, std::int64_t unit) {
    if (unit == 0) return;
    const double factor = std::ldexp(1.0, static_cast<int>(-unit));
    for (double& number : numbers) number *= factor;
  }
  static double load(ScaledNumber number, std::int64_t unit) { return number.normal_value_in_units_of(unit); }
  static ScaledNumber number(double value) { return ScaledNumber{value}; }
  static double plus(double a, double b) { return A::plus(a, b); }
  static double over(double a, double b) { return b == 0.0 ? 0.0 : a / b; }
};

/// Numbers with an exponent each.
template <ScalingAlgebra A>
struct Unbounded {
  using Number = ScaledNumber;
  static constexpr std::int64_t deepest = std::numeric_limits<std::int64_t>::max();

  static detail::Exponents range(const std::vector<ScaledNumber>&) { return {}; }
  static void scale(std::span<ScaledNumber>, std::int64_t) {}
  static ScaledNumber load(ScaledNumber number, std::int64_t) { return number; }
  static ScaledNumber number(ScaledNumber value) { return value; }
  static ScaledNumber plus(ScaledNumber a, ScaledNumber b) { return ScaledNumber::plus<A>(a, b); }
  static ScaledNumber over(ScaledNumber a, ScaledNumber b) {
    if (b.is_zero()) return b;
    return ScaledNumber{a.normal_value_in_units_of(a.exponent()) / b.normal_value_in_units_of(b.exponent()),
                        a.exponent() - b.exponent()};
  }
};

/// ⊕ of neighbouring numbers, in four strands.
template <class Arithmetic, class Number>
Number sum(const Number* numbers, std::size_t count) {
  Number strands[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (std::size_t s = 0; s < 4; ++s) strands[s] = Arithmetic::plus(strands[s], numbers[i + s]);
  for (; i < count; ++i) strands[0] = Arithmetic::plus(strands[0], numbers[i]);
  return Arithmetic::plus(Arithmetic::plus(strands[0], strands[1]), Arithmetic::plus(strands[2], strands[3]));
}

/// The two passes in one kind of arithmetic.
template <class Arithmetic>
class Passes {
 public:
  using Number = typename Arithmetic::Number;

  Passes(const Tree& tree, const std::vector<Factor>& factors) : tree_(&tree), factors_(&factors) {
    beliefs_.resize(tree.cliques.size());
    messages_.resize(tree.cliques.size());
    depths_.resize(tree.cliques.size(), 0);
  }

  /// The total, or nothing if the range does not suffice.
  std::optional<ScaledNumber> collect() {
    ScaledNumber total{1.0};
    for (std::size_t f = 0; f < factors_->size(); ++f)
      if (tree_->factors[f].empty()) total = total * (*factors_)[f].values.front();
    for (std::size_t c = 0; c < tree_->cliques.size(); ++c) {
      const Clique& clique = tree_->cliques[c];
      auto& belief = beliefs_[c];
      belief.assign(outcomes_of(clique.scope, *tree_), Number{1.0});
      for (const std::size_t f : clique.factors) {
        const auto& values = (*factors_)[f].values;
        const auto [unit, depth] = Arithmetic::range(values);
        if (!fits(c, depth)) return {};
        part_.clear();
        for (const ScaledNumber value : values) part_.push_back(Arithmetic::load(value, unit));
        multiply(c, tree_->factors[f], part_);
        total = total * ScaledNumber{1.0, unit};
      }
      for (const std::size_t child : clique.children) multiply(c, tree_->cliques[child].separator(), messages_[child]);
      // The separator varies fastest, so every own outcome adds a row to the message.
      auto& message = messages_[c];
      message.assign(outcomes_of(clique.separator(), *tree_), Number{});
      for (std::size_t row = 0; row < belief.size(); row += message.size())
        add(message.data(), belief.data() + row, message.size());
      const auto [unit, depth] = Arithmetic::range(message);
      if (clique.parent != none && !fits(clique.parent, depth)) return {};
      Arithmetic::scale(message, unit);
      total = total * ScaledNumber{1.0, unit};
      if (clique.parent == none) total = total * Arithmetic::number(message.front());
    }
    return total;
  }

  /// The marginals by place, or nothing.
  std::optional<std::vector<std::vector<ScaledNumber>>> distribute(ScaledNumber total) {
    std::vector<std::vector<ScaledNumber>> marginals(tree_->sizes.size());
    for (std::size_t c = tree_->cliques.size(); c-- > 0;) {
      const Clique& clique = tree_->cliques[c];
      if (clique.parent != none) {
        project(clique.parent, clique.separator());
        for (std::size_t i = 0; i < part_.size(); ++i) part_[i] = Arithmetic::over(part_[i], messages_[c][i]);
        const auto [unit, depth] = Arithmetic::range(part_);
        if (!fits(c, depth)) return {};
        Arithmetic::scale(part_, unit);
        multiply(c, clique.separator(), part_);
      }
      read_marginals(c, total, marginals);
    }
    return marginals;
  }

 private:
  static void add(Number* to, const Number* numbers, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) to[i] = Arithmetic::plus(to[i], numbers[i]);
  }

  /// Whether a factor of this range can be multiplied to the clique.
  bool fits(std::size_t c, std::int64_t depth) { return (depths_[c] += depth) <= Arithmetic::deepest; }

  void multiply(std::size_t c, std::span<const Place> scope, const std::vector<Number>& factor) {
    walk_.prepare(tree_->cliques[c].scope, scope, *tree_);
    walk_([&](std::size_t at, std::size_t in_part, std::size_t count, std::size_t step) {
      Number* const to = beliefs_[c].data() + at;
      const Number* const by = factor.data() + in_part;
      const Number same = *by;
      if (step == 1)
        for (std::size_t i = 0; i < count; ++i) to[i] = to[i] * by[i];
      else if (step == 0)
        for (std::size_t i = 0; i < count; ++i) to[i] = to[i] * same;
      else
        for (std::size_t i = 0; i < count; ++i) to[i] = to[i] * by[i * step];
    });
  }

  /// ⊕ of the clique over all but `scope`, which is ascending, into `part_`.
  void project(std::size_t c, std::span<const Place> scope) {
    walk_.prepare(tree_->cliques[c].scope, scope, *tree_);
    part_.assign(outcomes_of(scope, *tree_), Number{});
    walk_([&](std::size_t at, std::size_t in_part, std::size_t count, std::size_t step) {
      const Number* const from = beliefs_[c].data() + at;
      if (step == 1)
        add(part_.data() + in_part, from, count);
      else
        part_[in_part] = Arithmetic::plus(part_[in_part], sum<Arithmetic>(from, count));
    });
  }

  /// Those of the variables that no later clique has.
  void read_marginals(std::size_t c, ScaledNumber total, std::vector<std::vector<ScaledNumber>>& marginals) {
    const Clique& clique = tree_->cliques[c];
    const std::span own = std::span(clique.scope).first(clique.own);
    project(c, own);
    const Number all = sum<Arithmetic>(part_.data(), part_.size());
    std::size_t inner = part_.size();
    for (const Place k : own) {
      const std::size_t size = tree_->sizes[k];
      inner /= size;
      std::vector<Number> marginal(size);
      for (std::size_t at = 0; at < part_.size(); at += inner) {
        Number& entry = marginal[at / inner % size];
        entry = Arithmetic::plus(entry, sum<Arithmetic>(part_.data() + at, inner));
      }
      marginals[k].reserve(size);
      for (const Number entry : marginal)
        marginals[k].push_back(total * Arithmetic::number(Arithmetic::over(entry, all)));
    }
  }

  const Tree* tree_;
  const std::vector<Factor>* factors_;
  std::vector<std::vector<Number>> beliefs_;   // by clique
  std::vector<std::vector<Number>> messages_;  // to its parent, over its separator
  std::vector<std::int64_t> depths_;           // how far below its unit a number of the belief can be
  std::vector<Number> part_;
  Walk walk_;
};

template <class Arithmetic>
std::optional<Calibrated> calibrated_by(const Tree& tree, const std::vector<Factor>& factors,
                                        const std::vector<Vertex>& order, std::size_t vertices) {
  Passes<Arithmetic> passes(tree, factors);
  const auto total = passes.collect();
  if (!total) return {};
  Calibrated result{std::vector<std::vector<ScaledNumber>>(vertices), *total};
  if (total->is_zero()) return result;
  auto marginals = passes.distribute(*total);
  if (!marginals) return {};
  for (Place k = 0; k < order.size(); ++k) result.marginals[order[k]] = std::move((*marginals)[k]);
  return result;
}

}  // namespace

Calibrated calibrated(const RelationNetwork& network, const std::vector<Factor>& factors,
                      const std::vector<Vertex>& order) {
  if (order.empty())
    return {std::vector<std::vector<ScaledNumber>>(network.size()), product(factors, {}, {}).values[0]};
  const Tree tree = tree_of(factors, order, sizes_of(network));
  return with_algebra_of(network[order.front()].variable, [&]<class A>(A) {
    auto result = calibrated_by<Plain<A>>(tree, factors, order, network.size());
    return result ? *std::move(result) : *calibrated_by<Unbounded<A>>(tree, factors, order, network.size());
  });
}

}  // namespace sigmax::elimination
