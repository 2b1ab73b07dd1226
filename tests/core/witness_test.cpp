#include "laws/generate.hpp"

namespace witness_test {

template <class Left, class Right>
concept Witnesses = requires(const Left& left, const Right& right) {
  compose_with_witness(left, right);
};
static_assert(Witnesses<Relation<Fuzzy, Fuzzy>, Relation<Fuzzy, Random>>);
static_assert(Witnesses<Relation<Ordinal, Ordinal>, Relation<Ordinal, Ordinal>>);
static_assert(!Witnesses<Relation<Random, Random>, Relation<Random, Fuzzy>>);  // a sum has no winner

const FuzzyVariable age{"age", {"young", "middle", "old"}};
const FuzzyVariable mood{"mood", {"calm", "wild"}};

const Relation mood_given_age{mood, age, {{0.5, 1.0}, {1.0, 0.5}, {1.0, 0.25}}};

TEST(Witness, ThroughAFuzzyVariableBetweenRandomOnesIsOfWhatIsInduced) {  // (17)
  const RandomVariable speed{"speed", {"slow", "fast"}};
  const Relation speed_given_mood{speed, mood, {{0.75, 0.25}, {0.25, 0.75}}};
  const auto composed = compose_with_witness(speed_given_mood, mood_given_age);
  static_assert(std::same_as<decltype(composed.relation()), const Induced<Relation<Random, Fuzzy>>&>);
  EXPECT_CLOSE(composed.relation().table().values(), compose(speed_given_mood, mood_given_age).table().values(), 0.0);
  EXPECT_EQ(composed.winner(0, 1), 1U);  // the young are fast when wild
  EXPECT_EQ(composed.winner(2, 0), 0U);
}

TEST(Witness, RefusesVariablesThatDoNotMeet) {
  EXPECT_INVALID(("compose_with_witness", "'age'", "'mood'"), compose_with_witness(mood_given_age, mood_given_age));
}

TYPED_SUITE(WitnessOf, Fuzzy, Ordinal);

/// The winner by brute force: the first value that attains the maximum of all terms.
TYPED_PROPERTY(WitnessOf, IsTheFirstOfTheGreatestTerms) {
  using A = AlgebraOf<TypeParam>;
  const auto x = laws::any_variable<TypeParam>("x"), m = laws::any_variable<TypeParam>("m"),
             y = laws::any_variable<TypeParam>("y");
  const auto left = laws::any_relation(x, m);
  const auto right = laws::any_relation(m, y);
  const auto composed = compose_with_witness(left, right);
  RC_ASSERT(rows_of(composed.relation().table()) == rows_of(compose(left, right).table()));
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) {
      std::vector<double> terms;
      for (std::size_t j = 0; j < m.size(); ++j) terms.push_back(A::times(right(i, j), left(j, k)));
      const auto greatest = std::max_element(terms.begin(), terms.end());
      RC_ASSERT(composed.relation()(i, k) == *greatest);
      RC_ASSERT(composed.winner(i, k) == static_cast<std::size_t>(greatest - terms.begin()));
    }
}

/// A square relation whose rows store a few columns, and the same dense.
template <class Kind>
SparseRows any_sparse_rows(std::size_t rows, std::size_t columns) {
  const Rows numbers = laws::any_normalized_rows(laws::by_kind<Kind>, rows, columns);
  SparseRows result(columns);
  for (const auto& row : numbers) {
    for (std::size_t k = 0; k < columns; ++k)
      if (row[k] > 0.0) result.append_entry(k, row[k]);
    result.end_row();
  }
  return result;
}

PROPERTY(Witness, OfSparseRelationsIsThatOfDenseOnes) {
  const auto x = laws::any_variable<Fuzzy>("x"), m = laws::any_variable<Fuzzy>("m"), y = laws::any_variable<Fuzzy>("y");
  const Relation left{x, m, any_sparse_rows<Fuzzy>(m.size(), x.size())};
  const Relation right{m, y, any_sparse_rows<Fuzzy>(y.size(), m.size())};
  const auto sparse = compose_with_witness(left, right), dense = compose_with_witness(left.dense(), right.dense());
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) {
      RC_ASSERT(sparse.relation()(i, k) == dense.relation()(i, k));
      RC_ASSERT(sparse.winner(i, k) == dense.winner(i, k));
    }
}

TEST(Witness, OfAnImpossiblePairInsideABandIsTheFirst) {
  const FuzzyVariable x{"x", 2}, y{"y", 2}, z{"z", 3};
  const Relation<Fuzzy, Fuzzy> y_given_x{y, x, BandedRows{{0, {0.5, 1.0}}, {0, {0.5, 1.0}}}};
  const Relation<Fuzzy, Fuzzy> z_given_y{z, y, BandedRows{{0, {1.0}}, {2, {1.0}}}};  // nothing leads to 1
  const auto witnessed = compose_with_witness(z_given_y, y_given_x);
  ASSERT_TRUE(std::holds_alternative<BandedRows>(witnessed.relation().rows()));
  for (const std::size_t from : {0U, 1U}) {
    EXPECT_EQ(witnessed.relation()(from, 1), 0.0);
    EXPECT_EQ(witnessed.winner(from, 0), 0U);
    EXPECT_EQ(witnessed.winner(from, 1), 0U);
    EXPECT_EQ(witnessed.winner(from, 2), 1U);
  }
}

}  // namespace witness_test
