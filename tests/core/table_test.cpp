#include "support/core.hpp"

namespace table_test {

/// Shapes on both sides of what is stored inline, 16 numbers.
class TableOfAnyShape : public testing::TestWithParam<std::pair<std::size_t, std::size_t>> {
 protected:
  Table counted() const {
    Table table(GetParam().first, GetParam().second);
    std::iota(table.values().begin(), table.values().end(), 1.0);
    return table;
  }
  static bool is_counted(const Table& table) {
    double expected = 1.0;
    for (const double value : table.values())
      if (value != expected++) return false;
    return expected == static_cast<double>(table.size()) + 1.0;
  }
};

INSTANTIATE_TEST_SUITE_P(Shapes, TableOfAnyShape,
                         testing::Values(std::pair{1U, 1U}, std::pair{4U, 4U}, std::pair{1U, 16U}, std::pair{1U, 17U},
                                         std::pair{5U, 5U}, std::pair{17U, 1U}, std::pair{100U, 30U}),
                         [](const auto& test) {
                           return std::to_string(test.param.first) + "x" + std::to_string(test.param.second);
                         });

TEST_P(TableOfAnyShape, IsFilledWithOneValue) {
  const Table table(GetParam().first, GetParam().second, 0.25);
  ASSERT_EQ(table.size(), GetParam().first * GetParam().second);
  for (const double value : table.values()) EXPECT_EQ(value, 0.25);
}

TEST_P(TableOfAnyShape, IsStoredRowByRow) {
  Table table = counted();
  const auto [rows, columns] = GetParam();
  for (std::size_t r = 0; r < rows; ++r) {
    ASSERT_EQ(table.row(r).size(), columns);
    for (std::size_t c = 0; c < columns; ++c) {
      EXPECT_EQ(table(r, c), static_cast<double>(r * columns + c + 1));
      EXPECT_EQ(table.row(r)[c], table(r, c));
    }
  }
  table(rows - 1, columns - 1) = -1.0;
  EXPECT_EQ(std::as_const(table).values().back(), -1.0);
}

TEST_P(TableOfAnyShape, CopiesAreIndependent) {
  const Table original = counted();
  Table copy = original;
  EXPECT_TRUE(is_counted(copy));
  copy(0, 0) = 99.0;
  EXPECT_TRUE(is_counted(original));
  EXPECT_EQ(copy(0, 0), 99.0);
}

TEST_P(TableOfAnyShape, MovesKeepTheValues) {
  Table original = counted();
  Table moved = std::move(original);
  EXPECT_TRUE(is_counted(moved));
  Table assigned(2, 2);
  assigned = std::move(moved);
  EXPECT_TRUE(is_counted(assigned));
}

TEST_P(TableOfAnyShape, AssignsFromAndToOtherShapes) {
  Table small(1, 1, 7.0), large(20, 20, 7.0);
  small = counted();
  large = counted();
  EXPECT_TRUE(is_counted(small));
  EXPECT_TRUE(is_counted(large));
  large = Table(1, 1, 3.0);
  EXPECT_EQ(large.size(), 1U);
  EXPECT_EQ(large(0, 0), 3.0);
}

TEST(Table, ReshapesThereAndBack) {
  Table table(2, 3, 1.0);
  table.reshape(10, 10);
  EXPECT_EQ(table.rows(), 10U);
  EXPECT_EQ(table.columns(), 10U);
  EXPECT_EQ(table.values().size(), 100U);
  const double* const grown = table.data();
  table.reshape(3, 2);
  EXPECT_EQ(table.values().size(), 6U);
  table.reshape(10, 10);
  EXPECT_EQ(table.data(), grown);  // what was there is used again
}

TEST(Table, MayBeEmpty) {
  const Table table(0, 0);
  EXPECT_EQ(table.size(), 0U);
  EXPECT_TRUE(table.values().empty());
}

}  // namespace table_test
