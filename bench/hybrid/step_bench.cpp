/// One step of the filters, with its output, beside a bare IMM as one would write it by hand with Eigen for these two
/// models and a fixed step. All in one program, so that ratios mean something.

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>
#include <Eigen/Dense>

#include <sigmax/sigmax.hpp>

namespace {

using namespace sigmax;

constexpr double T = 0.2;
constexpr double sigma_w = 3.0;

/// A target that turns now and then, measured to 10 m.
std::vector<Gaussian<3>> measurements() {
  std::vector<Gaussian<3>> all;
  unsigned state = 1;
  const auto noise = [&state] {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
      sum += static_cast<double>((state = state * 1664525U + 1013904223U) >> 8U) / 16777216.0;
    return 10.0 * sum;
  };
  Vector<3> x(12e3, 8e3, 1e3), v(-100.0, -100.0, 0.0);
  for (int k = 0; k < 1000; ++k) {
    const Vector<3> a = k / 50 % 4 == 1   ? Vector<3>(-30.0, -50.0, 0.0)
                        : k / 50 % 4 == 3 ? Vector<3>(30.0, 50.0, 0.0)
                                          : Vector<3>(0.0, 0.0, 0.0);
    x += T * v + 0.5 * T * T * a;
    v += T * a;
    SquareMatrix<3> R = SquareMatrix<3>::Identity() * 100.0;
    R(0, 1) = R(1, 0) = 20.0;
    all.push_back({x + Vector<3>(noise(), noise(), noise()), R});
  }
  return all;
}

Gaussian<9> start() {
  Gaussian<9> result{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  result.mean.head<6>() << 12e3, 8e3, 1e3, -100.0, -100.0, 0.0;
  result.covariance.diagonal() << 100.0, 100.0, 100.0, 400.0, 400.0, 400.0, 100.0, 100.0, 100.0;
  return result;
}

template <Uncertainty Kind>
Relation<Kind, Kind> transition(double stays, double leaves) {
  const Variable<Kind> mode{"mode", {"dwna", "dwpa"}};
  return {mode, mode, {{stays, leaves}, {leaves, stays}}};
}

/// The bare filter: two Kalman filters of 6 and 9 states, mixed by moment matching, and no care taken of anything.
struct BareImm {
  using V6 = Eigen::Matrix<double, 6, 1>;
  using V9 = Eigen::Matrix<double, 9, 1>;
  using M6 = Eigen::Matrix<double, 6, 6>;
  using M9 = Eigen::Matrix<double, 9, 9>;
  M6 F6, Q6;
  M9 F9, Q9;
  Eigen::Matrix<double, 3, 6> H6;
  Eigen::Matrix<double, 3, 9> H9;
  V6 x6;
  V9 x9;
  M6 P6;
  M9 P9;
  Eigen::Vector2d mu{0.5, 0.5};
  Eigen::Matrix2d transition;
  V9 x;
  M9 P;

  BareImm() {
    F6 = dwna<3>(sigma_w).transition(T);
    Q6 = dwna<3>(sigma_w).process_covariance(T);
    F9 = dwpa<3>(sigma_w).transition(T);
    Q9 = dwpa<3>(sigma_w).process_covariance(T);
    H6.setIdentity();
    H9.setIdentity();
    const auto s = start();
    x9 = s.mean;
    P9 = s.covariance;
    x6 = x9.head<6>();
    P6 = P9.topLeftCorner<6, 6>();
    transition << 0.95, 0.05, 0.05, 0.95;
  }

  template <int N>
  static double filter(const Eigen::Matrix<double, N, N>& F, const Eigen::Matrix<double, N, N>& Q,
                       const Eigen::Matrix<double, 3, N>& H, const Gaussian<3>& z, Eigen::Matrix<double, N, 1>& m,
                       Eigen::Matrix<double, N, N>& C) {
    m = (F * m).eval();
    C = (F * C * F.transpose() + Q).eval();
    const Eigen::Vector3d v = z.mean - H * m;
    const Eigen::Matrix3d S = H * C * H.transpose() + z.covariance;
    const Eigen::Matrix3d S_inverse = S.inverse();
    const Eigen::Matrix<double, N, 3> K = C * H.transpose() * S_inverse;
    m += K * v;
    const Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::Identity() - K * H;
    C = (A * C * A.transpose() + K * z.covariance * K.transpose()).eval();
    return std::exp(-0.5 * v.dot(S_inverse * v)) / std::sqrt(std::pow(2.0 * std::numbers::pi, 3) * S.determinant());
  }

  void step(const Gaussian<3>& z) {
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
    mu = Eigen::Vector2d(c(0) * filter<6>(F6, Q6, H6, z, x6, P6), c(1) * filter<9>(F9, Q9, H9, z, x9, P9));
    mu /= mu.sum();
  }

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

template <class Step>
void run(benchmark::State& state, const Step& step) {
  const auto all = measurements();
  std::size_t k = 0;
  for (auto _ : state) {
    step(all[k]);
    k = k + 1 == all.size() ? 0 : k + 1;
  }
  state.SetItemsProcessed(state.iterations());
}

void BareEigenImmStep(benchmark::State& state) {
  BareImm filter;
  run(state, [&](const Gaussian<3>& z) {
    filter.step(z);
    filter.output();
    benchmark::DoNotOptimize(filter.P.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(BareEigenImmStep);

/// A filter over the models, with the paper's transition for its kind of mode.
template <Uncertainty Kind, class Models>
void step_with_output(benchmark::State& state, const Models& models) {
  constexpr bool fuzzy = std::same_as<Kind, Fuzzy>;
  InteractingMultipleModel filter{models, fuzzy ? transition<Kind>(1.0, 0.5) : transition<Kind>(0.95, 0.05), start()};
  run(state, [&](const Gaussian<3>& z) {
    filter.step(T, z);
    auto estimate = filter.estimate();
    benchmark::DoNotOptimize(estimate.covariance.data());
    benchmark::ClobberMemory();
  });
}

template <Uncertainty Kind>
void TupleStep(benchmark::State& state) {
  step_with_output<Kind>(state, std::tuple{dwna<3>(sigma_w), dwpa<3>(sigma_w)});
}
BENCHMARK(TupleStep<Random>)->Name("ImmStep/tuple");
BENCHMARK(TupleStep<Fuzzy>)->Name("HimmStep/tuple");

template <Uncertainty Kind>
void VectorStep(benchmark::State& state) {
  using Model = KinematicModel<3, Eigen::Dynamic>;
  step_with_output<Kind>(state, std::vector<Model>{Model(dwna<3>(sigma_w)), Model(dwpa<3>(sigma_w))});
}
BENCHMARK(VectorStep<Random>)->Name("ImmStep/vector");
BENCHMARK(VectorStep<Fuzzy>)->Name("HimmStep/vector");

}  // namespace
