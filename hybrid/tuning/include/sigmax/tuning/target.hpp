#pragma once

#include <map>
#include <span>

#include <sigmax/hybrid/any_target.hpp>
#include <sigmax/hybrid/cross_validation.hpp>
#include <sigmax/hybrid/fit.hpp>

namespace sigmax {

/// The detections of each target.
using Tracks = std::vector<std::vector<AnyDetection>>;

/// What a detection measures as its number i, whatever the sensor: a component of the state, a position's among them;
/// or a quantity of a radar, or of another sensor.
using MeasuredQuantity = std::pair<AnyDetection::Sensor, int>;
MeasuredQuantity quantity_of(const AnyDetection& detection, std::size_t i);

/// The standard deviation of the rounding of numbers that come in whole steps; else 0, and infinite where they never
/// change. No noise of theirs should be fitted below it.
double rounding_of(std::vector<double> numbers);

/// How far and how often targets are seen to move, whatever follows them. It bounds what may be fitted, and says what a
/// stray detection is: one that may be anywhere within six times as far as nine in ten move.
class TrackScale {
 public:
  explicit TrackScale(const Tracks& tracks);

  double step_s = 0.0;       ///< the median time between detections
  double long_step_s = 1.0;  ///< that nine in ten do not exceed
  bool uneven = false;       ///< whether one step in ten is twice as long as another one in ten

  /// What nine in ten changes of a quantity from one detection to the next stay below, those that are none left out; 0
  /// if it never changes.
  double change(const MeasuredQuantity& quantity) const;

  /// The same of the position, in m.
  double change_m() const;

  /// The logarithm of the density of a stray detection.
  double log_stray(const AnyDetection& detection) const;

 private:
  std::map<MeasuredQuantity, double> changes_;
  double range_ = 0.0;  // the median of radars
};

/// A number of settings that may be fitted: where it stands, and how it is changed.
template <class Settings>
struct FreeNumber {
  FitParameter parameter;
  std::function<void(Settings&, double)> set;
};

template <class Settings>
std::vector<FitParameter> parameters_of(const std::vector<FreeNumber<Settings>>& numbers) {
  std::vector<FitParameter> parameters;
  for (const auto& number : numbers) parameters.push_back(number.parameter);
  return parameters;
}

/// The parameters of the motions that are not 0, and the rate of a turn. From a σ that moves the target as far as it is
/// seen to move in a step at once, down to a ten-millionth of it.
std::vector<FreeNumber<TargetChoice>> motion_numbers(const TargetChoice& choice, const TrackScale& scale);

/// How likely, or how possible, each mode is left in a step, or its mean sojourn time if those are given.
std::vector<FreeNumber<TargetChoice>> transition_numbers(const TargetChoice& choice, const TrackScale& scale);

/// Loss of detections among which a few may be outliers: minus robust_log_score. No outlier outweighs the other rows.
class RobustLoss {
 public:
  RobustLoss(const Tracks& tracks, const TrackScale& scale);

  /// Of one track, of its log_scores.
  std::vector<double> operator()(std::size_t track, std::span<const double> log_scores) const;

  /// How many detections are predicted no better than stray ones are.
  double strays(const RowLosses& losses, const RowCounts& counts = {}) const;

  /// The mean loss, and a penalty for each outlier beyond a share of the rows. Held or interpolated positions are
  /// exact in part, and without the penalty settings for these rows alone would win.
  double objective(const RowLosses& losses, const RowCounts& counts = {}, double most_strays = 0.05) const;

 private:
  RowLosses log_strays_;
};

}  // namespace sigmax
