// What every member of the family refuses, and by which words.
#include <gtest/gtest.h>

#include <limits>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/sensors.hpp>

#include "estimation/members.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;
using support::with_default_members;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(MemberRefusals, OfAMeasurementThatIsNotFiniteAndNamesTheModel) {
  const auto model = dwna<2>(1.0);
  const PolarSensor<2> radar;
  const Gaussian<4> prior{Vector<4>(100.0, 0.0, 0.0, 0.0), SquareMatrix<4>::Identity()};
  const SquareMatrix<2> R = SquareMatrix<2>::Identity();
  with_default_members(model, [&](const auto& member) {
    Gaussian<4> x = prior;
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
      EXPECT_TRUE(throws<std::invalid_argument>(
          [&] {
            update(member, prior, {Vector<2>(bad, 0.1), R}, radar, x);
          },
          {"measurement", "dwna", "not finite"}));
      EXPECT_TRUE(throws<std::invalid_argument>(
          [&] {
            update(member, prior, {Vector<2>(1.0, 0.1), SquareMatrix<2>(bad * R)}, radar, x);
          },
          {"measurement", "dwna", "not finite"}));
    }
    EXPECT_EQ(x.mean, prior.mean) << "the estimate is as it was";
  });
  Gaussian<4> x;
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        update(dwna<2>(1.0), prior, {Vector<2>(nan, 0.1), R}, x);
      },
      {"measurement", "dwna", "not finite"}));
}

TEST(MemberRefusals, OfACovarianceThatLostItsDefiniteness) {
  const CoordinatedTurn<2> model{1.0, 0.1};
  const PolarSensor<2> radar;
  Gaussian<5> prior{Vector<5>(100.0, 50.0, 1.0, 1.0, 0.1), SquareMatrix<5>::Identity()};
  prior.covariance(3, 3) = -1e-6;
  const Gaussian<2> z{Vector<2>(100.0, 0.5), SquareMatrix<2>::Identity()};
  const auto refuses = [&](const auto& member) {
    Gaussian<5> x;
    EXPECT_TRUE(throws<std::domain_error>([&] { predict(member, prior, 1.0, x); },
                                          {"covariance", "coordinated_turn", "not positive semi-definite", "4"}));
    EXPECT_TRUE(throws<std::domain_error>([&] { update(member, prior, z, radar, x); },
                                          {"covariance", "coordinated_turn", "not positive semi-definite"}));
  };
  refuses(Unscented{model});
  refuses(Cubature{model});

  prior.covariance = -SquareMatrix<5>::Identity() * 100.0;
  Gaussian<5> x;
  EXPECT_TRUE(throws<std::domain_error>([&] { update(Extended{model}, prior, z, radar, x); },
                                        {"innovation covariance", "coordinated_turn", "not positive definite"}));
}

TEST(MemberRefusals, OfAnEstimateThatIsNotFinite) {
  const auto model = dwna<2>(1.0);
  const PolarSensor<2> radar;
  const Gaussian<2> z{Vector<2>(100.0, 0.5), SquareMatrix<2>::Identity()};
  const Gaussian<4> unknown{Vector<4>(nan, 50.0, 1.0, 1.0), SquareMatrix<4>::Identity()};
  Gaussian<4> x;
  with_default_members(model, [&](const auto& member) {
    EXPECT_TRUE(throws<std::domain_error>([&] { update(member, unknown, z, radar, x); }, {"dwna", "not finite"}));
  });
  EXPECT_TRUE(throws<std::domain_error>([&] { update(dwna<2>(1.0), unknown, z, x); }, {"estimate", "dwna"}));
}

/// f has a pole at 0 and h at 1.
struct Poles {
  static constexpr int state_size = 1;
  static constexpr int max_state_size = 1;
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  Eigen::Index size() const { return 1; }
  std::string_view name() const { return "poles"; }
  std::vector<std::string> components() const { return {"x"}; }
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> propagate(const Eigen::Matrix<Scalar, 1, 1>& x, double) const {
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(1.0 / x(0)));
  }
  SquareMatrix<1> process_covariance(double) const { return SquareMatrix<1>(1.0); }
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 1, 1>& x) const {
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(1.0 / (x(0) - 1.0)));
  }
};

TEST(MemberRefusals, OfAFunctionThatIsNotFiniteAndNamesTheState) {
  const Gaussian<1> z{Vector<1>(1.0), SquareMatrix<1>(1.0)};
  const auto at = [](double x) { return Gaussian<1>{Vector<1>(x), SquareMatrix<1>(1.0)}; };
  Gaussian<1> x;
  const auto refuses = [&](const auto& member, double pole_of_f, double pole_of_h) {
    EXPECT_TRUE(throws<std::domain_error>([&] { predict(member, at(pole_of_f), 1.0, x); },
                                          {"f", "poles", "not finite", "x = (0"}));
    EXPECT_TRUE(throws<std::domain_error>([&] { update(member, at(pole_of_h), z, Poles{}, x); },
                                          {"h", "poles", "not finite", "x = (1"}));
  };
  refuses(Extended{Poles{}}, 0.0, 1.0);
  refuses(Unscented{Poles{}}, 0.0, 1.0);
  refuses(Cubature{Poles{}}, 1.0, 2.0);  // its points are one deviation from the mean
}

}  // namespace
}  // namespace sigmax
