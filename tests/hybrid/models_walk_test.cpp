// The code of docs/models.md, and the values that it claims.

#include "support/linearised.hpp"

namespace models_walk_test {

TEST(ModelsWalk, AStep) {
  const Unscented filter{CoordinatedTurn<3>{1.0, 0.01}};
  Gaussian<7> x{Vector<7>(8e3, 6e3, 1e3, -50.0, 80.0, 0.0, 0.05), 100.0 * SquareMatrix<7>::Identity()};
  x.covariance(6, 6) = 0.01;
  const auto z =
      PolarSensor<3>{}.measurement({10.05e3, degrees(37.2), degrees(5.7)}, {10.0, degrees(0.1), degrees(0.1)});
  predict(filter, x, 0.2, x);
  const auto innovation = update(filter, x, z, x);
  EXPECT_TRUE(std::isfinite(innovation.log_likelihood));
  EXPECT_EQ(innovation.residual.size(), 3);
}

TEST(ModelsWalk, ModesOfAMultipleModelFilter) {
  const FuzzyVariable mode{"mode", {"straight", "turn"}};
  const Relation transition{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}};
  Gaussian<7> start{Vector<7>(8e3, 6e3, 1e3, -50.0, 80.0, 0.0, 0.0), 100.0 * SquareMatrix<7>::Identity()};
  start.covariance(6, 6) = 0.01;
  InteractingMultipleModel filter{std::tuple{dwna<3>(3.0), Extended{CoordinatedTurn<3>{1.0, 0.01}}}, transition, start};
  filter.step(0.2, {Vector<3>(7990.0, 6016.0, 1000.0), 25.0 * SquareMatrix<3>::Identity()});
  EXPECT_EQ(filter.components(), (std::vector<std::string>{"x", "y", "z", "vx", "vy", "vz", "omega"}));
  EXPECT_CLOSE(filter.belief()[filter.most_likely_mode()], 1.0, 1e-15);
}

/// A pendulum.
struct Pendulum {
  static constexpr int state_size = 2;
  static constexpr int max_state_size = 2;
  Eigen::Index size() const { return 2; }
  std::string_view name() const { return "pendulum"; }
  std::vector<std::string> components() const { return {"angle", "rate"}; }
  template <class Scalar>
  Eigen::Matrix<Scalar, 2, 1> propagate(const Eigen::Matrix<Scalar, 2, 1>& x, double dt) const {
    using std::sin;
    const Scalar rate = x(1) - 9.81 * dt * sin(x(0));
    return {Scalar(x(0) + dt * rate), rate};
  }
  SquareMatrix<2> process_covariance(double dt) const { return 0.01 * dt * SquareMatrix<2>::Identity(); }
};

/// What one sees of it: how far it swings to a side.
struct Sideways {
  static constexpr int seen_size = 1;
  static constexpr int measurement_size = 1;
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, 1, 1>& x) const {
    using std::sin;
    return Eigen::Matrix<Scalar, 1, 1>(Scalar(sin(x(0))));
  }
};

TEST(ModelsWalk, AModelOfOnesOwn) {
  Gaussian<2> swing{Vector<2>(1.0, 0.0), 0.1 * SquareMatrix<2>::Identity()};
  const Extended pendulum{Pendulum{}};
  predict(pendulum, swing, 0.01, swing);
  update(pendulum, swing, {Vector<1>(0.8), SquareMatrix<1>(0.01)}, Sideways{}, swing);
  EXPECT_LT(swing.covariance(0, 0), 0.1);
  const Gaussian<2> at_rest{Vector<2>(0.0, 0.0), SquareMatrix<2>::Identity()};
  EXPECT_CLOSE(linearised_step(pendulum, at_rest, 0.1).F, (SquareMatrix<2>{{1.0 - 0.0981, 0.1}, {-0.981, 1.0}}), 1e-15);
}

TEST(ModelsWalk, Conversion) {
  const Polar seen{145e3, degrees(33.7), degrees(7.9)}, sigma{100.0, degrees(2.9), degrees(2.9)};
  const Gaussian<3> z = to_cartesian(seen, sigma, Conversion::unbiased);  // to_cartesian<2> in the plane
  EXPECT_GT(z.mean.norm(), 145e3);
}

}  // namespace models_walk_test
