#include "support/sigmax.hpp"

namespace sound_test {

const AnyModel model = dwna<1>(1.0);

TEST(Sound, AnEstimateIsFiniteAndItsVariancesAreNotNegative) {
  const auto sound = [](double x, double a, double b) {
    const Gaussian<2> estimate{Vector<2>(x, 0.0), SquareMatrix<2>{{a, 0.0}, {0.0, b}}};
    check::sound(model, detail::view(estimate));
  };
  EXPECT_NO_THROW(sound(1.0, 4.0, 0.0));
  EXPECT_NO_THROW(sound(1.0, 4.0, -1e-12)) << "that is rounding";
  EXPECT_REFUSED(std::domain_error, ("dwna", "not positive semi-definite"), sound(1.0, 4.0, -1e-10));
  EXPECT_REFUSED(std::domain_error, ("dwna", "not finite"), sound(not_a_number, 4.0, 1.0));
  EXPECT_REFUSED(std::domain_error, ("dwna", "not finite"), sound(1.0, not_a_number, 1.0));
  EXPECT_REFUSED(std::domain_error, ("not finite"), sound(1.0, infinity, 1.0));
}

TEST(Sound, ThereIsAStartForEachModelOfItsSize) {
  const std::vector<AnyModel> models{dwna<1>(1.0), dwpa<1>(1.0)};
  Estimates starts = detail::estimates_of(models);
  EXPECT_NO_THROW(check::starts(models, starts));
  starts[1].covariance(2, 2) = infinity;
  EXPECT_INVALID(("dwpa", "not finite"), check::starts(models, starts));
  EXPECT_INVALID(("3", "2"), check::starts({model, model, model}, starts));
  EXPECT_INVALID(("dwna", "3", "2"), check::starts({model, model}, starts));
}

TEST(Sound, TheNumbersOfAnEntryPriorArePositive) {
  EXPECT_NO_THROW(check::prior({}));
  EXPECT_INVALID(("no scale"), check::prior({.scales = {}}));
  EXPECT_INVALID(("scale", "-3", "positive"), check::prior({.scales = {3.0, -3.0}}));
  EXPECT_INVALID(("vertical share", "0.0", "positive"), check::prior({.vertical = 0.0}));
  EXPECT_INVALID(("turn rate", "inf"), check::prior({.turn_rate = infinity}));
}

}  // namespace sound_test
