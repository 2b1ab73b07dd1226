#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace sigmax::bench {

/// The EKF, UKF and CKF of a coordinated turn in space seen by a polar radar, as one writes them by hand with Eigen who
/// writes them well, but for a fixed step and without care: P − K S Kᵀ, no checks, nothing said of what went wrong.
class BareTurnFilter {
 public:
  using State = Eigen::Matrix<double, 7, 1>;  // x, y, z, vx, vy, vz, ω
  using Matrix = Eigen::Matrix<double, 7, 7>;

  State x;
  Matrix P;
  double log_likelihood = 0.0;

  BareTurnFilter(double T, double q, double q_omega, const State& mean, const Matrix& covariance)
      : x(mean), P(covariance), T_(T) {
    Q_.setZero();
    Q_.topLeftCorner<3, 3>().diagonal().setConstant(q * T * T * T / 3.0);
    Q_.block<3, 3>(0, 3).diagonal().setConstant(q * T * T / 2.0);
    Q_.block<3, 3>(3, 0).diagonal().setConstant(q * T * T / 2.0);
    Q_.block<3, 3>(3, 3).diagonal().setConstant(q * T);
    Q_(6, 6) = q_omega * T;
  }

 protected:
  double T_;
  Matrix Q_;

  /// What a turn by θ = ωT does: sin θ, 1 − cos θ and, of T at a time, sin θ/θ and (1 − cos θ)/θ.
  struct Arc {
    double theta, sine, versine, along, across;

    explicit Arc(double angle) : theta(angle) {
      const double half_sine = std::sin(0.5 * theta), half_cosine = std::cos(0.5 * theta);
      const bool straight = std::abs(theta) < 1e-4;
      sine = 2.0 * half_sine * half_cosine;
      versine = 2.0 * half_sine * half_sine;
      along = straight ? 1.0 - theta * theta / 6.0 : sine / theta;
      across = straight ? 0.5 * theta : versine / theta;
    }
  };

  State moved(const State& s, const Arc& arc) const {
    State result = s;
    result(0) += T_ * (arc.along * s(3) - arc.across * s(4));
    result(1) += T_ * (arc.across * s(3) + arc.along * s(4));
    result(2) += T_ * s(5);
    result(3) -= arc.versine * s(3) + arc.sine * s(4);
    result(4) += arc.sine * s(3) - arc.versine * s(4);
    return result;
  }

  static Eigen::Vector3d seen(const Eigen::Vector3d& p) {
    const double ground_squared = p(0) * p(0) + p(1) * p(1);
    return {std::sqrt(ground_squared + p(2) * p(2)), std::atan2(p(1), p(0)),
            std::atan2(p(2), std::sqrt(ground_squared))};
  }

  static double wrapped(double angle) {
    return std::abs(angle) <= std::numbers::pi ? angle : std::remainder(angle, 2.0 * std::numbers::pi);
  }

  /// The update by a residual, its covariance S and that of the state with it.
  void update(Eigen::Vector3d residual, const Eigen::Matrix3d& S, const Eigen::Matrix<double, 7, 3>& covariance) {
    residual(1) = wrapped(residual(1));
    const Eigen::LLT<Eigen::Matrix3d> root(S);
    const Eigen::Matrix3d L_inverse = root.matrixL().solve(Eigen::Matrix3d::Identity());
    const Eigen::Vector3d whitened = L_inverse * residual;
    const Eigen::Matrix<double, 7, 3> KL = covariance * L_inverse.transpose();
    x += KL * whitened;
    P -= KL * KL.transpose();
    constexpr double tau = 2.0 * std::numbers::pi;
    log_likelihood = -0.5 * whitened.squaredNorm() - std::log(root.matrixLLT().diagonal().prod()) - 1.5 * std::log(tau);
  }
};

class BareExtended : public BareTurnFilter {
 public:
  using BareTurnFilter::BareTurnFilter;

