#pragma once

#include <string>

/// What passes between typed code, which users compile, and the library's: plain numbers where they lie, matrices by
/// columns, and functions over them. The layout of a fixed-size Eigen object depends on the flags of whoever compiles
/// it; that of numbers does not.
namespace sigmax {

/// Spread and weights of the sigma points of N(x, P) with P = L Lᵀ. Points are at x ± √spread Lᵢ, each with the weight
/// 1/(2 spread), and at x itself, with one weight for means and another for covariances.
struct SigmaPointWeights {
  double spread = 0.0;
  double centre_of_mean = 0.0;
  double centre_of_covariance = 0.0;
};

namespace detail {

/// A mean of n numbers and a covariance of n columns, to be read.
struct ConstView {
  const double* mean;
  const double* covariance;
  int n;
};

/// The same, to be written.
struct View {
  double* mean;
  double* covariance;
  int n;

  operator ConstView() const { return {mean, covariance, n}; }
};

/// One step of a motion along independent axes: F_s and Q_s, order × order, the same along each axis, and the effect of
/// a known input on the state.
struct AxisLaw {
  int order;
  double F[9];
  double Q[9];
  double input[9];
};

/// The functions of one type of motion.
struct MotionTable {
  int axes = 0;         ///< along which its position leads the state, or 0
  bool linear = false;  ///< `tangent` writes what a known input adds, instead of f(x)
  int (*size)(const void* motion) = nullptr;
  std::string (*name)(const void* motion) = nullptr;

  /// f(x), and ∂f/∂x and the noise's covariance where they are asked for; of a linear motion they are.
  void (*tangent)(const void* motion, const double* x, double dt, double* image, double* F, double* Q) = nullptr;
  /// The same of a motion along independent axes, in short.
  void (*law)(const void* motion, double dt, AxisLaw& law) = nullptr;
};

/// A motion, and how its filter replaces functions that are not linear. A view.
struct ModelRef {
  const void* motion;
  const MotionTable* table;
  SigmaPointWeights points{};  ///< by their tangents if the spread is zero

  int size() const { return table->size(motion); }
  std::string name() const { return table->name(motion); }
  bool linear() const { return table->linear; }
  bool by_points() const { return points.spread > 0.0; }
};

/// The functions of one type of sensor.
struct SensorTable {
  bool leading = false;  ///< it measures the leading components and nothing else, H = [I 0], and has no function
  bool linear = false;   ///< `measure` writes H alone

  /// How many leading components it is asked with, and H has columns; 0 stands for the whole state.
  int (*seen)(const void* sensor);
  /// h(x), m numbers, and H = ∂h/∂x by columns, where they are asked for. Throws std::invalid_argument if it measures
  /// another number of quantities.
  void (*measure)(const void* sensor, const void* model, const double* x, int n, int m, double* z, double* H) = nullptr;
  /// z − predicted of so many z, a column each, also in their place; the plain difference if there is none.
  void (*difference)(const void* sensor, const double* z, const double* predicted, int m, int count,
                     double* result) = nullptr;
  /// The weighted mean of measurements, a column each; by differences if there is none.
  void (*mean)(const void* sensor, const double* points, const double* weights, int m, int count,
               double* result) = nullptr;
};

/// A sensor, and the model that it may ask. A view.
struct SensorRef {
  const void* sensor;
  const SensorTable* table;
  const void* model = nullptr;
};

}  // namespace detail
}  // namespace sigmax
