#include "laws/generate.hpp"

namespace algebra_test {

/// The laws that the concepts of algebra.hpp promise; a new algebra is added to the list.
TYPED_SUITE(AlgebraLaws, Sigma, Max, MaxMin);

TYPED_SUITE(ScalingAlgebraLaws, Sigma, Max);

static_assert(Algebra<Sigma> && ScalingAlgebra<Sigma> && !SelectiveAlgebra<Sigma>);
static_assert(Algebra<Max> && ScalingAlgebra<Max> && SelectiveAlgebra<Max>);
static_assert(Algebra<MaxMin> && !ScalingAlgebra<MaxMin> && SelectiveAlgebra<MaxMin>);

TYPED_PROPERTY(AlgebraLaws, IsACommutativeSemiring) {
  using A = TypeParam;
  const double a = any_unit_number(), b = any_unit_number(), c = any_unit_number();
  for (const auto op : {&A::plus, &A::times}) {
    require_near(op(op(a, b), c), op(a, op(b, c)));
    RC_ASSERT(op(a, b) == op(b, a));
  }
  RC_ASSERT(A::plus(a, A::zero()) == a);
  RC_ASSERT(A::times(a, A::one()) == a);
  RC_ASSERT(A::times(a, A::zero()) == A::zero());
  require_near(A::times(a, A::plus(b, c)), A::plus(A::times(a, b), A::times(a, c)));
}

TYPED_PROPERTY(AlgebraLaws, BothOperationsAreMonotone) {
  using A = TypeParam;
  const double a = any_unit_number(), b = any_unit_number(), c = any_unit_number();
  const double low = std::min(a, b), high = std::max(a, b);
  RC_ASSERT(A::plus(low, c) <= A::plus(high, c));
  RC_ASSERT(A::times(low, c) <= A::times(high, c));
}

TYPED_TEST(AlgebraLaws, PlusSelectsExactlyIfTheAlgebraSaysSo) {
  using A = TypeParam;
  holds([] {
    const double a = any_unit_number(), b = any_unit_number();
    if constexpr (A::selective) RC_ASSERT(A::plus(a, b) == a || A::plus(a, b) == b);
  });
  const double both = A::plus(0.5, 0.5);
  EXPECT_EQ(both == 0.5, A::selective);
}

TYPED_PROPERTY(ScalingAlgebraLaws, DivideUndoesTimesAndPassesThroughPlus) {
  using A = TypeParam;
  const double a = any_unit_number(), b = any_unit_number(), scale = any_unit_number();
  RC_PRE(scale >= std::numeric_limits<double>::min());
  require_near(A::divide(A::times(a, scale), scale), a);
  require_near(A::plus(A::divide(a, scale), A::divide(b, scale)), A::divide(A::plus(a, b), scale));
}

}  // namespace algebra_test
