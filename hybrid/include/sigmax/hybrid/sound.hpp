#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/model.hpp>
#include <sigmax/hybrid/bank.hpp>
#include <sigmax/hybrid/lift.hpp>

/// What a filter asks of its starts, and of every new estimate.
namespace sigmax::check {

/// There is a start for each model, of its size and finite. Throws std::invalid_argument, naming the model.
template <class Models>
void starts(const Models& models, const typename Bank<Models>::Estimates& starts) {
  if (mode_count(starts) != mode_count(models))
    throw std::invalid_argument("there are " + std::to_string(mode_count(models)) + " models, but " +
                                std::to_string(mode_count(starts)) + " starts");
  for_each_mode(starts, [&](auto j) {
    const auto& model = mode(models, j);
    const auto& start = mode(starts, j);
    if (start.mean.size() != model.size() || start.covariance.rows() != model.size())
      throw std::invalid_argument("the start of model '" + std::string(model.name()) + "' has " +
                                  std::to_string(start.mean.size()) + " components; expected " +
                                  std::to_string(model.size()));
    if (!detail::all_finite(start))
      throw std::invalid_argument("the start of model '" + std::string(model.name()) + "' is not finite");
  });
}

/// The numbers of an entry prior are positive, and there is a scale. Throws std::invalid_argument.
inline void prior(const EntryPrior& prior) {
  if (prior.scales.empty()) throw std::invalid_argument("an entry prior has no scale; expected one or more");
  const auto positive = [](const char* what, double number) {
    if (!(number > 0.0 && std::isfinite(number)))
      throw std::invalid_argument("an entry prior has the " + std::string(what) + " " + std::to_string(number) +
                                  "; expected a positive one");
  };
  for (const double scale : prior.scales) positive("scale", scale);
  positive("vertical share", prior.vertical);
  positive("turn rate", prior.turn_rate);
}

/// The estimate is finite and no variance is negative beyond rounding: what a lost definiteness shows first, and costs
/// next to nothing to see. Throws std::domain_error, naming the model.
template <class Model>
void sound(const Model& model, const EstimateOf<Model>& estimate) {
  const auto variances = estimate.covariance.diagonal().array();
  const double rounding = 1e-12 * variances.abs().sum();  // not a number if one of them is not
  if (!estimate.mean.allFinite() || !std::isfinite(rounding))
    throw std::domain_error("the estimate of model '" + std::string(model.name()) + "' is not finite");
  if ((variances < -rounding).any())
    throw std::domain_error("the covariance of model '" + std::string(model.name()) +
                            "' is not positive semi-definite");
}

}  // namespace sigmax::check
