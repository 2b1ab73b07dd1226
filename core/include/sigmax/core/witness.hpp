#pragma once

#include <concepts>
#include <cstddef>
#include <utility>

#include <sigmax/core/compose.hpp>

namespace sigmax {

/// A composition by an algebra that selects, and for each of its numbers the intermediate value that won.
template <class Composed>
class Witnessed {
 public:
  Witnessed(Composed relation, kernels::FirstWinners winners, detail::ByLaw)
      : relation_(std::move(relation)), winners_(std::move(winners)) {}

  /// What `compose` gives.
  const Composed& relation() const& { return relation_; }
  Composed relation() && { return std::move(relation_); }

  /// The outcome of the variable between on the best way `from` → `to`: the first if several tie, 0 if there is no way.
  std::size_t winner(std::size_t from, std::size_t to) const {
    const auto row = detail::entries_of(relation_.rows(), from);
    const std::size_t k = row.place_of(to);
    return k == row.size() ? 0 : winners_[detail::offset_of(relation_.rows(), from) + k];
  }

 private:
  Composed relation_;
  kernels::FirstWinners winners_;  // one for every number that the relation stores, in its order
};

/// `compose(left, right)` that also says which value between them won, (6), (17): for kinds whose ⊕ selects.
///
///     compose_with_witness(mood_given_age, age_given_name).winner(ann, wild)   // the age by which Ann may be wild
///
/// Throws std::invalid_argument, naming both, if the variables in the middle are not the same.
template <Conditional Left, Conditional Right>
  requires std::same_as<typename Left::from_kind, typename Right::to_kind> &&
      SelectiveAlgebra<AlgebraOf<typename Left::from_kind>>
auto compose_with_witness(const Left& left, const Right& right) {
  using Composed = InducedBy<Left, Right, Relation<typename Left::to_kind, typename Right::from_kind>>;
  check::same(left.from(), right.to(), "compose_with_witness");
  AnyRows rows = Table(0, 0);
  kernels::FirstWinners winners;
  detail::compose(detail::algebra_of<typename Left::from_kind>(), left.rows(), right.rows(), !is_induced<Composed>,
                  rows, &winners);
  return Witnessed<Composed>{Composed{left.to(), right.from(), std::move(rows), detail::ByLaw{}}, std::move(winners),
                             detail::ByLaw{}};
}

}  // namespace sigmax
