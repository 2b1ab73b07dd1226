#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

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

  /// Through which outcome of the variable between the best way leads `from` → `to`: the first on a tie. It is 0 if no
  /// way does, for then all tie.
  std::size_t winner(std::size_t from, std::size_t to) const {
    return std::visit(
        [&](const auto& rows) -> std::size_t {
          const auto k = position(rows.entries(from), to);
          return k == none ? 0 : winners_.all[rows.offset(from) + k];
        },
        relation_.rows());
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static std::size_t position(const RunOfEntries& row, std::size_t to) {
    return to >= row.first && to - row.first < row.size() ? to - row.first : none;
  }
  static std::size_t position(const ListOfEntries& row, std::size_t to) {
    const auto found = std::lower_bound(row.columns.begin(), row.columns.end(), to);
    return found != row.columns.end() && *found == to ? static_cast<std::size_t>(found - row.columns.begin()) : none;
  }

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
  kernels::compose<AlgebraOf<typename Left::from_kind>>(left.rows(), right.rows(), rows, winners);
  if constexpr (!is_induced<Composed>) detail::settle<AlgebraOf<typename Left::to_kind>>(rows);
  return Witnessed<Composed>{Composed{left.to(), right.from(), std::move(rows), detail::ByLaw{}}, std::move(winners),
                             detail::ByLaw{}};
}

}  // namespace sigmax
