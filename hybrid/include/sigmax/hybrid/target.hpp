#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include <sigmax/hybrid/track_manager.hpp>

namespace sigmax {

/// One target as it is met in practice: any multiple-model filter with a start, a gate, restarts, late measurements,
/// and a record for smoothing.
///
///     Target target{filter, [](const Gaussian<3>& z) { return one_point_start(z); }, rules};
///     target.take(0.2, z);   // started, then accepted, rejected, …
///     target.take(0.4);      // missed
///
/// `start` gives the estimate, in the filter's `components()`, with which a target starts at one position; or it is
/// asked with the detections that wait, the newest last, and how often it has started before, `start(std::span<const
/// Detection>, std::size_t)`, and gives an optional StartAt: nothing if it wants more of them. A late detection is
/// retrodicted exactly: the buffer is rolled back and what came after is taken again, so that the result is to the bit
/// that of the right order. `take` allocates only for a start and for what is recorded. References that are returned
/// live as long as the target.
template <class Filter>
class Target {
  using Life = detail::TrackManager<typename Filter::kind>;

 public:
  using Measurement = typename Filter::Measurement;
  using kind = typename Filter::kind;
  using Kept = KeptStep<kind>;

  /// Waits for its start; what the filter was started with does not count. Throws std::invalid_argument if a rule
  /// makes no sense.
  template <class Start>
  Target(Filter filter, Start start, const TargetRules& rules = {})
      : filter_(std::move(filter)), life_(filter_, rule_of(std::move(start)), rules) {}

  /// Runs already: the filter stands at `time`, in s. Throws std::invalid_argument if that is not finite.
  template <class Start>
  Target(Filter filter, double time, Start start, const TargetRules& rules = {})
      : Target(std::move(filter), std::move(start), rules) {
    life_.begin_at(filter_, time);
  }

  /// Takes a detection: a measurement, or the news that there was none. `stepped(detection, is_start)` is called after
  /// each step or start that this completes, with the target as it was left. Throws std::invalid_argument, naming the
  /// times, if it is older than all that the buffer can roll back, and whatever the filter's step throws; the target is
  /// then what it was before.
  template <class Stepped>
  Verdict take(const Detection& detection, const Stepped& stepped) {
    return life_.take(filter_, detection, std::cref(stepped));
  }

  /// @{
  /// The same without `stepped`; what a sensor measured; a position; and none.
  Verdict take(const Detection& detection) {
    return take(detection, [](const Detection&, bool) {});
  }
  Verdict take(double time, const Measurement& z) requires(Filter::axes != 0) { return take(Detection(time, z)); }
  template <Sensing Sensor>
  Verdict take(double time, const MeasuredBy<Sensor>& measured) {
    return take(Detection(time, measured));
  }
  Verdict take(double time) { return take(Detection(time)); }
  /// @}

  const Filter& filter() const { return filter_; }

  /// Whether it has started and goes on.
  bool running() const { return life_.now().running; }
  /// How often it started, and how many measurements the gate has turned away.
  std::size_t starts() const { return life_.now().starts; }
  std::size_t rejected() const { return life_.now().rejected; }

  /// The time of the latest step or start, and of the latest measurement that was accepted or started the target.
  double time() const { return life_.now().time; }
  double accepted_time() const { return life_.now().accepted_time; }

  /// Changes the coordinates, as the filter's `transform`. Returns false, and changes nothing, if detections wait or
  /// are in the buffer, as these stay as they were measured.
  bool transform(const SquareMatrix<Eigen::Dynamic, 3>& A, const Vector<Eigen::Dynamic, 3>& b) {
    return life_.transform(filter_, A.data(), b.data(), static_cast<int>(b.size()));
  }

  /// Calls visit(kept, state) for all that was recorded, in order, with the smoothed state. What came before a start
  /// knows nothing of what came after it. Throws std::domain_error if it cannot be smoothed, saying back to when.
  template <class Visit>
  void smoothed(const Visit& visit) const {
    life_.smoothed(filter_, std::cref(visit));
  }

  /// When did the mode change? Calls visit(kept, mode) for the first step of each mode in the history that is the most
  /// possible or probable by all that was recorded, in order; of each start its own. For a HistoryFilter; of others
  /// nothing.
  template <class Visit>
  void explained(const Visit& visit) const {
    life_.explained(std::cref(visit));
  }

 private:
  template <class Start>
  static typename Life::StartRule rule_of(Start start) {
    return [start = std::move(start)](std::span<const Detection> waiting,
                                      [[maybe_unused]] std::size_t starts) -> std::optional<StartAt<Estimates>> {
      if constexpr (std::invocable<const Start&, const Measurement&>) {
        const auto position = waiting.back().template position<Filter::axes>();
        if (!position) return std::nullopt;
        return StartAt<Estimates>{waiting.back().time, detail::starts_of(start(*position)), true};
      } else {
        const auto result = start(waiting, starts);
        if (!result) return std::nullopt;
        return StartAt<Estimates>{result->time, detail::starts_of(result->estimates), result->from_detections};
      }
    };
  }

  Filter filter_;
  Life life_;
};

template <class Filter, class Start, class... Rest>
Target(Filter, Start, Rest...) -> Target<Filter>;

}  // namespace sigmax
