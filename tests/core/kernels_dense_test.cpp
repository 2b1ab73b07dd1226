#include "support/plain.hpp"

namespace {

Table table(std::size_t rows, std::size_t columns, const std::vector<double>& values) {
  Table result(rows, columns);
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

TEST(DenseCompose, IsSumProductOrMaxProduct) {
  const Table left = table(2, 2, {0.9, 0.1, 0.3, 0.7}), right = table(1, 2, {0.5, 1.0});
  Table result(1, 1, 42.0);  // what was there does not matter
  kernels::compose<Sigma>(left, right, result);
  EXPECT_CLOSE(result.values(), (std::vector{0.75, 0.75}), 1e-15);
  kernels::compose<Max>(left, right, result);
  EXPECT_CLOSE(result.values(), (std::vector{0.45, 0.7}), 1e-15);
}

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
    plain::Rows left(n), right(n + 1);
    Table left_table(n, n + 2), right_table(n + 1, n);
    const auto number = [](std::size_t i) { return static_cast<double>((i * 7919U) % 101U) / 100.0; };
    for (std::size_t i = 0; i < left_table.size(); ++i) left_table.data()[i] = number(i);
    for (std::size_t i = 0; i < right_table.size(); ++i) right_table.data()[i] = number(i + 37);
    for (std::size_t i = 0; i < n; ++i) left[i].assign(left_table.row(i).begin(), left_table.row(i).end());
    for (std::size_t i = 0; i <= n; ++i) right[i].assign(right_table.row(i).begin(), right_table.row(i).end());
    Table result(0, 0);
    kernels::compose<Sigma>(left_table, right_table, result);
    const plain::Rows sum = plain::compose(plain::By::sum, left, right);
    for (std::size_t i = 0; i <= n; ++i) EXPECT_CLOSE(result.row(i), sum[i], 1e-13);
    kernels::compose<Max>(left_table, right_table, result);
    const plain::Rows max = plain::compose(plain::By::max, left, right);
    for (std::size_t i = 0; i <= n; ++i) EXPECT_CLOSE(result.row(i), max[i], 1e-15);
  }
}

}  // namespace
