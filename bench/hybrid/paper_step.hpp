#pragma once

#include <vector>

#include <sigmax/core/relation.hpp>
#include <sigmax/estimation/gaussian.hpp>

/// What the benchmarks of a step follow: the paper's two models, a target, and the start.
namespace sigmax::bench {

inline constexpr double T = 0.2;
inline constexpr double sigma_w = 3.0;

/// A target that turns now and then, measured to 10 m.
inline std::vector<Gaussian<3>> measurements() {
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

inline Gaussian<9> start() {
  Gaussian<9> result{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  result.mean.head<6>() << 12e3, 8e3, 1e3, -100.0, -100.0, 0.0;
  result.covariance.diagonal() << 100.0, 100.0, 100.0, 400.0, 400.0, 400.0, 100.0, 100.0, 100.0;
  return result;
}

/// With the paper's transition for its kind of mode.
template <Uncertainty Kind>
Relation<Kind, Kind> transition() {
  constexpr bool fuzzy = std::same_as<Kind, Fuzzy>;
  constexpr double stays = fuzzy ? 1.0 : 0.95, leaves = fuzzy ? 0.5 : 0.05;
  const Variable<Kind> mode{"mode", {"dwna", "dwpa"}};
  return {mode, mode, {{stays, leaves}, {leaves, stays}}};
}

}  // namespace sigmax::bench
