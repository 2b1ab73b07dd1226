#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <vector>

#include <sigmax/estimation/any_sensor.hpp>
#include <sigmax/hybrid/estimates.hpp>

namespace sigmax {

/// The user's models of a multiple-model filter: a tuple of different types, or a vector of one type. The compiler
/// checks the sizes of a tuple; a vector of AnyModel is chosen at run time. Both fill one bank, a vector of AnyModel,
/// on which the filter computes.
template <class Models>
struct Bank;

template <class First, class... Others>
struct Bank<std::tuple<First, Others...>> {
  static_assert(((axes_of<First> == axes_of<Others>)&&...),
                "all models of a bank must have their position along the same axes");
  /// Along how many axes they have their position, or none; unknown if it is Eigen::Dynamic.
  static constexpr int axes = axes_of<First>;
  using Estimates = std::tuple<EstimateOf<First>, EstimateOf<Others>...>;
  template <class Sensor>
  static constexpr bool seen_by = SensorOf<Sensor, First> && (SensorOf<Sensor, Others> && ...);
  /// No bank carries more different components than all its models together.
  static constexpr int max_components = ((First::max_state_size + ... + Others::max_state_size));
};

template <class Model>
struct Bank<std::vector<Model>> {
  static constexpr int axes = std::is_same_v<Model, AnyModel> ? Eigen::Dynamic : axes_of<Model>;
  using Estimates = std::vector<EstimateOf<Model>>;
  static constexpr int max_components = Model::max_state_size;
  template <class Sensor>
  static constexpr bool seen_by = SensorOf<Sensor, Model>;
};

/// A sensor that a multiple-model filter can take: one of all models' states, of not too many quantities.
template <class Sensor, class Models>
concept SensorOfBank =
    Bank<Models>::template seen_by<Sensor>&& detail::max_measurement_size_of<Sensor> <= max_measurement_size;

namespace detail {

template <class... Model>
std::vector<AnyModel> bank_of(const std::tuple<Model...>& models) {
  constexpr bool all_filter = (std::constructible_from<AnyModel, const Model&> && ...);
  static_assert(all_filter,
                "a model of a bank is a linear motion, or Extended{motion}, Unscented{motion}, Cubature{motion}");
  if constexpr (all_filter)
    return std::apply([](const Model&... model) { return std::vector<AnyModel>{AnyModel(model)...}; }, models);
}
template <class Model>
std::vector<AnyModel> bank_of(const std::vector<Model>& models) {
  return {models.begin(), models.end()};
}

/// Estimates of the models, or one of them all, in the numbers' own row.
template <class... Estimate>
Estimates starts_of(const std::tuple<Estimate...>& starts) {
  Estimates result;
  std::apply([&](const Estimate&... start) { (result.add(start), ...); }, starts);
  return result;
}
template <int N, int MaxN>
Estimates starts_of(const std::vector<Gaussian<N, MaxN>>& starts) {
  return starts;
}
template <int N, int MaxN>
Estimates starts_of(const Gaussian<N, MaxN>& start) {
  Estimates result;
  result.add(start);
  return result;
}
inline Estimates starts_of(const Estimates& starts) { return starts; }

/// A sensor of all models of a bank: one table for all, or one for each model that it may ask.
struct SensorOfModels {
  const void* sensor;
  const SensorTable* const* tables;
  bool one_table;
  bool asks_any;  ///< an AnyModel, rather than what is behind it

  SensorRef of(const std::vector<AnyModel>& models, std::size_t j) const {
    const void* const model = asks_any ? &models[j] : models[j].ref().motion;
    return {sensor, tables[one_table ? 0 : j], model};
  }
};

template <class Sensor, class Models>
struct TablesOf;
template <class Sensor, class... Model>
struct TablesOf<Sensor, std::tuple<Model...>> {
  static constexpr bool one = false, asks_any = false;
  static constexpr const SensorTable* tables[] = {table_for<Sensor, Model>...};
};
template <class Sensor, class Model>
struct TablesOf<Sensor, std::vector<Model>> {
  static constexpr bool one = true, asks_any = std::is_same_v<Model, AnyModel>;
  static constexpr const SensorTable* tables[] = {table_for<Sensor, Model>};
};

template <class Models, class Sensor>
SensorOfModels sensor_of_models(const Sensor& sensor) {
  using Tables = TablesOf<Sensor, Models>;
  return {&sensor, Tables::tables, Tables::one, Tables::asks_any};
}
template <class...>
SensorOfModels sensor_of_models(const AnySensor& sensor) {
  return {sensor.sensor(), &sensor.table(), true, true};
}

}  // namespace detail

}  // namespace sigmax
