#pragma once

#include <optional>
#include <span>
#include <vector>

#include <sigmax/hybrid/plot.hpp>

#include "known_bank.hpp"

namespace sigmax::detail {

/// The start rule of a choice: an estimate for each model, or nothing as long as it wants more plots.
class ChosenStart {
 public:
  using Estimates = std::vector<EstimateOf<KnownModel>>;
  using Plots = std::span<const Plot<KnownSensor>>;

  explicit ChosenStart(const TargetChoice& choice) : choice_(choice) {}

  std::optional<StartAt<Estimates>> operator()(Plots plots, std::size_t starts) const;

  /// An estimate of its size for every model, without meaning: what a filter holds before it starts.
  Estimates nowhere() const;

 private:
  TargetChoice choice_;
};

}  // namespace sigmax::detail
