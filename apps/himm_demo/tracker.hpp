#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "himm_demo/filter_settings.hpp"

namespace sigmax::apps {

/// One filter on one stream of timed measurements: it starts as its settings say, then steps.
template <int Axes>
class Tracker {
 public:
  using Model = KinematicModel<Axes, Eigen::Dynamic>;
  using Models = std::vector<Model>;
  using Measurement = Gaussian<Axes>;
  using Estimate = typename InteractingMultipleModel<Models, Random>::Estimate;

  explicit Tracker(FilterSettings settings);

  const FilterSettings& settings() const { return settings_; }

  /// Takes one measurement, or none at that time, and calls `stepped(time)` after each step that this completes. A
  /// given start without a time waits for the second row: it is one step before the first.
  void take(double time, const std::optional<Measurement>& z, const std::function<void(double time)>& stepped);

  /// Whether there is an estimate.
  bool running() const { return filter_.has_value(); }

  /// The output that the settings ask for.
  Estimate estimate() const;
  double weight(std::size_t mode) const;
  std::size_t most_likely_mode() const;

  /// The normalised innovation squared of the last step, if it had a measurement.
  std::optional<double> nis() const;

 private:
  using Imm = InteractingMultipleModel<Models, Random>;
  using Himm = InteractingMultipleModel<Models, Fuzzy>;
  using Starts = typename Bank<Models>::Estimates;

  void step(double time, const std::optional<Measurement>& z);
  void start_from_points();
  void start_given(double time);
  void start(double time, const Starts& starts);
  template <Uncertainty Kind>
  Relation<Kind, Kind> transition() const;

  FilterSettings settings_;
  Models models_;
  std::vector<TimedMeasurement<Axes>> points_;
  std::vector<std::pair<double, std::optional<Measurement>>> waiting_;
  std::optional<std::variant<Imm, Himm>> filter_;
  double time_ = 0.0;
};

extern template class Tracker<2>;
extern template class Tracker<3>;

}  // namespace sigmax::apps
