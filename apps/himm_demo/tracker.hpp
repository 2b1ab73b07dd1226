#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
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

  explicit Tracker(FilterSettings settings) : settings_(std::move(settings)) {
    for (std::size_t i = 0; i < settings_.orders.size(); ++i)
      models_.emplace_back(settings_.sigma_w[i], Vector<Axes>::Zero(), settings_.orders[i]);
  }

  const FilterSettings& settings() const { return settings_; }

  /// Takes one measurement, or none at that time, and calls `stepped()` after each step that this completes. Without a
  /// start time a given start waits for the second measurement, one step before the first of which it is.
  template <class Stepped>
  void take(double time, const std::optional<Measurement>& z, const Stepped& stepped) {
    if (running()) {
      step(time, z);
      stepped(time);
    } else if (settings_.start == Start::given) {
      waiting_.push_back({time, z});
      if (!settings_.start_time_s && waiting_.size() < 2) return;
      start_given(settings_.start_time_s ? *settings_.start_time_s : 2.0 * waiting_[0].first - waiting_[1].first);
      for (const auto& [t, measurement] : waiting_) {
        step(t, measurement);
        stepped(t);
      }
      waiting_.clear();
    } else if (z) {
      points_.push_back({time, *z});
      if (points_.size() == 3) start_from_points();
    }
  }

  /// Whether there is an estimate.
  bool running() const { return filter_.has_value(); }

  Estimate estimate() const {
    return std::visit(
        [&](const auto& filter) {
          return settings_.most_likely_output ? filter.most_likely_estimate() : filter.estimate();
        },
        *filter_);
  }
  double weight(std::size_t mode) const {
    return std::visit([&](const auto& filter) { return filter.belief()[mode]; }, *filter_);
  }
  std::size_t most_likely_mode() const {
    return std::visit([](const auto& filter) { return filter.most_likely_mode(); }, *filter_);
  }
  /// The normalised innovation squared of the last step, if it had a measurement.
  std::optional<double> nis() const {
    return std::visit([](const auto& filter) { return filter.measured() ? std::optional(filter.nis()) : std::nullopt; },
                      *filter_);
  }

 private:
  template <Uncertainty Kind>
  using Filter = InteractingMultipleModel<Models, Kind>;
  using Starts = typename Bank<Models>::Estimates;

  void step(double time, const std::optional<Measurement>& z) {
    std::visit(
        [&](auto& filter) {
          if (z)
            filter.step(time - time_, *z);
          else
            filter.step(time - time_);
        },
        *filter_);
    time_ = time;
  }

  void start_from_points() {
    const bool released = settings_.start == Start::released;
    const auto wide = released ? released_start<Axes>(points_[0], points_[1], points_[2])
                               : three_point_start<Axes>(points_[0], points_[1], points_[2]);
    const auto narrow = two_point_start<Axes>(points_[1], points_[2]);
    Starts starts(models_.size());
    for (std::size_t i = 0; i < models_.size(); ++i) {
      const Eigen::Index n = models_[i].size();
      if (models_[i].order() == 2 && !released) {
        starts[i] = {narrow.mean, narrow.covariance};
      } else {
        starts[i] = {wide.mean.head(n), wide.covariance.topLeftCorner(n, n)};
      }
    }
    start(points_.back().time, starts);
    points_.clear();
  }

  void start_given(double time) {
    const Vector<9> mean = Eigen::Map<const Vector<9>>(settings_.start_mean.data());
    const Vector<9> variance = Eigen::Map<const Vector<9>>(settings_.start_covariance_diagonal.data());
    Starts starts(models_.size());
    for (std::size_t i = 0; i < models_.size(); ++i) {
      const Eigen::Index n = models_[i].size();
      starts[i].mean.resize(n);
      starts[i].covariance.setZero(n, n);
      for (Eigen::Index k = 0; k < n; ++k) {  // the keys always speak of three axes
        const Eigen::Index key = k / Axes * 3 + k % Axes;
        starts[i].mean(k) = mean(key);
        starts[i].covariance(k, k) = variance(key);
      }
    }
    start(time, starts);
  }

  void start(double time, const Starts& starts) {
    time_ = time;
    if (settings_.fuzzy) {
      Interaction<Fuzzy> interaction{
          settings_.lift, {settings_.mixed_covariance, settings_.mixing_tie}, settings_.output_tie};
      filter_.emplace(Filter<Fuzzy>(models_, transition<Fuzzy>(), starts, interaction));
    } else {
      Interaction<Random> interaction{settings_.lift, {settings_.imm_mixing}, settings_.output_tie};
      filter_.emplace(Filter<Random>(models_, transition<Random>(), starts, interaction));
    }
  }

  template <Uncertainty Kind>
  Relation<Kind, Kind> transition() const {
    const Variable<Kind> mode{"mode", settings_.models};
    return {mode, mode, settings_.transition};
  }

  FilterSettings settings_;
  Models models_;
  std::vector<TimedMeasurement<Axes>> points_;
  std::vector<std::pair<double, std::optional<Measurement>>> waiting_;
  std::optional<std::variant<Filter<Random>, Filter<Fuzzy>>> filter_;
  double time_ = 0.0;
};

}  // namespace sigmax::apps
