#include <sigmax/estimation/view.hpp>

#include <gtest/gtest.h>

namespace sigmax {
namespace {

TEST(View, IsOfTheNumbersWhereTheyLie) {
  Gaussian<2> x{Vector<2>(1.0, 2.0), SquareMatrix<2>{{3.0, 4.0}, {4.0, 5.0}}};
  const detail::View view = detail::view(x);
  view.mean[1] = 7.0;
  view.covariance[2] = 8.0;  // by columns
  EXPECT_EQ(view.n, 2);
  EXPECT_EQ(x.mean(1), 7.0);
  EXPECT_EQ(x.covariance(0, 1), 8.0);
  const detail::ConstView read = view;
  EXPECT_EQ(read.mean, x.mean.data());
  EXPECT_EQ(read.covariance, x.covariance.data());
  EXPECT_EQ(read.n, 2);
}

TEST(View, MayBeSized) {
  Gaussian<Eigen::Dynamic, 5> x;
  EXPECT_EQ(detail::sized_view(x, 3).n, 3);
  EXPECT_EQ(x.covariance.cols(), 3);
}

}  // namespace
}  // namespace sigmax
