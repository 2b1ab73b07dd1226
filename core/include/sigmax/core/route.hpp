#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/chain.hpp>

namespace sigmax {

/// A way through a chain of relations.
struct Route {
  std::vector<std::size_t> outcomes;  ///< of the start, and of every variable after it
  double log_value;                   ///< the logarithm of ⊗ over everything along the way
};

/// A chain of a kind whose ⊕ selects that remembers which outcome won at every relation.
///
///     Routes routes{prior};
///     routes = update(compose(transition, std::move(routes)), report);   // as with a Chain
///     best_route(routes).outcomes;                                       // Viterbi's path
template <Uncertainty Kind>
  requires SelectiveAlgebra<AlgebraOf<Kind>>
class Routes {
 public:
  using kind = Kind;

  explicit Routes(const Distribution<Kind>& start) : chain_(start) {}

  const Chain<Kind>& chain() const { return chain_; }
  Chain<Kind>& chain(detail::ByLaw) { return chain_; }

  /// Remembers from which outcome of the variable before each outcome is best reached.
  void remember(const std::vector<kernels::Winner>& winners, detail::ByLaw) {
    starts_.push_back(winners_.size());
    winners_.insert(winners_.end(), winners.begin(), winners.end());
  }

  /// The best way to one outcome of the current variable; on ties the first outcome, decided from the end backwards.
  Route to(std::size_t outcome) const {
    Route route{{outcome}, chain_.log(outcome)};
    for (std::size_t step = starts_.size(); step-- > 0;)
      route.outcomes.push_back(winners_[starts_[step] + route.outcomes.back()]);
    std::reverse(route.outcomes.begin(), route.outcomes.end());
    return route;
  }

 private:
  Chain<Kind> chain_;
  std::vector<std::size_t> starts_;  // of each relation's winners
  std::vector<kernels::Winner> winners_;
};

/// The routes one relation further.
template <Uncertainty Kind>
Routes<Kind> compose(const Relation<Kind, Kind>& left, Routes<Kind> right) {
  Chain<Kind>& chain = right.chain(detail::ByLaw{});
  check::same(left.from(), chain.variable(), "compose");
  std::vector<kernels::Winner> winners;
  auto row = std::move(chain.row(detail::ByLaw{}));
  std::visit([&](const auto& rows) { row.template compose<AlgebraOf<Kind>>(rows, winners); }, left.rows());
  chain = Chain<Kind>{left.to(), std::move(row)};
  right.remember(winners, detail::ByLaw{});
  return right;
}

/// The routes with evidence about their current outcome. Throws std::domain_error if that excludes every route.
template <Uncertainty Kind>
Routes<Kind> update(Routes<Kind> prior, const Likelihood<Kind>& likelihood) {
  prior.chain(detail::ByLaw{}) = update(std::move(prior.chain(detail::ByLaw{})), likelihood);
  return prior;
}

/// The best of all routes: the greatest ⊗ of start, relations and evidence along it. On a tie the one whose last
/// outcome comes first, then the one whose last but one does, and so on.
template <Uncertainty Kind>
Route best_route(const Routes<Kind>& routes) {
  return routes.to(routes.chain().winner());
}

/// The same through relations and evidence in the order in which they are passed.
///
///     best_route(prior, transition, report_1, transition, report_2)
template <Uncertainty Kind, class First, class... Rest>
Route best_route(const Distribution<Kind>& start, const First& first, const Rest&... rest) {
  Routes<Kind> routes{start};
  const auto append = [&]<class Link>(const Link& link) {
    if constexpr (std::same_as<Link, Likelihood<Kind>>)
      routes = update(std::move(routes), link);
    else
      routes = compose(link, std::move(routes));
  };
  append(first);
  (append(rest), ...);
  return best_route(routes);
}

}  // namespace sigmax
