#include "support/sigmax.hpp"

namespace view_test {

TEST(View, IsOfTheNumbersWhereTheyLie) {
  Gaussian<Eigen::Dynamic, 5> x;
  const detail::View view = detail::sized_view(x, 2);
  x.mean << 1.0, 2.0;
  x.covariance << 3.0, 4.0, 5.0, 6.0;
  const detail::ConstView read = detail::view(std::as_const(x)), same = view;
  EXPECT_EQ(same.covariance, read.covariance);
  EXPECT_EQ(read.n, 2);
  EXPECT_EQ(read.mean[1], 2.0);
  EXPECT_EQ(read.covariance[1], 5.0) << "by columns";
}

}  // namespace view_test
