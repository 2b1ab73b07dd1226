#pragma once

#include <set>
#include <vector>

#include <sigmax/core/scaled_number.hpp>
#include <sigmax/core/tie.hpp>

#include "../algebras.hpp"
#include "../alternating_paths.hpp"
#include "event_chain.hpp"

namespace sigmax::detail {

/// As logarithms: the ⊕ of all events, divided by the weight of the best; for each entry, then for no column of each
/// row, the ⊕ of the events with that choice, normalised in the row.
struct EventTotals {
  double log_total;
  std::vector<double> log_marginals;
};

/// ⊕ of an algebra for numbers without bounds.
template <class A>
struct Plus {
  A algebra;
  void operator()(ScaledNumber& sum, ScaledNumber number) const {
    sum = ScaledNumber::plus(sum, number, [this](double a, double b) { return algebra.plus(a, b); });
  }
};

/// The two eliminations of a chain of events: the permutation's at joints, the pattern's elsewhere.
template <class Outer, class Inner>
class Elimination {
 public:
  Elimination(const EventChain& chain, std::vector<ScaledNumber> weights, const std::vector<bool>& in_best, Outer outer,
              Inner inner, bool selects)
      : chain_(chain),
        weights_(std::move(weights)),
        in_best_(in_best),
        outer_{outer},
        inner_{inner},
        selects_(selects) {
    const std::size_t links = chain.links().size() - 1;
    states_.resize(links + 1);
    states_[0] = {ScaledNumber(1.0)};
    at_joint_.resize(links);
    chosen_.resize(links);
    for (std::size_t t = 0; t < links; ++t) forward(t, no_column);
  }

  ScaledNumber total() const { return states_.back().empty() ? ScaledNumber() : states_.back()[0]; }

  /// ⊕ over the events with each choice: where the permutation was eliminated by selection, over those selected.
  std::vector<ScaledNumber> marginals() const {
    std::vector<ScaledNumber> result(weights_.size()), behind{ScaledNumber(1.0)}, before;
    for (std::size_t t = at_joint_.size(); t-- > 0;) {
      before.assign(states_[t].size(), {});
      const auto ways = chain_.ways(t);
      const auto joints = chain_.joints(t);
      for (std::uint32_t w = 0; w < ways.size(); ++w) {
        const auto [from, choice, joint] = ways[w];
        if (selects_ && chosen_[t][joint] != w) continue;
        const ScaledNumber onwards = weights_[choice] * behind[joints[joint]];
        outer_(before[from], onwards);
        outer_(result[choice], states_[t][from] * onwards);
      }
      std::swap(before, behind);
    }
    return result;
  }

  /// The same by passes in which a row has one choice only: it suits any two algebras.
  std::vector<ScaledNumber> marginals_one_by_one() {
    std::vector<ScaledNumber> result(weights_.size());
    for (std::size_t t = at_joint_.size(); t-- > 0;) {
      std::set<std::uint32_t> choices;
      for (const auto& way : chain_.ways(t)) choices.insert(way.choice);
      for (const std::uint32_t choice : choices) {
        for (std::size_t next = t; next < at_joint_.size(); ++next) forward(next, next == t ? choice : no_column);
        result[choice] = total();
      }
      for (std::size_t next = t; next < at_joint_.size(); ++next) forward(next, no_column);
    }
    return result;
  }

 private:
  void forward(std::size_t t, std::size_t only) {
    const auto ways = chain_.ways(t);
    const auto joints = chain_.joints(t);
    std::vector<ScaledNumber>& at_joint = at_joint_[t];
    at_joint.assign(joints.size(), {});
    chosen_[t].assign(selects_ ? joints.size() : 0, 0);
    for (std::uint32_t w = 0; w < ways.size(); ++w) {
      const auto [from, choice, joint] = ways[w];
      if (only != no_column && choice != only) continue;
      const ScaledNumber number = states_[t][from] * weights_[choice];
      ScaledNumber& best = at_joint[joint];
      if (!selects_) {
        inner_(best, number);
        continue;
      }
      constexpr ScaledNumber more(1.0 + tie_tolerance);
      if (number > best * more || (in_best_[choice] && number * more >= best)) {
        best = number;
        chosen_[t][joint] = w;
      }
    }
    states_[t + 1].assign(chain_.links()[t].states, {});
    for (std::size_t joint = 0; joint < joints.size(); ++joint) outer_(states_[t + 1][joints[joint]], at_joint[joint]);
  }

  const EventChain& chain_;
  std::vector<ScaledNumber> weights_;
  const std::vector<bool>& in_best_;  // whether the best event has a choice
  Plus<Outer> outer_;
  Plus<Inner> inner_;
  bool selects_;
  std::vector<std::vector<ScaledNumber>> states_, at_joint_;
  std::vector<std::vector<std::uint32_t>> chosen_;  // the way to each joint that was selected
};

/// Exact, along a chain that keeps patterns if the algebras differ.
inline EventTotals eliminate(const EventChain& chain, const Choices& costs, const AlternatingPaths& paths,
                             const AnyAlgebra& pattern, const AnyAlgebra& permutation) {
  std::vector<ScaledNumber> weights(costs.size() + costs.rows());  // of the best event each is one
  std::vector<bool> in_best(weights.size());
  for (std::size_t row = 0; row < costs.rows(); ++row) {
    const double chosen = paths.cost(row);
    const auto entries = costs.entries(row);
    for (std::size_t k = 0; k < entries.size(); ++k) {
      weights[costs.offset(row) + k] = ScaledNumber::exp(chosen - entries.value(k));
      in_best[costs.offset(row) + k] = entries.index(k) == paths.choice(row);
    }
    weights[costs.size() + row] = ScaledNumber::exp(chosen - costs.none(row));
    in_best[costs.size() + row] = paths.choice(row) == no_column;
  }
  const bool differ = &pattern != &permutation, selects = differ && permutation.selective;
  return with_scaling(pattern, [&](auto outer) {
    return with_scaling(permutation, [&](auto inner) {
      Elimination elimination(chain, weights, in_best, outer, inner, selects);
      const Plus<decltype(outer)> plus{outer};
      EventTotals result{elimination.total().log(), {}};
      const std::vector<ScaledNumber> marginals =
          differ && !selects ? elimination.marginals_one_by_one() : elimination.marginals();
      for (const ScaledNumber number : marginals) result.log_marginals.push_back(number.log());
      for (std::size_t row = 0; row < costs.rows(); ++row) {
        const std::size_t first = costs.offset(row), end = first + costs.entries(row).size();
        ScaledNumber sum = marginals[costs.size() + row];
        for (std::size_t entry = first; entry < end; ++entry) plus(sum, marginals[entry]);
        const double log_sum = sum.log();
        for (std::size_t entry = first; entry < end; ++entry) result.log_marginals[entry] -= log_sum;
        result.log_marginals[costs.size() + row] -= log_sum;
      }
      return result;
    });
  });
}

}  // namespace sigmax::detail
