#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>
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

namespace detail {

/// For every outcome the indices that attain it better than all before them, with what they attain: for a ⊗ that
/// selects, where a later minimum may make any of them a tie.
struct Attempts {
  static constexpr bool wanted = true;
  struct Attempt {
    kernels::Winner index;
    double value;
  };
  std::vector<std::vector<Attempt>> all;

  void assign(std::size_t size) { all.assign(size, {}); }
  struct OfRow {
    static constexpr bool wanted = true;
    Attempts* attempts;
    void note(std::size_t k, bool better, kernels::Winner index, double value) const {
      if (better) attempts->all[k].push_back({index, value});
    }
  };
  OfRow from(std::size_t) { return {this}; }

  /// The first index that attains at least this much; 0 if none does.
  kernels::Winner first(std::size_t k, double least) const {
    for (const Attempt& attempt : all[k])
      if (least > 0.0 && attempt.value >= least) return attempt.index;
    return 0;
  }
};

/// The winners of all relations of a chain; a copy shares them, and what was appended stays as it is.
template <class Winners>
class History {
 public:
  History() = default;
  History(const History&) = default;
  History(History&&) noexcept = default;
  History& operator=(History other) noexcept {
    std::swap(last_, other.last_);
    return *this;
  }
  ~History() {  // one after the other: a long chain is too deep for recursion
    while (last_ && last_.use_count() == 1) last_ = std::shared_ptr<Step>(std::move(last_->before));
  }

  void append(Winners winners) { last_ = std::make_shared<Step>(Step{std::move(winners), std::move(last_)}); }

  /// action(winners) from the last relation to the first.
  template <class Action>
  void backwards(const Action& action) const {
    for (const Step* step = last_.get(); step != nullptr; step = step->before.get()) action(step->winners);
  }

 private:
  struct Step {
    Winners winners;
    std::shared_ptr<Step> before;
  };
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
  using Winners = std::conditional_t<ScalingAlgebra<AlgebraOf<Kind>>, kernels::FirstWinners, detail::Attempts>;
  using History = detail::History<Winners>;

  explicit Routes(const Distribution<Kind>& start) : chain_(start) {}
  Routes(Chain<Kind> chain, History history, detail::ByLaw) : chain_(std::move(chain)), history_(std::move(history)) {}

  const Chain<Kind>& chain() const& { return chain_; }
  Chain<Kind> chain() && { return std::move(chain_); }
  Chain<Kind>& chain(detail::ByLaw) & { return chain_; }
  const History& history() const& { return history_; }
  History history() const&& { return history_; }

  /// The best way to one outcome of the current variable; on ties the first outcome, decided from the end backwards.
  Route to(std::size_t outcome) const {
    Route route{{outcome}, chain_.log(outcome)};
    const double value = Chain<Kind>::Row::value_of(chain_.row()[outcome]);
    history_.backwards(
        [&](const Winners& winners) { route.outcomes.push_back(winners.first(route.outcomes.back(), value)); });
    std::reverse(route.outcomes.begin(), route.outcomes.end());
    return route;
  }

 private:
  Chain<Kind> chain_;
  History history_;
};

namespace detail {

template <Uncertainty Kind>
Routes<Kind> further(const Relation<Kind, Kind>& left, const Routes<Kind>& right, typename Chain<Kind>::Row room) {
  check::same(left.from(), right.chain().variable(), "compose");
  typename Routes<Kind>::Winners winners;
  auto chain = further(left, right.chain(), std::move(room), winners);
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
