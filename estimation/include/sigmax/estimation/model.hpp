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

/// What every model says of its state. A motion is a model that moves; how it is measured is the business of a sensor,
/// which comes with each measurement (sensing.hpp).
///
///   Model::state_size          number of states, or Eigen::Dynamic with at most Model::max_state_size
///   model.size()               number of states, n
///   model.name()               for people, "dwna"
///   model.components()         names of the n states; models share a component by its name
///   Model::axes                optional: the leading components are the position along so many axes
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

namespace detail {

/// Whether the library computes the numbers of a motion, a law or a sensor, by its `compute`. What a user derives from
/// one is asked by its own functions.
template <class Type>
concept ComputesItself = std::same_as<typename Type::ComputedBy, Type>;

}  // namespace detail

/// The state of a model.
template <class Model>
using StateOf = Vector<Model::state_size, Model::max_state_size>;

/// The estimate of a model's state.
template <class Model>
using EstimateOf = Gaussian<Model::state_size, Model::max_state_size>;

/// The covariance of a model's state, and any other matrix over it.
template <class Model>
using StateMatrixOf = SquareMatrix<Model::state_size, Model::max_state_size>;

/// Along how many axes a model knows its position, or none if it does not say.
template <class Model>
inline constexpr int axes_of = [] {
  if constexpr (requires { Model::axes; })
    return Model::axes;
  else
    return 0;
}();

}  // namespace sigmax
