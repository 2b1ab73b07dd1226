#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace sigmax::bench {

/// The Kalman filter as one writes it down: a dense H, and Joseph's form with whole matrices.
struct PlainUpdate {
  /// Predicts and updates, and returns the likelihood.
  template <int N>
  static double filter(const Eigen::Matrix<double, N, N>& F, const Eigen::Matrix<double, N, N>& Q,
                       const Eigen::Vector3d& z, const Eigen::Matrix3d& R, Eigen::Matrix<double, N, 1>& m,
                       Eigen::Matrix<double, N, N>& C) {
    static const Eigen::Matrix<double, 3, N> H = Eigen::Matrix<double, 3, N>::Identity();
    m = (F * m).eval();
    C = (F * C * F.transpose() + Q).eval();
    const Eigen::Vector3d v = z - H * m;
    const Eigen::Matrix3d S = H * C * H.transpose() + R;
    const Eigen::Matrix3d S_inverse = S.inverse();
    const Eigen::Matrix<double, N, 3> K = C * H.transpose() * S_inverse;
    m += K * v;
    const Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::Identity() - K * H;
    C = (A * C * A.transpose() + K * R * K.transpose()).eval();
    return std::exp(-0.5 * v.dot(S_inverse * v)) / std::sqrt(std::pow(2.0 * std::numbers::pi, 3) * S.determinant());
  }
};

/// As one writes it who knows that H = [I 0] and F = F_s ⊗ I: blocks in place of zeros, and P − K (HP), symmetrised.
struct UpdateByBlocks {
  template <int N>
  static double filter(const Eigen::Matrix<double, N, N>& F, const Eigen::Matrix<double, N, N>& Q,
                       const Eigen::Vector3d& z, const Eigen::Matrix3d& R, Eigen::Matrix<double, N, 1>& m,
                       Eigen::Matrix<double, N, N>& C) {
    for (int a = 0; a < N; a += 3)
      for (int b = a + 3; b < N; b += 3) {
        m.template segment<3>(a) += F(a, b) * m.template segment<3>(b);
        C.template middleRows<3>(a) += F(a, b) * C.template middleRows<3>(b);
      }
    for (int a = 0; a < N; a += 3)
      for (int b = a + 3; b < N; b += 3) C.template middleCols<3>(a) += F(a, b) * C.template middleCols<3>(b);
    C += Q;
    const Eigen::Vector3d v = z - m.template head<3>();
    const Eigen::Matrix3d S = C.template topLeftCorner<3, 3>() + R;
    const Eigen::Matrix3d S_inverse = S.inverse();
    const Eigen::Matrix<double, 3, N> HP = C.template topRows<3>();
    const Eigen::Matrix<double, N, 3> K = HP.transpose() * S_inverse;
    m += K * v;
    const Eigen::Matrix<double, N, N> P = C - K * HP;
    C = 0.5 * (P + P.transpose());
    return std::exp(-0.5 * v.dot(S_inverse * v)) / std::sqrt(std::pow(2.0 * std::numbers::pi, 3) * S.determinant());
  }
};

/// An IMM as one would write it by hand with Eigen for DWNA and DWPA in space and a fixed step, what a bench compares
/// with: two Kalman filters of 6 and 9 states, mixed by moment matching, and no care taken of anything.
template <class Kalman>
struct BareImm {
  using V6 = Eigen::Matrix<double, 6, 1>;
  using V9 = Eigen::Matrix<double, 9, 1>;
  using M6 = Eigen::Matrix<double, 6, 6>;
  using M9 = Eigen::Matrix<double, 9, 9>;
  M6 F6, Q6;
  M9 F9, Q9;
  V6 x6;
  V9 x9;
  M6 P6;
  M9 P9;
  Eigen::Vector2d mu{0.5, 0.5};
  Eigen::Matrix2d transition{{0.95, 0.05}, {0.05, 0.95}};
  V9 x;
  M9 P;

  BareImm(double T, double sigma_w, const V9& mean, const M9& covariance)
      : F9(M9::Identity()), x6(mean.head<6>()), x9(mean), P6(covariance.topLeftCorner<6, 6>()), P9(covariance) {
    F9.topRightCorner<6, 6>().diagonal().setConstant(T);
    F9.topRightCorner<3, 3>().diagonal().setConstant(0.5 * T * T);
    F9.block<3, 3>(0, 3).diagonal().setConstant(T);
    F6 = F9.topLeftCorner<6, 6>();
    Eigen::Matrix<double, 9, 3> G;
    G << 0.5 * T * T * Eigen::Matrix3d::Identity(), T * Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity();
    Q9 = sigma_w * sigma_w * G * G.transpose();
    Q6 = Q9.topLeftCorner<6, 6>();
  }

  void step(const Eigen::Vector3d& z, const Eigen::Matrix3d& R) {
    const Eigen::Vector2d c = transition.transpose() * mu;
    const auto w = [&](int l, int j) { return transition(l, j) * mu(l) / c(j); };
    V9 x6_up = V9::Zero();
    x6_up.head<6>() = x6;
    M9 P6_up = M9::Zero();
    P6_up.topLeftCorner<6, 6>() = P6;
    P6_up.diagonal().tail<3>() = P9.diagonal().tail<3>();
    const V6 m6 = w(0, 0) * x6 + w(1, 0) * x9.head<6>();
    const V9 m9 = w(0, 1) * x6_up + w(1, 1) * x9;
    const V6 a6 = x6 - m6, b6 = x9.head<6>() - m6;
    const V9 a9 = x6_up - m9, b9 = x9 - m9;
    const M6 C6 = w(0, 0) * (P6 + a6 * a6.transpose()) + w(1, 0) * (P9.topLeftCorner<6, 6>() + b6 * b6.transpose());
    const M9 C9 = w(0, 1) * (P6_up + a9 * a9.transpose()) + w(1, 1) * (P9 + b9 * b9.transpose());
    x6 = m6;
    P6 = C6;
    x9 = m9;
    P9 = C9;
    mu = Eigen::Vector2d(c(0) * Kalman::template filter<6>(F6, Q6, z, R, x6, P6),
                         c(1) * Kalman::template filter<9>(F9, Q9, z, R, x9, P9));
    mu /= mu.sum();
  }

  /// (67), (68) with the spread of the means, into x and P.
  void output() {
    V9 x6_up = V9::Zero();
    x6_up.head<6>() = x6;
    M9 P6_up = M9::Zero();
    P6_up.topLeftCorner<6, 6>() = P6;
    P6_up.diagonal().tail<3>() = P9.diagonal().tail<3>();
    x = mu(0) * x6_up + mu(1) * x9;
    const V9 a = x6_up - x, b = x9 - x;
    P = mu(0) * (P6_up + a * a.transpose()) + mu(1) * (P9 + b * b.transpose());
  }
};

// Compiled by itself, in bare_imm.cpp: g++ inlines less of it in a longer file, and then it takes 700 ns instead of
// 400.
extern template struct BareImm<UpdateByBlocks>;

}  // namespace sigmax::bench
