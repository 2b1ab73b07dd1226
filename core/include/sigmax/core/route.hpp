#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <sigmax/core/chain.hpp>

namespace sigmax {

/// A way through a chain of relations.
struct Route {
  std::vector<std::size_t> outcomes;  ///< of the start, and of every variable after it
  double log_value;                   ///< the logarithm of ⊗ over everything along the way
};

namespace detail {

/// The winners at every relation of a chain. Copies share them; appended winners never change.
class History {
 public:
  History() = default;
  History(const History&) = default;
  History(History&&) noexcept = default;
  History& operator=(History other) noexcept;
  ~History();

  void append(kernels::Winners winners);

  /// The outcomes of the best way to `last`, whose number is `value`.
  std::vector<std::size_t> path_to(std::size_t last, double value) const;

 private:
  struct Step;
  std::shared_ptr<Step> last_;
};

}  // namespace detail

/// A chain of a kind whose ⊕ selects that remembers which outcome won at every relation.
///
///     Routes routes{prior};
///     routes = update(compose(transition, std::move(routes)), report);   // as with a Chain
///     best_route(routes).outcomes;                                       // Viterbi's path
///
/// A verb that throws leaves the routes that were moved into it as they were.
template <Uncertainty Kind>
  requires SelectiveAlgebra<AlgebraOf<Kind>>
class Routes {
 public:
  using kind = Kind;
  using History = detail::History;

  explicit Routes(const Distribution<Kind>& start) : chain_(start) {}
  Routes(Chain<Kind> chain, History history, detail::ByLaw) : chain_(std::move(chain)), history_(std::move(history)) {}

  const Chain<Kind>& chain() const& { return chain_; }
  Chain<Kind> chain() && { return std::move(chain_); }
  Chain<Kind>& chain(detail::ByLaw) & { return chain_; }
  const History& history() const& { return history_; }
  History history() const&& { return history_; }

  /// The best way to one outcome of the current variable; on ties the first outcome, decided from the end backwards.
  Route to(std::size_t outcome) const {
    return {history_.path_to(outcome, chain_.row()[outcome].value()), chain_.log(outcome)};
  }

 private:
  Chain<Kind> chain_;
  History history_;
};

namespace detail {

template <Uncertainty Kind>
Routes<Kind> further(const Relation<Kind, Kind>& left, const Routes<Kind>& right, kernels::UnboundedRow room) {
  kernels::Winners winners;
  auto chain = further(left, right.chain(), std::move(room), &winners);
  auto history = right.history();
  history.append(std::move(winners));
  return {std::move(chain), std::move(history), ByLaw{}};
}

}  // namespace detail

/// The routes one relation further.
template <Uncertainty Kind>
Routes<Kind> compose(const Relation<Kind, Kind>& left, const Routes<Kind>& right) {
  return detail::further(left, right, {});
}
template <Uncertainty Kind>
Routes<Kind> compose(const Relation<Kind, Kind>& left, Routes<Kind>&& right) {
  return detail::further(left, right, right.chain(detail::ByLaw{}).take_room(detail::ByLaw{}));
}

/// The routes with evidence about their current outcome. Throws std::domain_error if that excludes every route; `prior`
/// is then as it was.
template <Uncertainty Kind>
Routes<Kind> update(Routes<Kind>&& prior, const Likelihood<Kind>& likelihood) {
  auto chain = update(std::move(prior.chain(detail::ByLaw{})), likelihood);
  return {std::move(chain), prior.history(), detail::ByLaw{}};
}
template <Uncertainty Kind>
Routes<Kind> update(const Routes<Kind>& prior, const Likelihood<Kind>& likelihood) {
  return update(Routes<Kind>{prior}, likelihood);
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
