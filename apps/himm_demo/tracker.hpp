#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/estimation/start.hpp>

#include "himm_demo/mode_filter.hpp"

namespace sigmax::apps {

/// One filter on one stream of timed measurements: it starts as its settings say, then steps. After too long without a
/// measurement that passes the gate it starts again, from the next three.
template <int Axes>
class Tracker {
 public:
  using Measurement = Gaussian<Axes>;
  /// Position, velocity and acceleration, as far as the models have them.
  using Estimate = Gaussian<Eigen::Dynamic, 3 * Axes>;

  explicit Tracker(FilterSettings settings);

  const FilterSettings& settings() const { return settings_; }

  /// Takes one measurement, or none at that time, and calls `stepped(time)` after each step that this completes. A
  /// given start without a time waits for the second row: it is one step before the first.
  void take(double time, const std::optional<Measurement>& z, const std::function<void(double time)>& stepped);

  /// Whether there is an estimate, and how often there began to be one.
  bool running() const { return filter_.has_value(); }
  std::size_t starts() const { return starts_; }

  /// How many measurements the gate has turned away.
  std::size_t rejected() const { return rejected_; }

  /// The output that the settings ask for.
  Estimate estimate() const;
  /// The estimated rate of turn in rad/s, counter-clockwise, if a model has one.
  std::optional<double> turn_rate() const;
  double weight(std::size_t mode) const;
  std::size_t most_likely_mode() const;

  /// The normalised innovation squared of the last step, if it had a measurement.
  std::optional<double> nis() const;

 private:
  using Points = std::vector<TimedMeasurement<Axes>>;

  /// Whether the start to come is the given one.
  bool given() const { return settings_.start == Start::given && starts_ == 0; }
  void step(double time, const std::optional<Measurement>& z);
  void start(double time);
  /// Where a model starts.
  Estimate start_of(const Motion& motion) const;
  Estimate start_from_points(const Motion& motion) const;
  Estimate given_start(const Motion& motion) const;

  FilterSettings settings_;
  Points points_;
  std::vector<std::pair<double, std::optional<Measurement>>> waiting_;
  std::optional<std::variant<ModeFilter<KinematicBank<Axes>>, ModeFilter<AnyBank<Axes>>>> filter_;
  double gate_;
  double time_ = 0.0;
  double last_measured_ = 0.0;
  std::size_t starts_ = 0;
  std::size_t rejected_ = 0;
};

extern template class Tracker<2>;
extern template class Tracker<3>;

}  // namespace sigmax::apps
