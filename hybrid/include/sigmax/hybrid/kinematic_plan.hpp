#pragma once

#include <array>
#include <cstddef>

#include <sigmax/hybrid/interaction.hpp>

/// The step of an interacting filter over motions along independent axes with measured positions, compiled once for
/// each instruction set in `hybrid/src/kinematic`. What passes between is plain numbers.
namespace sigmax::detail::kinematic {

inline constexpr int max_axes = 3;
inline constexpr int max_order = 3;
inline constexpr int max_modes = 4;
inline constexpr int max_state_size = max_axes * max_order;

/// The numbers of a lower triangle, row by row: (0, 0), (1, 0), (1, 1), … States are ordered by derivative, so the
/// triangle of a model of lower order leads that of one of higher order.
constexpr int triangle(int n) { return n * (n + 1) / 2; }

/// A motion law over one time step. F_s is made of shears: p += shears[0] v, v += shears[1] a, p += shears[2] v; the
/// highest derivative is scaled last. Triangles are of Q_s and of the squares of F_sᵀ.
struct Law {
  std::array<double, 3> shears{};
  double scale = 1.0;
  std::array<double, triangle(max_order)> squared{};
  std::array<double, triangle(max_order)> Q{};
  std::array<double, max_state_size> u{};  ///< what a known input adds to the state
};

/// What a step does: the models, how the mode moves on, and the rules in force.
struct Plan {
  int axes = 0;
  int modes = 0;
  std::array<int, max_modes> order{};                      ///< of each model
  std::array<Law, max_modes> law{};                        ///< for the time step in hand
  std::array<double, max_modes * max_modes> transition{};  ///< to j from i, at i · modes + j
  StateAugmentation augmentation{};
  MixedCovariance mixed_covariance{};
  Tie mixing_tie{};
  Tie output_tie{};
  LikelihoodForm likelihood{};

  int state_size(int j) const { return axes * order[static_cast<std::size_t>(j)]; }
};

/// A track: for each model its mean and covariance, a whole matrix of state_size() columns; the weights of the modes,
/// and the most likely one.
struct Track {
  const double* mean[max_modes];
  const double* covariance[max_modes];
  const double* weight;  ///< linear
  std::size_t most_likely;
};

/// What a step writes: for each model the estimate, and what it thought of the measurement, if there was one.
struct Told {
  double* mean[max_modes];
  double* covariance[max_modes];
  double* predicted[max_modes];  ///< the mean before the measurement
  double* residual[max_modes];
  double* S[max_modes];  ///< a whole matrix
  double squared_distance[max_modes];
  double precision[max_modes];  ///< 1/det S
  double prior[max_modes];      ///< linear weights of the modes before the measurement
  double posterior[max_modes];
};

}  // namespace sigmax::detail::kinematic
