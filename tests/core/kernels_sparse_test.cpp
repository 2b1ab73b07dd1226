#include "kernels/sparse.hpp"
#include "support/drawn_tables.hpp"

namespace kernels_sparse_test {

using namespace drawn_tables;

/// A table of which most numbers are zero; how many of them are not differs from row to row.
Table thinned(std::size_t rows, std::size_t columns, Draw draw, std::uint64_t seed) {
  Table table = drawn(rows, columns, draw, seed);
  std::mt19937_64 bits(seed + 100);
  for (std::size_t r = 0; r < rows; ++r) {
    const std::uint64_t rarity = 1 + bits() % 20;
    for (double& number : table.row(r)) number = bits() % rarity == 0 ? number : 0.0;
  }
  return table;
}

SparseRows sparse(const Table& table) {
  SparseRows rows(table.columns());
  for (std::size_t r = 0; r < table.rows(); ++r) {
    for (std::size_t c = 0; c < table.columns(); ++c)
      if (table(r, c) != 0.0) rows.append_entry(c, table(r, c));
    rows.end_row();
  }
  return rows;
}

BandedRows banded(const Table& table) {
  BandedRows rows(table.columns());
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const std::span<const double> row = table.row(r);
    const auto is_some = [](double number) { return number != 0.0; };
    const auto first = std::find_if(row.begin(), row.end(), is_some);
    const auto last = std::find_if(row.rbegin(), std::make_reverse_iterator(first), is_some).base();
    rows.append(static_cast<std::size_t>(first - row.begin()), std::span(first, last));
  }
  return rows;
}

/// Sizes around the words of a set of columns, and those of the words of its words.
struct Size {
  std::size_t rows, inner, columns;
};
const std::vector<Size> sizes{{1, 1, 1},    {3, 5, 2},    {7, 11, 63},  {8, 9, 64},    {5, 33, 65},
                              {4, 17, 127}, {19, 3, 129}, {3, 7, 4095}, {2, 13, 4096}, {3, 9, 4097}};

/// Whether the columns of every row ascend.
bool ascend(const SparseRows& rows) {
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    const auto columns = rows.entries(r).columns;
    if (std::adjacent_find(columns.begin(), columns.end(), std::greater_equal{}) != columns.end()) return false;
  }
  return true;
}

/// Composes parts stored in any way, over a former result, and compares to the bit.
template <class A, class Add>
void expect_as_defined(Draw draw, Add add) {
  AnyRows result = sparse(drawn(2, 3, uniform, 7));
  for (const Size& size : sizes) {
    const Table right = thinned(size.rows, size.inner, draw, 1), left = thinned(size.inner, size.columns, draw, 2);
    const Table expected = defined(left, right, add);
    for (const AnyRows& l : {AnyRows{sparse(left)}, AnyRows{banded(left)}})
      for (const AnyRows& r : {AnyRows{sparse(right)}, AnyRows{banded(right)}, AnyRows{right}}) {
        const std::string at = std::to_string(size.rows) + " × " + std::to_string(size.inner) + " × " +
                               std::to_string(size.columns) + " as " + std::to_string(l.index()) +
                               std::to_string(r.index());
        kernels::compose<A>(l, r, result);
        ASSERT_TRUE(std::ranges::equal(dense_table(result).values(), expected.values())) << at;
        if (const auto* const rows = std::get_if<SparseRows>(&result)) {
          ASSERT_TRUE(ascend(*rows)) << at;
        }
      }
  }
}

TEST(Sparse, MaximaAreThoseOfTheDefinitionToTheBit) {
  for (const Draw draw : {uniform, tied, with_infinities, wide, subnormal}) expect_as_defined<Max>(draw, max_of);
}

TEST(Sparse, GradesAreThoseOfTheDefinitionToTheBit) {
  for (const Draw draw : {uniform, tied, wide, subnormal}) expect_as_defined<MaxMin>(draw, max_min);
}

TEST(Sparse, SumsAreThoseOfTheDefinitionToTheBit) {
  for (const Draw draw : {uniform, tied, wide, subnormal}) expect_as_defined<Sigma>(draw, summed);
}

TEST(Sparse, ManyTermsOfOneColumnNeedNoMoreRoomThanTheResult) {
  // A thousand rows of a thousand terms each, all of them in two columns.
  SparseRows left(2), right(1000);
  for (std::size_t j = 0; j < 1000; ++j) left.append({{0, 0.5}, {1, static_cast<double>(j) / 1000.0}});
  for (std::size_t i = 0; i < 1000; ++i) {
    for (std::size_t j = 0; j < 1000; ++j) right.append_entry(j, 1.0);
    right.end_row();
  }
  SparseRows result;
  kernels::sparse_composition(Max{}, left, right, result);
  ASSERT_EQ(result.stored(), 2000U);
  EXPECT_EQ(result.at(999, 0), 0.5);
  EXPECT_EQ(result.at(999, 1), 0.999);
}

TEST(Sparse, RowsOfNoneAndOfVeryDifferentSizesAreComposed) {
  // The first rows of `left` are short: the room that they make expect does not suffice for the last.
  SparseRows left(5000), right(100);
  for (std::size_t j = 0; j < 99; ++j) left.append({});
  for (std::size_t k = 0; k < 5000; ++k) left.append_entry(k, 0.25);
  left.end_row();
  for (std::size_t i = 0; i < 50; ++i) right.append({{i, 1.0}});
  for (std::size_t i = 0; i < 50; ++i) right.append({{99, 1.0}});
  SparseRows result;
  kernels::sparse_composition(Sigma{}, left, right, result);
  ASSERT_EQ(result.rows(), 100U);
  ASSERT_EQ(result.stored(), 50U * 5000U);
  EXPECT_EQ(result.entries(49).size(), 0U);
  EXPECT_EQ(result.at(50, 4999), 0.25);
  EXPECT_EQ(result.at(99, 0), 0.25);
}

TEST(Sparse, ColumnsBeyond32BitsAreRefusedByTheirNumber) {
  SparseRows rows;
  EXPECT_INVALID(("2^32", "4294967296"), rows.append({{std::size_t{1} << 32, 1.0}}));
}

}  // namespace kernels_sparse_test
