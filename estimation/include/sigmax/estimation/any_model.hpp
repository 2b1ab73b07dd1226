#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/estimation/kalman.hpp>

namespace sigmax {

/// One of several models or members, chosen at run time: what a program puts into the vector of a multiple-model filter
/// whose models its user names.
///
///     using Model = AnyModel<7, KinematicModel<3, 2>, Extended<CoordinatedTurn<3>>>;
///     const std::vector<Model> models = {dwna<3>(3.0), Extended{CoordinatedTurn<3>(1.0, 1e-4)}};
///
/// `MaxStateSize` bounds the state, and, in such a filter, the different components of all models together; so it may
/// be more than the size of each. Every model measures the same quantities. Nothing is allocated in predict and update.
template <int MaxStateSize, class First, class... Others>
class AnyModel {
  static_assert(First::max_state_size <= MaxStateSize && ((Others::max_state_size <= MaxStateSize) && ...),
                "a model has more states than the bound");
  static_assert(((First::measurement_size == Others::measurement_size) && ...),
                "all models must score the same measurement vector");
  template <class Model>
  static constexpr bool is_one = std::is_same_v<Model, First> || (std::is_same_v<Model, Others> || ...);

 public:
  static constexpr int state_size = Eigen::Dynamic;
  static constexpr int max_state_size = MaxStateSize;
  static constexpr int measurement_size = First::measurement_size;

  template <class Model>
    requires(is_one<Model>)
  AnyModel(Model model) : model_(std::move(model)) {}

  Eigen::Index size() const {
    return visit([](const auto& model) -> Eigen::Index { return model.size(); });
  }
  std::string_view name() const {
    return visit([](const auto& model) -> std::string_view { return model.name(); });
  }
  std::vector<std::string> components() const {
    return visit([](const auto& model) -> std::vector<std::string> { return model.components(); });
  }

  /// Calls `visitor(model)` with the model that it is.
  template <class Visitor>
  decltype(auto) visit(const Visitor& visitor) const {
    return std::visit(visitor, model_);
  }

 private:
  std::variant<First, Others...> model_;
};

namespace detail {

/// The estimate in the type of a model of its own. Throws std::invalid_argument, naming the model, for another size.
template <class Model, int N, int MaxN>
EstimateOf<Model> estimate_for(const Model& model, const Gaussian<N, MaxN>& estimate) {
  if (estimate.size() != model.size())
    throw std::invalid_argument("an estimate of model '" + std::string(model.name()) + "' has " +
                                std::to_string(estimate.size()) + " components; expected " +
                                std::to_string(model.size()));
  return {estimate.mean, estimate.covariance};
}

}  // namespace detail

/// As the model that it is predicts. `result` may be `prior`. Throws std::invalid_argument for a prior of another size.
template <int MaxStateSize, class... Models>
void predict(const AnyModel<MaxStateSize, Models...>& any, const EstimateOf<AnyModel<MaxStateSize, Models...>>& prior,
             double dt, EstimateOf<AnyModel<MaxStateSize, Models...>>& result) {
  any.visit([&](const auto& model) {
    auto own = detail::estimate_for(model, prior);
    predict(model, own, dt, own);
    result.mean = own.mean;
    result.covariance = own.covariance;
  });
}

/// Cov(x_k−1, x_k | z_1:k−1) as the model that it is gives it, for smoothing.
template <int MaxStateSize, class... Models>
SquareMatrix<Eigen::Dynamic, MaxStateSize> prediction_covariance(
    const AnyModel<MaxStateSize, Models...>& any, const EstimateOf<AnyModel<MaxStateSize, Models...>>& prior,
    double dt) {
  return any.visit([&](const auto& model) -> SquareMatrix<Eigen::Dynamic, MaxStateSize> {
    return prediction_covariance(model, detail::estimate_for(model, prior), dt);
  });
}

/// As the model that it is updates. `posterior` may be `prior`. Throws std::invalid_argument for a prior of another
/// size.
template <int MaxStateSize, class... Models>
Innovation<AnyModel<MaxStateSize, Models...>::measurement_size> update(
    const AnyModel<MaxStateSize, Models...>& any, const EstimateOf<AnyModel<MaxStateSize, Models...>>& prior,
    const MeasurementOf<AnyModel<MaxStateSize, Models...>>& measurement,
    EstimateOf<AnyModel<MaxStateSize, Models...>>& posterior) {
  return any.visit([&](const auto& model) {
    auto own = detail::estimate_for(model, prior);
    const auto innovation = update(model, own, measurement, own);
    posterior.mean = own.mean;
    posterior.covariance = own.covariance;
    return innovation;
  });
}

}  // namespace sigmax
