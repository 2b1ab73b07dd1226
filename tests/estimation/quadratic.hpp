#pragma once

#include "estimation/restated.hpp"

namespace sigmax::support {

/// z = a + bᵀx + ½ xᵀAx; with one state f is the same function, and else f(x) = x; Q = 1.
inline OwnMotion quadratic(double a, const restatement::Vector& b, const restatement::Matrix& A) {
  using restatement::Matrix, restatement::Vector;
  const auto h = [=](const Vector& x) -> Vector {
    return {a + restatement::dot(b, x) + 0.5 * restatement::dot(x, A * x)};
  };
  const auto H = [=](const Vector& x) -> Matrix {
    Vector slope = A * x;
    for (std::size_t i = 0; i < b.size(); ++i) slope[i] += b[i];
    return {1, b.size(), slope};
  };
  const bool moves = b.size() == 1;
  return {{[=](const Vector& x, double) { return moves ? h(x) : x; },
           [=](const Vector& x, double) { return moves ? H(x) : restatement::identity(x.size()); },
           [n = b.size()](double) { return restatement::identity(n); },
           h,
           H,
           {false}},
          b.size()};
}

/// z = x² of one number with this mean and variance.
inline const OwnMotion square = quadratic(0.0, {0.0}, {1, 1, {2.0}});
inline EstimateOf<AnyModel> one_number(double mean, double variance) {
  return {Vector<1>(mean), SquareMatrix<1>(variance)};
}
inline MeasurementOf<OwnSensor> measured_number(double mean, double variance) {
  return {Vector<1>(mean), SquareMatrix<1>(variance)};
}

/// Drawn quadratics of drawn Gaussians, in whitened coordinates c + gᵀy + ½ yᵀBy: the member has the mean c + tr B/2,
/// the covariance with x, L g, and the variance(g, B) claimed.
inline void expect_quadratics(const std::function<AnyModel(const OwnMotion&)>& member_of,
                              const std::function<double(const Vector<3>& g, const SquareMatrix<3>& B)>& variance,
                              double curvature_in_mean = 1.0) {
  Draws draws(1);
  int compared = 0;
  for (int run = 0; run < 100; ++run) {
    const restatement::State state = draws.state(3);
    const restatement::Vector b = draws.vector(3);
    const restatement::Matrix A = restatement::symmetrised(draws.matrix(3, 3));
    const OwnMotion model = quadratic(draws.number(), b, A);
    const Gaussian<3> prior{vector_of(state.mean), matrix_of(state.covariance)};
    const auto z = measured_number(draws.number(-9.0, 9.0), 20.0);
    const SquareMatrix<3> L = Eigen::LLT<Eigen::MatrixXd>(prior.covariance).matrixL();
    const Vector<3> g = L.transpose() * (vector_of(b) + matrix_of(A) * prior.mean);
    const SquareMatrix<3> B = L.transpose() * matrix_of(A) * L;
    const double mean = model.model.h(state.mean)[0] + curvature_in_mean * 0.5 * B.trace();
    const double S = variance(g, B) + 20.0;
    if (S < g.squaredNorm() + 1.0) continue;  // the posterior is no Gaussian
    ++compared;

    EstimateOf<AnyModel> x;
    const auto innovation = update(member_of(model), {prior.mean, prior.covariance}, z, OwnSensor{model.model}, x);
    EXPECT_CLOSE(innovation.residual(0), z.mean(0) - mean, 1e-9);
    EXPECT_CLOSE(innovation.covariance(0), S, 1e-9);
    const Vector<3> cross = L * g;
    EXPECT_CLOSE(x.mean, prior.mean + cross / S * innovation.residual, 1e-9);
    EXPECT_CLOSE(x.covariance, prior.covariance - cross * cross.transpose() / S, 1e-9);
  }
  EXPECT_GT(compared, 50);
}

}  // namespace sigmax::support
