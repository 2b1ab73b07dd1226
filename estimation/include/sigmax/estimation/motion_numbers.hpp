#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The numbers of the library's motions, computed in one place: matrices by columns. The classes of motions say what
/// they mean.
namespace sigmax::detail {

/// @{
/// F_s and Q_s, order × order, and what a known input of one adds to the derivatives.
void discrete_white_noise(int order, double sigma_w, double dt, double* F, double* Q, double* gain);
void white_noise(int order, double q, double dt, double* F, double* Q, double* gain);
void ornstein_uhlenbeck(int order, double theta, double sigma, double dt, double* F, double* Q, double* gain);
/// @}

/// law ⊗ I: what a matrix of one axis is of all, which are independent.
void spread_over_axes(const double* law, int order, int axes, double* matrix);

/// F and Q of a turn at a known rate.
void known_turn(int axes, double omega, double q, double dt, double* F, double* Q);

/// f(x) of a turn at a rate that is estimated, and ∂f/∂x and Q where they are asked for.
void coordinated_turn(int axes, double q, double q_omega, const double* x, double dt, double* image, double* F,
                      double* Q);

/// Names of the components of a motion, ordered by derivative: x, y, z, vx, vy, vz, ax, ay, az. There are as many as
/// axes and derivatives, position included. Models that use them can be mixed.
std::vector<std::string> motion_components(int axes, int orders);

/// Returns the rate of a turn. Throws std::invalid_argument unless it is finite.
double finite_rate(double omega);

/// Returns the parameter of a model. Throws std::invalid_argument, naming both, unless 0 ≤ value ≤ 1e150, so that its
/// square is finite.
double motion_parameter(double value, std::string_view parameter, std::string_view model);

}  // namespace sigmax::detail
