#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/estimation/start.hpp>

#include "himm_demo/mode_filter.hpp"
#include "himm_demo/reading.hpp"
#include "himm_demo/row_sensor.hpp"

namespace sigmax::apps {

/// What a filter says of one time.
template <int Axes>
struct TrackPoint {
  double time = 0.0;
  Gaussian<Eigen::Dynamic, 3 * Axes> estimate;  ///< position, velocity and acceleration, as far as the models have them
  std::optional<double> turn_rate;              ///< in rad/s, counter-clockwise, if a model estimates it
  std::vector<double> weights;
  std::size_t most_likely_mode = 0;
  std::optional<double> nis;  ///< of the step, if it had a measurement that passed the gate
  bool is_start = false;
};

/// One filter on one stream of timed measurements: it starts as its settings say, then steps. After too long without a
/// measurement that passes the gate it starts again, from the next three.
template <int Axes>
class Tracker {
 public:
  using Point = TrackPoint<Axes>;

  explicit Tracker(FilterSettings settings);

  const FilterSettings& settings() const { return settings_; }

  /// Takes one measurement, or none at that time, and calls `stepped(time)` after each step that this completes. A
  /// given start without a time waits for the second row: it is one step before the first.
  void take(double time, const std::optional<Reading<Axes>>& reading, const std::function<void(double time)>& stepped);

  /// Whether there is an estimate, and how often there began to be one.
  bool running() const { return filter_.has_value(); }
  std::size_t starts() const { return starts_; }

  /// How many measurements the gate has turned away.
  std::size_t rejected() const { return rejected_; }

  /// The normalised innovation squared of the last step, if it had a measurement.
  std::optional<double> nis() const;

  /// The output now, as the settings ask for it.
  Point now() const;

  /// Ends the track. If the settings ask for smoothing, which keeps all steps, gives a point for each step, and for
  /// each start before its steps, with all that came after it up to the next start.
  std::vector<Point> finish();

 private:
  using Estimate = Gaussian<Eigen::Dynamic, 3 * Axes>;
  using Points = std::vector<TimedMeasurement<Axes>>;
  using Filter = std::variant<ModeFilter<KinematicBank<Axes>>, ModeFilter<AnyBank<Axes>>>;

  /// Whether the start to come is the given one.
  bool given() const { return settings_.start == Start::given && starts_ == 0; }
  void step(double time, const std::optional<Reading<Axes>>& reading);
  void start(double time);
  void record(double dt, bool is_start);
  /// Ends what began with the last start. Throws std::domain_error, saying so, if it cannot be smoothed.
  void end();
  /// Where a model starts.
  Estimate start_of(const Motion& motion) const;
  Estimate start_from_points(const Motion& motion) const;
  Estimate given_start(const Motion& motion) const;

  FilterSettings settings_;
  Points points_;
  std::vector<std::pair<double, std::optional<Reading<Axes>>>> waiting_;
  std::unique_ptr<typename RowSensor<Axes>::Radar> radar_;  ///< of the row at hand
  std::optional<Filter> filter_;
  double gate_;
  double time_ = 0.0;
  double last_measured_ = 0.0;
  std::size_t starts_ = 0;
  std::size_t rejected_ = 0;
  /// What smoothing leaves of a recorded step as it was.
  struct Known {
    double time;
    std::optional<double> nis;
    bool is_start;
  };
  std::vector<Known> recorded_;  ///< since the last start
  std::vector<Point> smoothed_;  ///< before the last start
};

extern template class Tracker<2>;
extern template class Tracker<3>;

}  // namespace sigmax::apps
