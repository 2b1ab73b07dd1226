#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <sigmax/hybrid/any_target.hpp>

#include "himm_demo/filter_settings.hpp"
#include "himm_demo/reading.hpp"

namespace sigmax::apps {

/// What a filter says of one time.
template <int Axes>
struct TrackPoint {
  double time = 0.0;
  std::size_t tag = 0;  ///< of the row
  bool is_start = false;
  Gaussian<Eigen::Dynamic, 3 * Axes> estimate;  ///< position, velocity and acceleration, as far as the models have them
  std::optional<double> turn_rate;              ///< in rad/s, counter-clockwise, if a model estimates it
  std::vector<double> weights;
  std::size_t most_likely_mode = 0;
  std::optional<double> nis;  ///< of the step, if it had a measurement that passed the gate
};

/// The library's choice that the settings stand for.
TargetChoice choice_of(const FilterSettings& settings, int axes);

/// What a row measured, or that it measured nothing, as the library takes it.
template <int Axes>
AnyPlot plot_of(double time, const std::optional<Reading<Axes>>& reading, std::size_t tag);

/// One filter on one stream of timed measurements: the library's target with the settings of the program.
template <int Axes>
class Tracker {
 public:
  using Point = TrackPoint<Axes>;

  explicit Tracker(FilterSettings settings);

  const FilterSettings& settings() const { return settings_; }

  /// Takes one measurement, or none at that time, and calls `stepped(tag)` after each step that this completes, with
  /// the tag of the measurement that it took.
  void take(double time, const std::optional<Reading<Axes>>& reading, std::size_t tag,
            const std::function<void(std::size_t tag)>& stepped);

  /// Whether there is an estimate, and how often there began to be one.
  bool running() const { return target_.running(); }
  std::size_t starts() const { return target_.starts(); }

  /// How many measurements the gate has turned away.
  std::size_t rejected() const { return target_.rejected(); }

  /// Tells what is known in other coordinates, A x + b; so the derivatives are turned by A. A target that waits for its
  /// start or has rejected the last plots is left alone: returns whether it was told.
  bool transform(const SquareMatrix<Axes>& A, const Vector<Axes>& b);

  /// The output now, as the settings ask for it.
  Point now() const;

  /// If the settings ask for smoothing, which keeps all steps: a point for each step, and for each start before its
  /// steps, with all that came after it up to the next start. Throws std::domain_error if that cannot be.
  std::vector<Point> finish() const;

  /// If the settings ask for it: when the mode changed, by all that came.
  std::vector<ModeStay> explained() const { return settings_.explain ? target_.explained() : std::vector<ModeStay>{}; }

 private:
  FilterSettings settings_;
  AnyTarget target_;
};

extern template class Tracker<1>;
extern template class Tracker<2>;
extern template class Tracker<3>;

}  // namespace sigmax::apps