  void step(const Eigen::Vector3d& z, const Eigen::Matrix3d& R) {
    const Arc arc(x(6) * T_);
    const double theta = arc.theta, cosine = 1.0 - arc.versine, vx = x(3), vy = x(4);
    const bool straight = std::abs(theta) < 1e-4;
    const double along = straight ? -theta / 3.0 : (cosine - arc.along) / theta;  // derivatives by θ
    const double across = straight ? 0.5 - theta * theta / 8.0 : (arc.sine - arc.across) / theta;
    Matrix F = Matrix::Identity();
    F.block<2, 2>(0, 3) << T_ * arc.along, -T_ * arc.across, T_ * arc.across, T_ * arc.along;
    F.block<2, 2>(3, 3) << cosine, -arc.sine, arc.sine, cosine;
    F(2, 5) = T_;
    F(0, 6) = T_ * T_ * (along * vx - across * vy);
    F(1, 6) = T_ * T_ * (across * vx + along * vy);
    F(3, 6) = -T_ * (arc.sine * vx + cosine * vy);
    F(4, 6) = T_ * (cosine * vx - arc.sine * vy);
    x = moved(x, arc);
    P = (F * P * F.transpose() + Q_).eval();

    const Eigen::Vector3d p = x.head<3>(), predicted = seen(p);
    const double r = predicted(0), ground_squared = p(0) * p(0) + p(1) * p(1);
    const double ground = std::sqrt(ground_squared), scale = p(2) / (r * r * ground);
    Eigen::Matrix3d H;                                       // over the position
    H << p(0) / r, p(1) / r, p(2) / r,                       //
        -p(1) / ground_squared, p(0) / ground_squared, 0.0,  //
        -p(0) * scale, -p(1) * scale, ground / (r * r);
    const Eigen::Matrix<double, 7, 3> PHt = P.leftCols<3>() * H.transpose();
    update(z - predicted, H * PHt.topRows<3>() + R, PHt);
    P = (0.5 * (P + P.transpose())).eval();
  }
};

/// With points at x ± √7 Lᵢ of equal weight and, if `Centre`, at x with weight 0 for means and 2 for covariances: the
/// UKF with α = 1, β = 2, κ = 0, else the CKF.
template <bool Centre>
class BareSigmaPoints : public BareTurnFilter {
  template <int N>
  static void add_square(double weight, const Eigen::Matrix<double, N, 1>& d, Eigen::Matrix<double, N, N>& sum) {
    for (int j = 0; j < N; ++j) sum.col(j) += (weight * d(j)) * d;
  }

 public:
  using BareTurnFilter::BareTurnFilter;

  void step(const Eigen::Vector3d& z, const Eigen::Matrix3d& R) {
    constexpr double weight = 1.0 / 14.0;
    constexpr double centre_weight = 2.0;

    const Matrix spread = std::sqrt(7.0) * Eigen::LLT<Matrix>(P).matrixL().toDenseMatrix();
    Eigen::Matrix<double, 7, 14> states;
    states << spread, -spread;
    states.colwise() += x;
    for (int i = 0; i < 14; ++i) states.col(i) = moved(states.col(i), Arc(states(6, i) * T_));
    State centre;
    if constexpr (Centre) centre = moved(x, Arc(x(6) * T_));
    x = weight * states.rowwise().sum();
    P = Q_;
    for (int i = 0; i < 14; ++i) add_square<7>(weight, states.col(i) - x, P);
    if constexpr (Centre) add_square<7>(centre_weight, centre - x, P);

    const Matrix offsets = std::sqrt(7.0) * Eigen::LLT<Matrix>(P).matrixL().toDenseMatrix();
    Eigen::Matrix<double, 3, 14> measured;
    for (int i = 0; i < 7; ++i) {
      measured.col(i) = seen(x.head<3>() + offsets.col(i).head<3>());
      measured.col(7 + i) = seen(x.head<3>() - offsets.col(i).head<3>());
    }
    const Eigen::Vector3d first = Centre ? seen(x.head<3>()) : measured.col(0);
    measured.colwise() -= first;
    for (int i = 0; i < 14; ++i) measured(1, i) = wrapped(measured(1, i));
    const Eigen::Vector3d shift = weight * measured.rowwise().sum();
    Eigen::Matrix3d S = R;
    for (int i = 0; i < 14; ++i) add_square<3>(weight, measured.col(i) - shift, S);
    if constexpr (Centre) add_square<3>(centre_weight, shift, S);
    const Eigen::Matrix<double, 7, 3> covariance =
        weight * (offsets * (measured.leftCols<7>() - measured.rightCols<7>()).transpose());
    update(z - first - shift, S, covariance);
  }
};

using BareUnscented = BareSigmaPoints<true>;
using BareCubature = BareSigmaPoints<false>;

}  // namespace sigmax::bench
