#pragma once

#include "support/linearised.hpp"
#include "support/nonlinear_restatement.hpp"

/// Models of any size, drawn, as the restatement has them and as a user gives them to the library.
namespace sigmax::support {

/// Numbers without a pattern, the same in every run.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : generator_(seed) {}

  double number(double low = -1.0, double high = 1.0) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  restatement::Matrix matrix(std::size_t rows, std::size_t columns) {
    restatement::Matrix result(rows, columns);
    for (double& value : result.values) value = number();
    return result;
  }
  restatement::Vector vector(std::size_t n) { return matrix(n, 1).values; }
  /// With eigenvalues from 0.5 on.
  restatement::Matrix covariance(std::size_t n) {
    const auto A = matrix(n, n);
    return restatement::symmetrised(A * restatement::transposed(A) + 0.5 * restatement::identity(n));
  }
  restatement::State state(std::size_t n) { return {vector(n), covariance(n)}; }

 private:
  std::mt19937_64 generator_;
};

/// f(x) = F x + u + bend · sin x, component by component, and h(x) = H x + bend · sin x₁; linear without a bend.
inline restatement::NonlinearModel bent(const restatement::Matrix& F, const restatement::Vector& u,
                                        const restatement::Matrix& Q, const restatement::Matrix& H, double bend) {
  using restatement::Matrix, restatement::Vector;
  return {[=](const Vector& x, double) {
            Vector y = F * x;
            for (std::size_t i = 0; i < y.size(); ++i) y[i] += u[i] + bend * std::sin(x[i]);
            return y;
          },
          [=](const Vector& x, double) {
            Matrix slope = F;
            for (std::size_t i = 0; i < x.size(); ++i) slope(i, i) += bend * std::cos(x[i]);
            return slope;
          },
          [=](double) { return Q; },
          [=](const Vector& x) {
            Vector z = H * x;
            for (double& number : z) number += bend * std::sin(x[0]);
            return z;
          },
          [=](const Vector& x) {
            Matrix slope = H;
            for (std::size_t i = 0; i < H.rows; ++i) slope(i, 0) += bend * std::cos(x[0]);
            return slope;
          },
          std::vector<bool>(H.rows, false)};
}

/// A drawn one of n states and m measured numbers, which see the first k states.
inline restatement::NonlinearModel drawn_model(Draws& draws, std::size_t n, std::size_t m, std::size_t k, double bend) {
  restatement::Matrix H(m, n);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < k; ++j) H(i, j) = draws.number();
  return bent(draws.matrix(n, n), draws.vector(n), draws.covariance(n), H, bend);
}

/// The same as an estimate of a model's state, or as a measurement of a sensor.
template <class Asked>
auto estimate_of(const restatement::State& state) {
  const Estimate same = estimate_of(state);
  if constexpr (Sensing<Asked>)
    return MeasurementOf<Asked>{same.mean, same.covariance};
  else
    return EstimateOf<Asked>{same.mean, same.covariance};
}

/// The motion of a restated model as a user's own, with its Jacobian.
struct OwnMotion {
  static constexpr int state_size = Eigen::Dynamic;
  static constexpr int max_state_size = 40;
  using State = Vector<Eigen::Dynamic, 40>;
  using Matrix = SquareMatrix<Eigen::Dynamic, 40>;

  restatement::NonlinearModel model;
  std::size_t n;

  Eigen::Index size() const { return static_cast<Eigen::Index>(n); }
  std::string_view name() const { return "own"; }
  std::vector<std::string> components() const { return std::vector<std::string>(n, "x"); }
  State propagate(const State& x, double dt) const { return vector_of(model.f(entries(x), dt)); }
  Matrix transition_jacobian(const State& x, double dt) const { return matrix_of(model.F(entries(x), dt)); }
  Matrix process_covariance(double dt) const { return matrix_of(model.Q(dt)); }
};

/// The same of a linear one.
struct OwnLinearMotion {
  static constexpr int state_size = Eigen::Dynamic;
  static constexpr int max_state_size = 40;
  OwnMotion own;

  Eigen::Index size() const { return own.size(); }
  std::string_view name() const { return "linear"; }
  std::vector<std::string> components() const { return own.components(); }
  OwnMotion::Matrix transition(double dt) const { return own.transition_jacobian(known_input(dt), dt); }
  OwnMotion::Matrix process_covariance(double dt) const { return own.process_covariance(dt); }
  OwnMotion::State known_input(double dt) const { return own.propagate(OwnMotion::State::Zero(size()), dt); }
};

/// What the restated model measures, as a user's own sensor, which asks for the whole state.
struct OwnSensor {
  static constexpr int measurement_size = Eigen::Dynamic;
  static constexpr int max_measurement_size = 6;
  restatement::NonlinearModel model;

  template <class Model>
  Vector<Eigen::Dynamic, 6> measure(const Model&, const StateOf<Model>& x) const {
    return vector_of(model.h(entries(x)));
  }
  template <class Model>
  MeasurementMatrixOf<OwnSensor, Model> measurement_jacobian(const Model&, const StateOf<Model>& x) const {
    return matrix_of(model.H(entries(x)));
  }
};

/// One that asks the model: the last component, whatever it is, squared.
struct SquaredLast {
  static constexpr int measurement_size = 1;
  template <class Model, class State>
  auto measure(const Model& model, const State& x) const {
    const auto last = x(model.size() - 1);
    return Eigen::Matrix<typename State::Scalar, 1, 1>(typename State::Scalar(last * last));
  }
};

/// Every member of the family over a motion.
template <class Moves>
std::vector<AnyModel> every_member(const Moves& motion) {
  return {Extended{motion}, Unscented{motion}, Unscented{motion, {0.5, 2.0, 1.0}}, Unscented{motion, {1.5, 0.5, -0.2}},
          Cubature{motion}};
}

/// All that a filter or smoother asks of two models is the same to the bit.
template <class Found, class Expected>
void expect_the_same(const Found& found, const Expected& expected) {
  SCOPED_TRACE(testing::Message() << expected.name() << ", " << expected.size() << " states");
  const auto n = expected.size();
  ASSERT_EQ(found.size(), n);
  EXPECT_EQ(found.name(), expected.name());
  EXPECT_EQ(found.components(), expected.components());
  EstimateOf<Expected> start{StateOf<Expected>::LinSpaced(n, 40.0, 1.0), StateMatrixOf<Expected>::Constant(n, n, 0.5)};
  start.covariance.diagonal().setLinSpaced(n, 1.0, 2.0);
  const EstimateOf<Found> same{start.mean, start.covariance};
  EXPECT_CLOSE(predict(found, same, 0.7), predict(expected, start, 0.7), 0.0);
  EXPECT_EQ(prediction_covariance(found, same, 0.7), prediction_covariance(expected, start, 0.7));
  const auto step = linearised_step(found, same, 0.7);
  const auto expected_step = linearised_step(expected, start, 0.7);
  EXPECT_EQ(step.mean, expected_step.mean);
  EXPECT_EQ(step.F, expected_step.F);
  EXPECT_EQ(step.Q, expected_step.Q);
}

}  // namespace sigmax::support
