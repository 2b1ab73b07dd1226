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

// Tables of any numbers, normalised or not: what composition inherits from the algebra.

template <Algebra A>
Table composed(const Table& left, const Table& right) {
  Table result(0, 0);
  kernels::compose<A>(left, right, result);
  return result;
}

template <Algebra A>
Table summed(const Table& a, const Table& b) {
  Table result = a;
  for (std::size_t i = 0; i < a.size(); ++i) result.data()[i] = A::plus(a.data()[i], b.data()[i]);
  return result;
}

Table any_table(std::size_t rows, std::size_t columns) { return table_of(any_unit_rows(rows, columns)); }

TYPED_PROPERTY(AlgebraLaws, CompositionIsAssociative) {
  using A = TypeParam;
  const std::size_t x = any_size(), m = any_size(), l = any_size(), y = any_size();
  const Table a = any_table(m, x), b = any_table(l, m), c = any_table(y, l);
  require_near(rows_of(composed<A>(composed<A>(a, b), c)), rows_of(composed<A>(a, composed<A>(b, c))));
}

TYPED_PROPERTY(AlgebraLaws, CompositionDistributesOverPlus) {
  using A = TypeParam;
  const std::size_t x = any_size(), m = any_size(), y = any_size();
  const Table left = any_table(m, x), other_left = any_table(m, x);
  const Table right = any_table(y, m), other_right = any_table(y, m);
  require_near(rows_of(composed<A>(summed<A>(left, other_left), right)),
               rows_of(summed<A>(composed<A>(left, right), composed<A>(other_left, right))));
  require_near(rows_of(composed<A>(left, summed<A>(right, other_right))),
               rows_of(summed<A>(composed<A>(left, right), composed<A>(left, other_right))));
}

TYPED_PROPERTY(AlgebraLaws, CompositionIsMonotone) {
  using A = TypeParam;
  const std::size_t x = any_size(), m = any_size(), y = any_size();
  const Table left = any_table(m, x), right = any_table(y, m);
  const Table greater_left = summed<Max>(left, any_table(m, x)), greater_right = summed<Max>(right, any_table(y, m));
  const Table less = composed<A>(left, right), greater = composed<A>(greater_left, greater_right);
  for (std::size_t i = 0; i < less.size(); ++i) RC_ASSERT(less.data()[i] <= greater.data()[i]);
}

}  // namespace algebra_test
