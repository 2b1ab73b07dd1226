#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/estimation/kalman.hpp>

namespace sigmax {

/// Record of one step of a filter, for smoothing: its duration in s, and its state after the step.
template <class State>
struct FilteredStep {
  double dt;  ///< since the step before; ignored for the first
  State state;
};

/// One backward step of the smoother of Rauch, Tung and Striebel (1965). `filtered` is the estimate at k; the next step
/// took `dt` seconds, and its estimate `next` is smoothed already. With the prediction y of x,
///
///   A = Cov(x, y) P_y⁻¹,   x + A (yˢ − y),   P_x + A (Pˢ_y − P_y) Aᵀ.
///
/// Works on every model and member that has `predict`. `result` may be `filtered` or `next`. Throws std::domain_error,
/// naming the model, if P_y is not positive semi-definite.
template <FilterModel Model>
void smooth_step(const Model& model, const EstimateOf<Model>& filtered, double dt, const EstimateOf<Model>& next,
                 EstimateOf<Model>& result) {
  detail::smooth_step(detail::model_ref(model), detail::view(filtered), dt, detail::view(next),
                      detail::sized_view(result, filtered.size()));
}

/// The smoothed estimates of a whole interval, one for each filtered one; the last is itself. Where a start is far less
/// sure than the measurements, use a multiple-model filter of the one model: it smooths without differences.
///
///     std::vector<FilteredStep<EstimateOf<Model>>> record;   // grows with the interval
///     … predict, update, record.push_back({dt, estimate}); …
///     const auto smoothed = smooth(model, record);
template <FilterModel Model>
std::vector<EstimateOf<Model>> smooth(const Model& model, const std::vector<FilteredStep<EstimateOf<Model>>>& record) {
  std::vector<EstimateOf<Model>> smoothed(record.size());
  if (!record.empty()) smoothed.back() = record.back().state;
  for (std::size_t k = record.size(); k-- > 1;)
    smooth_step(model, record[k - 1].state, record[k].dt, smoothed[k], smoothed[k - 1]);
  return smoothed;
}

}  // namespace sigmax
