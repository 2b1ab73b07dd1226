#include "laws/generate.hpp"

namespace sparse_relation_test {

using plain::By;

const RandomVariable cell{"cell", {"a", "b", "c", "d"}};
const FuzzyVariable mood{"mood", {"calm", "wild"}};

Relation<Random, Random> sparse_step() {
  return {cell, cell, SparseRows{{{0, 0.75}, {3, 0.25}}, {{1, 1.0}}, {{0, 0.5}, {2, 0.5}}, {{3, 1.0}}}};
}
Relation<Random, Random> banded_step() {
  return {cell, cell, BandedRows{{0, {0.75, 0.25}}, {0, {0.25, 0.5, 0.25}}, {1, {0.25, 0.5, 0.25}}, {2, {0.25, 0.75}}}};
}
Rows dense_rows(const auto& relation) { return laws::rows_of(relation.dense().table()); }

template <class Stored, class R>
bool is_stored_as(const R& relation) {
  return std::holds_alternative<Stored>(relation.rows());
}

TEST(SparseRelation, IsARelationLikeAnyOther) {
  const Relation step{cell, cell, SparseRows{{{0, 0.75}, {3, 0.25}}, {{1, 1.0}}, {{0, 0.5}, {2, 0.5}}, {{3, 1.0}}}};
  static_assert(std::same_as<decltype(step), const Relation<Random, Random>>);
  EXPECT_EQ(step(0, 3), 0.25);
  EXPECT_EQ(step(0, 1), 0.0);
  EXPECT_EQ(step(2, 2), 0.5);
  EXPECT_CLOSE(step.given("c").values(), (std::vector{0.5, 0.0, 0.5, 0.0}), 0.0);
  const Likelihood column = step.likelihood("a");
  EXPECT_CLOSE(column["a"], 0.75, 1e-15);
  EXPECT_EQ(column.log(1), log_zero);
  EXPECT_EQ(dense_rows(step),
            (Rows{{0.75, 0.0, 0.0, 0.25}, {0.0, 1.0, 0.0, 0.0}, {0.5, 0.0, 0.5, 0.0}, {0.0, 0.0, 0.0, 1.0}}));
}

TEST(SparseRelation, IsVisitedRowByRowWhateverStoresIt) {
  const auto entries_of = [](const auto& relation, std::size_t row) {
    std::vector<std::pair<std::size_t, double>> entries;
    relation.for_each(row, [&](std::size_t to, double value) { entries.push_back({to, value}); });
    return entries;
  };
  using Entries = std::vector<std::pair<std::size_t, double>>;
  EXPECT_EQ(entries_of(sparse_step(), 2), (Entries{{0, 0.5}, {2, 0.5}}));
  EXPECT_EQ(entries_of(banded_step(), 2), (Entries{{1, 0.25}, {2, 0.5}, {3, 0.25}}));
  EXPECT_EQ(entries_of(sparse_step().dense(), 2), (Entries{{0, 0.5}, {1, 0.0}, {2, 0.5}, {3, 0.0}}));
}

TEST(SparseRelation, RefusesABadRowByVariableRowAndValue) {
  EXPECT_INVALID(("maximum", "'mood'", "mood", "'wild'", "0.5"),
                 Relation(mood, mood, SparseRows{{{0, 1.0}}, {{1, 0.5}}}));
  EXPECT_INVALID(("'mood'", "mood", "'wild'", "'wild'", "1.5"),
                 Relation(mood, mood, SparseRows{{{0, 1.0}}, {{0, 1.0}, {1, 1.5}}}));
  EXPECT_INVALID(("'mood'", "mood", "'wild'", "2 outcomes", "outcome 2"),
                 Relation(mood, mood, SparseRows{{{0, 1.0}}, {{2, 1.0}}}));
  EXPECT_INVALID(("'mood'", "mood", "'wild'", "ascending", "'calm'", "'wild'"),
                 Relation(mood, mood, SparseRows{{{0, 1.0}}, {{1, 1.0}, {0, 1.0}}}));
  EXPECT_INVALID(("ascending", "'calm'"), Relation(mood, mood, SparseRows{{{0, 1.0}}, {{0, 1.0}, {0, 1.0}}}));
  EXPECT_INVALID(("'mood'", "2 rows", "1"), Relation(mood, mood, SparseRows{{{0, 1.0}}}));
  EXPECT_INVALID(("'mood'", "mood", "'wild'", "2 outcomes", "outcome 2"),
                 Relation(mood, mood, BandedRows{{0, {1.0, 0.5}}, {1, {1.0, 0.5}}}));
  EXPECT_INVALID(("sum", "'cell'", "'wild'", "0"), Relation(cell, mood, SparseRows{{{0, 1.0}}, {}}));
}

TEST(SparseRows, TakeCompressedRowsAsTheyAre) {
  const SparseRows rows(4, std::vector<std::size_t>{1, 3}, {2, 0, 3}, {1.0, 0.5, 0.5});
  EXPECT_EQ(rows.rows(), 2U);
  EXPECT_EQ(rows.columns(), 4U);
  EXPECT_EQ(rows.at(0, 2), 1.0);
  EXPECT_EQ(rows.at(1, 3), 0.5);
  EXPECT_THROW(SparseRows(4, std::vector<std::size_t>{1, 3}, {2, 0}, {1.0, 0.5}), std::invalid_argument);
  EXPECT_THROW(SparseRows(4, std::vector<std::size_t>{2, 1}, {2}, {1.0}), std::invalid_argument);
  EXPECT_THROW(SparseRows(4, std::vector<std::size_t>{1}, {2, 3}, {1.0}), std::invalid_argument);
}

TEST(SparseRows, OfNothingHaveNeitherRowsNorColumns) {
  EXPECT_EQ(SparseRows().rows() + SparseRows().columns() + SparseRows().stored(), 0U);
  EXPECT_EQ(BandedRows().rows() + BandedRows().columns() + BandedRows().stored(), 0U);
  EXPECT_EQ((BandedRows{{0, {0.5, 0.5}}, {1, {1.0}}}).columns(), 2U);
}

TEST(SparseRelation, ComposesToWhatFitsTheResult) {
  const RandomVariable large{"large", 100};
  SparseRows cyclic, lazy;
  BandedRows band;
  for (std::size_t i = 0; i < 100; ++i) {
    cyclic.append({{(i + 37) % 100, 1.0}});
    band.append(std::min<std::size_t>(i, 98), Numbers{0.5, 0.5});
    if (i < 83)
      lazy.append({{i, 0.5}, {i + 17, 0.5}});
    else
      lazy.append({{i - 83, 0.5}, {i, 0.5}});
  }
  const Relation turn{large, large, cyclic}, walk{large, large, band};
  EXPECT_TRUE(is_stored_as<SparseRows>(compose(turn, turn)));
  EXPECT_TRUE(is_stored_as<BandedRows>(compose(walk, walk)));
  EXPECT_TRUE(is_stored_as<SparseRows>(compose(walk, turn)));
  EXPECT_TRUE(is_stored_as<Table>(compose(turn.dense(), walk)));
  EXPECT_TRUE(is_stored_as<Table>(compose(turn, walk.dense())));
  EXPECT_TRUE(is_stored_as<Table>(compose(compose(sparse_step(), sparse_step()), banded_step().dense())));
  // A few rows that store little in many columns stay sparse even after a dense table.
  const RandomVariable two{"two", 2};
  const Relation far{large, two, SparseRows{{{5, 1.0}}, {{90, 0.5}, {91, 0.5}}}};
  const Relation dense{two, large, Rows(100, {0.5, 0.5})};
  EXPECT_TRUE(is_stored_as<SparseRows>(compose(far, dense)));
  // Powers fill up: once half of the numbers is stored, they are stored as a table.
  const Relation jump{large, large, lazy};
  Relation power = jump;
  for (int i = 0; i < 40; ++i) power = compose(jump, power);
  EXPECT_TRUE(is_stored_as<SparseRows>(power));
  for (int i = 0; i < 20; ++i) power = compose(jump, power);
  EXPECT_TRUE(is_stored_as<Table>(power));
}

// Sparse and banded equal dense, to the last bit.

/// Rows as generated, some of them with long runs of zeros, stored in one of the three ways.
template <Uncertainty To, Uncertainty From>
Relation<To, From> any_stored_relation(const Variable<To>& to, const Variable<From>& from) {
  Rows rows = laws::any_normalized_rows(laws::by_kind<To>, from.size(), to.size());
  const auto way = *rc::gen::inRange<int>(0, 3);
  if (way == 0) return {to, from, rows};
  SparseRows sparse(to.size());
  BandedRows banded(to.size());
  for (const Numbers& row : rows) {
    std::size_t first = 0, last = row.size();
    while (row[first] == 0.0) ++first;
    while (row[last - 1] == 0.0) --last;
    banded.append(first, std::span(row).subspan(first, last - first));
    for (std::size_t k = 0; k < row.size(); ++k)
      if (row[k] > 0.0) sparse.append_entry(k, row[k]);
    sparse.end_row();
  }
  if (way == 1) return {to, from, sparse};
  return {to, from, banded};
}

TYPED_SUITE(StoredRelations, Random, Fuzzy, Ordinal);

template <class Kind>
struct Any {
  Variable<Kind> x = laws::any_variable<Kind>("x"), m = laws::any_variable<Kind>("m"),
                 y = laws::any_variable<Kind>("y");
  Relation<Kind, Kind> left = any_stored_relation(x, m), right = any_stored_relation(m, y);
};

TYPED_PROPERTY(StoredRelations, ComposeToTheBitsOfDenseOnes) {
  const Any<TypeParam> any;
  const auto composed = compose(any.left, any.right);
  RC_ASSERT(dense_rows(composed) == laws::rows_of(compose(any.left.dense(), any.right.dense()).table()));
  auto result = composed;  // whatever it stored before
  compose(any.left, any.right, result);
  RC_ASSERT(dense_rows(result) == dense_rows(composed));
  for (std::size_t i = 0; i < any.y.size(); ++i)
    for (std::size_t k = 0; k < any.x.size(); ++k) RC_ASSERT(composed(i, k) == dense_rows(composed)[i][k]);
}

TYPED_PROPERTY(StoredRelations, ComposeWithDistributionsAndLikelihoodsToTheBitsOfDenseOnes) {
  const Any<TypeParam> any;
  const auto prior = laws::any_distribution(any.m);
  RC_ASSERT(numbers_of(compose(any.left, prior).values()) == numbers_of(compose(any.left.dense(), prior).values()));
  const Likelihood likelihood{any.m, laws::any_unit_numbers(any.m.size())};
  const auto carried = compose(likelihood, any.right), expected = compose(likelihood, any.right.dense());
  for (std::size_t i = 0; i < any.y.size(); ++i) RC_ASSERT(carried.number(i) == expected.number(i));
  for (std::size_t k = 0; k < any.x.size(); ++k)
    for (std::size_t i = 0; i < any.m.size(); ++i)
      RC_ASSERT(any.left.likelihood(k).number(i) == any.left.dense().likelihood(k).number(i));
}

TYPED_PROPERTY(StoredRelations, InvertToTheBitsOfDenseOnes) {
  const Any<TypeParam> any;
  const auto prior = laws::any_distribution(any.m);
  const auto inverse = invert(any.left, prior), expected = invert(any.left.dense(), prior);
  RC_ASSERT(inverse.unreachable == expected.unreachable);
  RC_ASSERT(dense_rows(inverse.relation) == dense_rows(expected.relation));
  RC_ASSERT(dense_rows(compose(inverse.relation, any.left)) ==
            dense_rows(compose(expected.relation, any.left.dense())));
}

TYPED_PROPERTY(StoredRelations, PassAChainToTheBitsOfDenseOnes) {
  const Any<TypeParam> any;
  const Chain chain{laws::any_distribution(any.y)};
  const auto through = compose(any.left, compose(any.right, chain));
  const auto expected = compose(any.left.dense(), compose(any.right.dense(), chain));
  for (std::size_t k = 0; k < any.x.size(); ++k) RC_ASSERT(through.log(k) == expected.log(k));
}

PROPERTY(SparseRelation, CarriesABeliefToTheBitsOfADenseOne) {
  const Any<Fuzzy> any;
  const Belief belief{laws::any_distribution(any.m)};
  RC_ASSERT(numbers_of(compose(any.left, belief).logs()) == numbers_of(compose(any.left.dense(), belief).logs()));
}

TEST(SparseRelation, WithManyUnreachableOutcomesInvertsWithoutATable) {
  const RandomVariable large{"large", 100000};
  SparseRows rows(large.size());
  for (std::size_t i = 0; i < large.size(); ++i) rows.append({{i / 2, 1.0}});  // the upper half is never reached
  const auto inverse = invert(Relation<Random, Random>{large, large, rows}, uninformative(large));
  ASSERT_EQ(inverse.unreachable.size(), 50000U);
  EXPECT_EQ(inverse.unreachable.front(), 50000U);
  EXPECT_EQ(inverse.relation(99999, 3), 1e-5);
  EXPECT_EQ(inverse.relation(7, 14), 0.5);
  EXPECT_EQ(inverse.relation(7, 16), 0.0);
}

TEST(SparseRelation, IsTransformedAsItsTable) {
  for (const Relation<Random, Random>& step : {sparse_step(), banded_step()}) {
    const Relation possible = to_possibility(step, RatioScale{});
    EXPECT_EQ(possible.rows().index(), step.rows().index());
    EXPECT_EQ(rows_of(possible.dense().table()), rows_of(to_possibility(step.dense(), RatioScale{}).table()));
    const Relation back = to_probability(to_possibility(step, DuboisPradeSandri{}), DuboisPradeSandri{});
    EXPECT_EQ(back.rows().index(), step.rows().index());
    for (std::size_t from = 0; from < step.from().size(); ++from)
      for (std::size_t to = 0; to < step.to().size(); ++to) EXPECT_NEAR(back(from, to), step(from, to), 1e-15);
    const Relation<Random, Fuzzy> read_otherwise = with_fuzzy_condition(step);
    EXPECT_EQ(read_otherwise.rows().index(), step.rows().index());
    EXPECT_EQ(rows_of(read_otherwise.dense().table()), rows_of(step.dense().table()));
  }
}

TEST(SparseRelation, SharesRowsThatATransformSeesOnce) {
  // Nothing reaches the odd outcomes: their rows of the inverse are uninformative and stored once.
  const RandomVariable x{"x", 6};
  const Relation<Random, Random> sparse{
      x, x, SparseRows{{{0, 1.0}}, {{0, 1.0}}, {{2, 1.0}}, {{2, 1.0}}, {{4, 1.0}}, {{4, 1.0}}}};
  const Relation<Random, Random> banded{
      x, x, BandedRows{{0, {1.0}}, {0, {1.0}}, {2, {1.0}}, {2, {1.0}}, {4, {1.0}}, {4, {1.0}}}};
  for (const auto& even : {sparse, banded}) {
    const auto inverse = invert(even, uninformative(x));
    EXPECT_TRUE(is_stored_as<SparseRows>(inverse.relation));
    EXPECT_EQ(inverse.unreachable, (std::vector<std::size_t>{1, 3, 5}));
    EXPECT_EQ(inverse.relation(1, 4), 1.0 / 6.0);
    EXPECT_EQ(inverse.relation(2, 3), 0.5);
    const Relation possible = to_possibility(inverse.relation, DuboisPradeSandri{});
    for (const std::size_t row : inverse.unreachable)
      for (std::size_t to = 0; to < x.size(); ++to) EXPECT_EQ(possible(row, to), 1.0);
  }
}

TEST(SparseRelation, IsWrittenALinePerRow) {
  std::ostringstream out;
  out << sparse_step() << Relation{cell, mood, {{0.75, 0.25, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}};
  EXPECT_EQ(out.str(),
            "cell given cell = a: a 0.75, d 0.25\n"
            "cell given cell = b: b 1\n"
            "cell given cell = c: a 0.5, c 0.5\n"
            "cell given cell = d: d 1\n"
            "cell given mood = calm: a 0.75, b 0.25, c 0, d 0\n"
            "cell given mood = wild: a 0, b 0, c 0, d 1\n");
}

TEST(SparseRelation, SaysThatItHasNoTable) {
  EXPECT_INVALID(("'cell' given 'cell'", "sparsely", "dense()"), sparse_step().table());
}

}  // namespace sparse_relation_test
