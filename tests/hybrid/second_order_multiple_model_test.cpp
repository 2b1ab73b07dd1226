#include "hybrid/banks.hpp"

namespace second_order_multiple_model_test {

TEST(SecondOrderMultipleModel, RefusesAnUnsoundEstimateOfAnyMode) {
  const RandomVariable mode{"mode", 2};
  for (const int bad : {0, 1}) {
    Gaussian<2> starts[2]{{Vector<2>::Zero(), SquareMatrix<2>::Identity()},
                          {Vector<2>::Zero(), SquareMatrix<2>::Identity()}};
    starts[bad].covariance(1, 1) = -5.0;
    SecondOrderMultipleModel filter{std::tuple{dwna<1>(1.0), dwna<1>(2.0)}, identity(mode),
                                    std::tuple{starts[0], starts[1]}};
    EXPECT_REFUSED(std::domain_error, ("step 1", "not positive semi-definite"), filter.step(0.0)) << bad;
  }
}

}  // namespace second_order_multiple_model_test
