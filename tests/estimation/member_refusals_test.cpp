// What every member of the family refuses, and by which words.

#include "estimation/restated.hpp"

namespace member_refusals_test {

using Prior = EstimateOf<AnyModel>;

const PolarSensor<2> radar;

TEST(MemberRefusals, OfAMeasurementThatIsNotFiniteAndNamesTheModel) {
  const Prior prior{Vector<4>(100.0, 0.0, 0.0, 0.0), SquareMatrix<4>::Identity()};
  auto filters = every_member(dwna<2>(1.0));
  filters.emplace_back(dwna<2>(1.0));
  for (const AnyModel& filter : filters)
    for (const double bad : {not_a_number, infinity}) {
      const Gaussian<2> place{Vector<2>(bad, 0.1), SquareMatrix<2>::Identity()},
          spread{Vector<2>(1.0, 0.1), bad * SquareMatrix<2>::Identity()};
      for (const auto& z : {place, spread}) {
        const std::initializer_list<std::string_view> words{"measurement", "dwna", "not finite"};
        EXPECT_TRUE(throws<std::invalid_argument>([&] { update(filter, prior, z, radar); }, words));
        EXPECT_TRUE(throws<std::invalid_argument>([&] { update(filter, prior, z, PositionSensor<2>{}); }, words));
      }
    }
}

TEST(MemberRefusals, OfACovarianceThatLostItsDefiniteness) {
  const CoordinatedTurn<2> model{1.0, 0.1};
  Prior prior{Vector<5>(100.0, 50.0, 1.0, 1.0, 0.1), SquareMatrix<5>::Identity()};
  prior.covariance(3, 3) = -1e-6;
  const Gaussian<2> z{Vector<2>(100.0, 0.5), SquareMatrix<2>::Identity()};
  for (const AnyModel& member : {AnyModel{Unscented{model}}, AnyModel{Cubature{model}}}) {
    const std::initializer_list<std::string_view> words{"covariance", "coordinated_turn", "not positive semi-definite",
                                                        "component 4"};
    EXPECT_TRUE(throws<std::domain_error>([&] { predict(member, prior, 1.0); }, words));
    EXPECT_TRUE(throws<std::domain_error>([&] { update(member, prior, z, radar); }, words));
  }
  prior.covariance = -SquareMatrix<5>::Identity() * 100.0;
  EXPECT_REFUSED(std::domain_error, ("innovation covariance", "coordinated_turn", "not positive definite"),
                 update(AnyModel{Extended{model}}, prior, z, radar));
}

TEST(MemberRefusals, OfAnEstimateThatIsNotFinite) {
  const Gaussian<2> z{Vector<2>(100.0, 0.5), SquareMatrix<2>::Identity()};
  const Prior unknown{Vector<4>(not_a_number, 50.0, 1.0, 1.0), SquareMatrix<4>::Identity()};
  for (const AnyModel& member : every_member(dwna<2>(1.0)))
    EXPECT_REFUSED(std::domain_error, ("dwna", "not finite"), update(member, unknown, z, radar));
  EXPECT_REFUSED(std::domain_error, ("estimate", "dwna", "not finite"),
                 update(AnyModel{dwna<2>(1.0)}, unknown, z, PositionSensor<2>{}));
}

/// f has a pole at 0 and h at 1, and their slopes at 2 and at 3.
TEST(MemberRefusals, OfAFunctionThatIsNotFiniteAndNamesTheState) {
  using restatement::Matrix, restatement::Vector;
  const auto pole = [](double x, double at) { return 1.0 / std::abs(x - at); };
  const OwnMotion poles{{[=](const Vector& x, double) -> Vector { return {pole(x[0], 0.0)}; },
                         [=](const Vector& x, double) -> Matrix {
                           return {1, 1, {pole(x[0], 2.0)}};
                         },
                         [](double) { return restatement::identity(1); },
                         [=](const Vector& x) -> Vector { return {pole(x[0], 1.0)}; },
                         [=](const Vector& x) -> Matrix {
                           return {1, 1, {pole(x[0], 3.0)}};
                         },
                         {false}},
                        1};
  const Gaussian<1> z{sigmax::Vector<1>(1.0), SquareMatrix<1>(1.0)};
  const auto refuses = [&](const AnyModel& member, double of_f, double of_h, const char* f, const char* h,
                           const char* x_of_f, const char* x_of_h) {
    const auto at = [](double x) { return Prior{sigmax::Vector<1>(x), SquareMatrix<1>(1.0)}; };
    EXPECT_REFUSED(std::domain_error, (f, "own", "not finite", x_of_f), predict(member, at(of_f), 1.0));
    EXPECT_REFUSED(std::domain_error, (h, "own", "not finite", x_of_h),
                   update(member, at(of_h), {z.mean, z.covariance}, OwnSensor{poles.model}));
  };
  refuses(Extended{poles}, 0.0, 1.0, "f(x)", "h(x)", "x = (0.0", "x = (1.0");
  refuses(Extended{poles}, 2.0, 3.0, "the Jacobian of f", "the Jacobian of h", "x = (2.0", "x = (3.0");
  refuses(Unscented{poles}, 0.0, 1.0, "f(x)", "h(x)", "x = (0.0", "x = (1.0");
  refuses(Cubature{poles}, 1.0, 2.0, "f(x)", "h(x)", "x = (0.0", "x = (1.0");  // its points are one from the mean
}

}  // namespace member_refusals_test
