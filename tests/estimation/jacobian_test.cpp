#include "support/sigmax.hpp"

namespace jacobian_test {

PROPERTY(Jacobian, IsThatOfTheFormula) {
  const Vector<3> x = generated_matrix<3, 1>();
  const auto f = [](const auto& v) {
    using Scalar = typename std::remove_cvref_t<decltype(v)>::Scalar;
    return Eigen::Matrix<Scalar, 2, 1>(Scalar(v(0) * v(1) + exp(v(2))), Scalar(sqrt(1.0 + v(0) * v(0))));
  };
  RectangularMatrix<2, 3> expected;
  expected << x(1), x(0), std::exp(x(2)), x(0) / std::sqrt(1.0 + x(0) * x(0)), 0.0, 0.0;
  require_near(jacobian<2, 2, 3, 3>(f, x), expected, 1e-14);

  const Vector<Eigen::Dynamic, 5> run_time = x;
  require_near(jacobian<2, 2, Eigen::Dynamic, 5>(f, run_time), expected, 1e-14);
}

TEST(Jacobian, OfAConstantIsZero) {
  const Vector<Eigen::Dynamic, 4> x = Vector<3>(1.0, 2.0, 3.0);
  const auto found = jacobian<1, 1, Eigen::Dynamic, 4>(
      [](const DifferentiableVector<Eigen::Dynamic, 4>& v) {
        using Scalar = typename std::remove_cvref_t<decltype(v)>::Scalar;
        return Eigen::Matrix<Scalar, 1, 1>(Scalar(7.0));
      },
      x);
  EXPECT_EQ(found, (RectangularMatrix<1, 3>::Zero()));
}

}  // namespace jacobian_test
