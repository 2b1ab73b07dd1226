#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/gaussian.hpp>

namespace sigmax {

/// A motion and measurement model of a multiple-model filter, by its valid expressions; no base class is needed.
///
///   Model::state_size          number of states, or Eigen::Dynamic with at most Model::max_state_size
///   Model::measurement_size    number of measured quantities, m
///   model.size()               number of states, n
///   model.name()               for people, "dwna"
///   model.components()         names of the n states; models share a component by its name
///   model.transition(dt)       F, n × n, for a step of dt seconds, (47)
///   model.process_covariance(dt)  G Q Gᵀ, n × n, symmetric positive semi-definite
///   model.known_input(dt)      what a known input adds to the state, n; zero if there is none
///   model.measurement_matrix() H, m × n, (48)
template <class Model>
concept LinearModel = requires(const Model& model, double dt) {
  { Model::state_size } -> std::convertible_to<int>;
  { Model::max_state_size } -> std::convertible_to<int>;
  { Model::measurement_size } -> std::convertible_to<int>;
  { model.size() } -> std::convertible_to<Eigen::Index>;
  { model.name() } -> std::convertible_to<std::string_view>;
  { model.components() } -> std::convertible_to<std::vector<std::string>>;
  model.transition(dt);
  model.process_covariance(dt);
  model.known_input(dt);
  model.measurement_matrix();
};

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
