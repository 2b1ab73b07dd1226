#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// A matrix, or an expression of one, of this shape as far as the compiler knows: a run-time size fits any.
template <class T, int Rows, int Columns = 1>
concept MatrixOf = requires {
  requires static_cast<int>(std::remove_cvref_t<T>::RowsAtCompileTime) == Rows ||
      static_cast<int>(std::remove_cvref_t<T>::RowsAtCompileTime) == Eigen::Dynamic || Rows == Eigen::Dynamic;
  requires static_cast<int>(std::remove_cvref_t<T>::ColsAtCompileTime) == Columns ||
      static_cast<int>(std::remove_cvref_t<T>::ColsAtCompileTime) == Eigen::Dynamic || Columns == Eigen::Dynamic;
};

/// What every model says of its state.
///
///   Model::state_size          number of states, or Eigen::Dynamic with at most Model::max_state_size
///   model.size()               number of states, n
///   model.name()               for people, "dwna"
///   model.components()         names of the n states; models share a component by its name
template <class Model>
concept StateModel = requires(const Model& model) {
  { Model::state_size } -> std::convertible_to<int>;
  { Model::max_state_size } -> std::convertible_to<int>;
  { model.size() } -> std::convertible_to<Eigen::Index>;
  { model.name() } -> std::convertible_to<std::string_view>;
  { model.components() } -> std::convertible_to<std::vector<std::string>>;
};

/// A linear motion, (47), by its valid expressions; no base class is needed, here or below. Matrices of another size do
/// not compile.
///
///   model.transition(dt)       F, n × n, for a step of dt seconds
///   model.process_covariance(dt)  G Q Gᵀ, n × n, symmetric positive semi-definite
///   model.known_input(dt)      what a known input adds to the state, n; zero if there is none
template <class Model>
concept LinearMotion = StateModel<Model> && requires(const Model& model, double dt) {
  { model.transition(dt) } -> MatrixOf<Model::state_size, Model::state_size>;
  { model.process_covariance(dt) } -> MatrixOf<Model::state_size, Model::state_size>;
  { model.known_input(dt) } -> MatrixOf<Model::state_size>;
};

/// A linear motion with a linear measurement, (48): what the Kalman filter takes.
///
///   Model::measurement_size    number of measured quantities, m
///   model.measurement_matrix() H, m × n
template <class Model>
concept LinearModel = LinearMotion<Model> && requires(const Model& model) {
  { Model::measurement_size } -> std::convertible_to<int>;
  { model.measurement_matrix() } -> MatrixOf<Model::measurement_size, Model::state_size>;
};

/// The state of a model.
template <class Model>
using StateOf = Vector<Model::state_size, Model::max_state_size>;

/// The estimate of a model's state.
template <class Model>
using EstimateOf = Gaussian<Model::state_size, Model::max_state_size>;

/// What a model measures, with its R.
template <class Model>
using MeasurementOf = Gaussian<Model::measurement_size>;

/// Whether a model measures its first components and nothing else, H = [I 0]; the Kalman filter then skips the zeros.
template <class Model>
inline constexpr bool measures_leading_components = requires {
  requires Model::measures_leading_components;
};

}  // namespace sigmax
