#include "laws/generate.hpp"

namespace hybrid_distribution_test {

/// The laws of joint distributions, (4), (5), (9)–(16), (19), (20), for every pair of kinds.
template <class OuterAndInner>
class JointLaws : public testing::Test {};
template <class OuterAndInner>
using OuterOf = std::tuple_element_t<0, OuterAndInner>;
template <class OuterAndInner>
using InnerOf = std::tuple_element_t<1, OuterAndInner>;
using Kinds = testing::Types<std::tuple<Fuzzy, Random>,   // (12)
                             std::tuple<Random, Fuzzy>,   // (13)
                             std::tuple<Random, Random>,  // the ordinary joint
                             std::tuple<Fuzzy, Fuzzy>>;   // (4)
TYPED_TEST_SUITE(JointLaws, Kinds, support::TypeNames);

/// Equal to a few units in the last place, however small: |a − b| ≤ 8 ulp of b.
void require_ulps(double found, double expected) {
  constexpr double normal = std::numeric_limits<double>::min();
  RC_ASSERT(std::abs(found - expected) <= 8.0 * std::numeric_limits<double>::epsilon() * std::max(expected, normal));
}

/// Numbers that leave no product below the normal ones: there a unit in the last place is no longer relative.
Numbers normal_numbers(By by, std::size_t n) {
  Numbers numbers = any_normalized_numbers(by, n);
  for (double& number : numbers)
    if (number < 1e-100) number = 0.0;
  return numbers;
}
Rows normal_rows(By by, std::size_t rows, std::size_t columns) {
  Rows result(rows);
  for (Numbers& row : result) row = normal_numbers(by, columns);
  return result;
}

/// What AnyJoint draws, of such numbers.
template <class OuterAndInner>
struct NormalJoint {
  using Outer = OuterOf<OuterAndInner>;
  using Inner = InnerOf<OuterAndInner>;
  Variable<Inner> inner = any_variable<Inner>("inner");
  Variable<Outer> outer = any_variable<Outer>("outer");
  Relation<Inner, Outer> conditional{inner, outer, normal_rows(by_kind<Inner>, outer.size(), inner.size())};
  Distribution<Outer> marginal{outer, normal_numbers(by_kind<Outer>, outer.size())};
};

/// ⊕ over rows of ⊕ over columns, restated.
double total_by(By outer, By inner, const Rows& rows) {
  Numbers sums;
  for (const Numbers& row : rows)
    sums.push_back(static_cast<double>(plain::evidence(inner, row, Numbers(row.size(), 1.0))));
  return static_cast<double>(plain::evidence(outer, sums, Numbers(sums.size(), 1.0)));
}
Rows transposed(const Rows& rows) {
  Rows result;
  for (std::size_t c = 0; c < rows.front().size(); ++c) result.push_back(plain::column(rows, c));
  return result;
}

TYPED_PROPERTY(JointLaws, ConditionalTimesMarginalIsNormalizedInItsOwnOrder) {  // (10) or (11)
  using Outer = OuterOf<TypeParam>;
  using Inner = InnerOf<TypeParam>;
  const auto [inner, outer, conditional, marginal] = AnyJoint<Inner, Outer>{};
  const HybridDistribution joint{conditional, marginal};
  const Rows rows = rows_of(joint.table());
  require_near(joint.total(), 1.0);
  require_near(joint.total(), total_by(by_kind<Outer>, by_kind<Inner>, rows));
  require_near(joint.beta(), total_by(by_kind<Inner>, by_kind<Outer>, transposed(rows)));
  const HybridDistribution proven{outer, inner, rows};  // or this would throw
  RC_ASSERT(rows_of(proven.table()) == rows);
}

TYPED_PROPERTY(JointLaws, TheFactorsComeBackToAFewUlp) {
  const auto [inner, outer, conditional, marginal] = NormalJoint<TypeParam>{};
  const HybridDistribution joint{conditional, marginal};
  const auto again = joint.inner_given_outer();
  std::vector<std::size_t> without_mass;
  for (std::size_t o = 0; o < outer.size(); ++o) {
    require_ulps(joint.outer_marginal()[o], marginal[o]);
    if (marginal[o] == 0.0) {
      without_mass.push_back(o);
      RC_ASSERT(numbers_of(again.relation.row(o)) == numbers_of(uninformative(inner).values()));
    } else {
      for (std::size_t i = 0; i < inner.size(); ++i) require_ulps(again.relation(o, i), conditional(o, i));
    }
  }
  RC_ASSERT(again.unreachable == without_mass);
}

TYPED_PROPERTY(JointLaws, TheReexpansionIsTheJointToAFewUlp) {  // (12) ↔ (14), (13) ↔ its counterpart, (4) both ways
  const auto [inner, outer, conditional, marginal] = NormalJoint<TypeParam>{};
  const HybridDistribution joint{conditional, marginal};
  const HybridDistribution again{joint.outer_given_inner().relation, joint.inner_marginal()};
  for (std::size_t o = 0; o < outer.size(); ++o)
    for (std::size_t i = 0; i < inner.size(); ++i)
      require_ulps(std::is_same_v<OuterOf<TypeParam>, InnerOf<TypeParam>> ? again(i, o) : again(o, i), joint(o, i));
}

TYPED_PROPERTY(JointLaws, MarginalAndConditionalAreTheirRestatements) {  // (5), (15), (19), (20)
  using Outer = OuterOf<TypeParam>;
  const auto [inner, outer, conditional, marginal] = AnyJoint<InnerOf<TypeParam>, Outer>{};
  const HybridDistribution joint{conditional, marginal};
  const Rows rows = rows_of(conditional.table());
  const Numbers numbers = numbers_of(marginal.values());
  require_near(joint.inner_marginal().values(), plain::compose(by_kind<Outer>, rows, numbers));
  const auto back = joint.outer_given_inner();
  const Rows expected = plain::invert(by_kind<Outer>, rows, numbers);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    // Products below the normal numbers are rounded before they are compared.
    if (joint.inner_marginal()[i] > 1e-290) require_near(back.relation.row(i), expected[i]);
    const bool listed = std::count(back.unreachable.begin(), back.unreachable.end(), i) == 1;
    RC_ASSERT(listed == (joint.inner_marginal()[i] == 0.0));
    require_near(total<Outer>(back.relation.row(i)), 1.0);
  }
}

}  // namespace hybrid_distribution_test
