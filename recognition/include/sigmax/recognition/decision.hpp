#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include <sigmax/core/belief.hpp>
#include <sigmax/core/tie.hpp>

namespace sigmax {

/// The greatest of some values but that at `index`; zero if there is no other. Of possibilities, 1 less it is the
/// necessity N({index}).
template <class Values>
double greatest_other(const Values& values, std::size_t index) {
  double greatest = 0.0;
  for (std::size_t c = 0; c < values.size(); ++c)
    if (c != index) greatest = std::max(greatest, values[c]);
  return greatest;
}

/// What a belief is decided for.
struct Decision {
  std::size_t pattern;  ///< the winner
  double margin;        ///< how far it leads; for possibilities its necessity N({winner})
  std::size_t tied;     ///< how many patterns are as good, itself included: 1 if the winner is alone
};

/// The maximum a posteriori pattern: of those whose logarithm is within `tie_tolerance` of the greatest, the first.
///
/// Its margin is its own value less the greatest of the others: p(winner) − p(second), or, as the winner of a
/// possibility is one, 1 − π(second) = N({winner}). It is zero on a tie, and of a lone pattern its value, one.
template <Uncertainty Kind>
Decision decide(const Belief<Kind>& belief) {
  const std::size_t pattern = first_of_tied(belief.logs());
  const double greatest = belief.log(index_of_greatest(belief.logs()));
  const auto tied = static_cast<std::size_t>(std::count_if(belief.logs().begin(), belief.logs().end(),
                                                           [greatest](double log) { return ties(log, greatest); }));
  return {pattern, tied == 1 ? belief[pattern] - greatest_other(belief, pattern) : 0.0, tied};
}

/// How far a belief is right: 1 if the truth alone is the most likely pattern, 1/n if it is one of n that tie, else 0.
template <Uncertainty Kind>
double credit(const Belief<Kind>& belief, std::size_t truth) {
  const Decision best = decide(belief);
  return ties(belief.log(truth), belief.log(best.pattern)) ? 1.0 / static_cast<double>(best.tied) : 0.0;
}

/// The decision, or nothing if the margin is below `least_margin`: the reject option, by necessity or by posterior
/// margin.
template <Uncertainty Kind>
std::optional<Decision> decide_or_reject(const Belief<Kind>& belief, double least_margin) {
  const Decision decision = decide(belief);
  if (decision.margin < least_margin) return std::nullopt;
  return decision;
}

/// The k best patterns, best first; of equal ones, to within `tie_tolerance` of the better, the first declared is the
/// better. All of them if there are not as many.
template <Uncertainty Kind>
std::vector<std::size_t> best_patterns(const Belief<Kind>& belief, std::size_t k) {
  std::vector<std::size_t> order(belief.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return belief.log(a) > belief.log(b); });
  // Runs of equal weights, each measured from its best, go in the order of declaration.
  for (auto first = order.begin(); first != order.end();) {
    const double greatest = belief.log(*first);
    const auto last = std::find_if(first, order.end(), [&](std::size_t c) { return !ties(belief.log(c), greatest); });
    std::sort(first, last);
    first = last;
  }
  order.resize(std::min(k, order.size()));
  return order;
}

}  // namespace sigmax
