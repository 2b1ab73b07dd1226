#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <sigmax/estimation/sensing.hpp>

namespace sigmax {

/// A bank of models: a tuple of different types, known to the compiler (the fast path), or a vector of one run-time
/// type (what programs use). The filter is written once, over `for_each_mode` and `mode`. `Estimates` has one estimate
/// of each model's state, `Pairs` as many as there are modes: one for each other mode that it may come from or go to.
template <class Models>
struct Bank;

template <class First, class... Others>
struct Bank<std::tuple<First, Others...>> {
  static_assert(((axes_of<First> == axes_of<Others>)&&...),
                "all models of a bank must have their position along the same axes");
  static constexpr int axes = axes_of<First>;
  using Estimates = std::tuple<EstimateOf<First>, EstimateOf<Others>...>;
  using Pairs = std::tuple<std::vector<EstimateOf<First>>, std::vector<EstimateOf<Others>>...>;
  static constexpr int max_state_size = std::max({First::max_state_size, Others::max_state_size...});
  template <class Sensor>
  static constexpr bool seen_by = SensorOf<Sensor, First> && (SensorOf<Sensor, Others> && ...);
  /// No bank carries more different components than all its models together.
  static constexpr int max_components = ((First::max_state_size + ... + Others::max_state_size));
};

template <class Model>
struct Bank<std::vector<Model>> {
  static constexpr int axes = axes_of<Model>;
  using Estimates = std::vector<EstimateOf<Model>>;
  using Pairs = std::vector<std::vector<EstimateOf<Model>>>;
  static constexpr int max_state_size = Model::max_state_size;
  static constexpr int max_components = Model::max_state_size;
  template <class Sensor>
  static constexpr bool seen_by = SensorOf<Sensor, Model>;
};

template <class... T>
constexpr std::size_t mode_count(const std::tuple<T...>&) {
  return sizeof...(T);
}
template <class T>
std::size_t mode_count(const std::vector<T>& modes) {
  return modes.size();
}

/// The entry of one mode; the index is a std::integral_constant for a tuple, a number for a vector.
template <class Index, class... T>
constexpr auto& mode(std::tuple<T...>& modes, Index) {
  return std::get<Index::value>(modes);
}
template <class Index, class... T>
constexpr const auto& mode(const std::tuple<T...>& modes, Index) {
  return std::get<Index::value>(modes);
}
template <class T>
T& mode(std::vector<T>& modes, std::size_t index) {
  return modes[index];
}
template <class T>
const T& mode(const std::vector<T>& modes, std::size_t index) {
  return modes[index];
}

/// Calls visit(index) for every mode in order.
template <class... T, class Visit>
constexpr void for_each_mode(const std::tuple<T...>&, const Visit& visit) {
  [&]<std::size_t... Index>(std::index_sequence<Index...>) {
    (visit(std::integral_constant<std::size_t, Index>{}), ...);
  }
  (std::index_sequence_for<T...>{});
}
template <class T, class Visit>
void for_each_mode(const std::vector<T>& modes, const Visit& visit) {
  for (std::size_t index = 0; index < modes.size(); ++index) visit(index);
}

namespace detail {

/// Room for one estimate of each model.
template <class... Models>
auto estimates_for(const std::tuple<Models...>&) {
  return typename Bank<std::tuple<Models...>>::Estimates{};
}
template <class Model>
auto estimates_for(const std::vector<Model>& models) {
  return std::vector<EstimateOf<Model>>(models.size());
}

/// Room for as many estimates of each model as there are modes, all equal to that model's estimate.
template <class... Estimate>
auto pairs_for(const std::tuple<Estimate...>& estimates) {
  return std::apply(
      [](const auto&... each) {
        return std::tuple<std::vector<Estimate>...>{std::vector<Estimate>(sizeof...(Estimate), each)...};
      },
      estimates);
}
template <class Estimate>
auto pairs_for(const std::vector<Estimate>& estimates) {
  std::vector<std::vector<Estimate>> pairs;
  for (const Estimate& each : estimates) pairs.emplace_back(estimates.size(), each);
  return pairs;
}

}  // namespace detail

}  // namespace sigmax
