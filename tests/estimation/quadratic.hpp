#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Cholesky>

#include <sigmax/estimation/nonlinear_motion.hpp>

#include "estimation/members.hpp"

namespace sigmax::support {

/// The motion and the sensor of z = a + bᵀx + ½ xᵀAx, which sees all of the state; with one state f is the same
/// function; Q = 1.
template <int N>
struct Quadratic {
  static constexpr int state_size = N;
  static constexpr int max_state_size = N;
  static constexpr int seen_size = N;
  static constexpr int measurement_size = 1;
  double a = 0.0;
  Vector<N> b = Vector<N>::Zero();
  SquareMatrix<N> A = SquareMatrix<N>::Zero();

  Eigen::Index size() const { return N; }
  std::string_view name() const { return "quadratic"; }
  std::vector<std::string> components() const { return std::vector<std::string>(N, "x"); }
  template <class Scalar>
  Eigen::Matrix<Scalar, N, 1> propagate(const Eigen::Matrix<Scalar, N, 1>& x, double) const {
    if constexpr (N == 1)
      return measure(x);
    else
      return x;
  }
  SquareMatrix<N> process_covariance(double) const { return SquareMatrix<N>::Identity(); }
  template <class Scalar>
  Eigen::Matrix<Scalar, 1, 1> measure(const Eigen::Matrix<Scalar, N, 1>& x) const {
    Scalar z(a);
    for (int i = 0; i < N; ++i) {
      z += b(i) * x(i);
      for (int k = 0; k < N; ++k) z += 0.5 * A(i, k) * x(i) * x(k);
    }
    return Eigen::Matrix<Scalar, 1, 1>(z);
  }
};

/// A generated quadratic of a generated Gaussian, in whitened coordinates c + gᵀy + ½ yᵀBy: the member has the mean
/// c + tr B/2, the covariance with x, L g, and the variance(g, B) claimed. `member_of(model)` gives the member.
template <class MemberOf, class Variance>
void require_quadratic(const MemberOf& member_of, const Variance& variance, double curvature_in_mean = 1.0) {
  const auto prior = generated_gaussian<3>();
  const Quadratic<3> model{number_between(-1.0, 1.0), generated_matrix<3, 1>(),
                           fixed<3, 3>(restatement::symmetrised(generated(3, 3)))};
  const Gaussian<1> z{Vector<1>(number_between(-9.0, 9.0)), SquareMatrix<1>(20.0)};
  const SquareMatrix<3> L = Eigen::LLT<SquareMatrix<3>>(prior.covariance).matrixL();
  const Vector<3> g = L.transpose() * (model.b + model.A * prior.mean);
  const SquareMatrix<3> B = L.transpose() * model.A * L;
  const double mean = model.measure(prior.mean)(0) + curvature_in_mean * 0.5 * B.trace();
  const double S = variance(g, B) + 20.0;

  Gaussian<3> x;
  RC_PRE(S > g.squaredNorm() + 1.0);  // else the posterior is no Gaussian
  const auto innovation = update(member_of(model), prior, z, model, x);
  require_near(innovation.residual(0), z.mean(0) - mean, 1e-9);
  require_near(innovation.covariance(0), S, 1e-9);
  const Vector<3> cross = L * g;
  require_near_matrix(x.mean, prior.mean + cross / S * innovation.residual, 1e-9);
  require_near_matrix(x.covariance, prior.covariance - cross * cross.transpose() / S, 1e-9);
}

}  // namespace sigmax::support
