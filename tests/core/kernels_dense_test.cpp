#include "laws/generate.hpp"

namespace kernels_dense_test {

TEST(DenseCompose, GivesTheResultItsShape) {
  const Table left(3, 7, 0.5), right(5, 3, 0.5);
  Table result(1, 1);
  kernels::compose<Sigma>(left, right, result);
  EXPECT_EQ(result.rows(), 5U);
  EXPECT_EQ(result.columns(), 7U);
  for (const double value : result.values()) EXPECT_EQ(value, 0.75);
  kernels::compose<Max>(Table(1, 1, 0.5), Table(1, 1, 0.5), result);
  EXPECT_EQ(result.size(), 1U);
  EXPECT_EQ(result(0, 0), 0.25);
}

TEST(DenseCompose, IsThePlainTripleLoopForAnyShape) {
  for (const std::size_t n : {1U, 2U, 4U, 5U, 17U, 40U}) {
    Table left_table(n, n + 2), right_table(n + 1, n);
    const auto number = [](std::size_t i) { return static_cast<double>((i * 7919U) % 101U) / 100.0; };
    for (std::size_t i = 0; i < left_table.size(); ++i) left_table.data()[i] = number(i);
    for (std::size_t i = 0; i < right_table.size(); ++i) right_table.data()[i] = number(i + 37);
    const Rows left = rows_of(left_table), right = rows_of(right_table);
    Table result(0, 0);
    kernels::compose<Sigma>(left_table, right_table, result);
    const Rows sum = plain::compose(plain::By::sum, left, right);
    for (std::size_t i = 0; i <= n; ++i) EXPECT_CLOSE(result.row(i), sum[i], 1e-13);
    kernels::compose<Max>(left_table, right_table, result);
    const Rows max = plain::compose(plain::By::max, left, right);
    for (std::size_t i = 0; i <= n; ++i) EXPECT_CLOSE(result.row(i), max[i], 1e-15);
  }
}

}  // namespace kernels_dense_test
