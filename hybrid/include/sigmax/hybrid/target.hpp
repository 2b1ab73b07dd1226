#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/history_set.hpp>
#include <sigmax/hybrid/plot.hpp>
#include <sigmax/hybrid/target_rules.hpp>

namespace sigmax {

/// A filter whose state is the histories of its mode.
template <class Filter>
concept KeepsHistories = requires(const Filter& filter) {
  { filter.state().links() } -> std::same_as<HistoryLinks>;
};

/// One target as it is met in practice: any multiple-model filter with a start, a gate, restarts, late measurements,
/// and a record for smoothing.
///
///     Target target{filter, [](const Gaussian<3>& z) { return one_point_start(z); }, rules};
///     target.take(0.2, z);   // started, then accepted, rejected, …
///     target.take(0.4);      // missed
///
/// `start` gives the estimate, in the filter's `components()`, with which a target starts at one position; or it is
/// asked with the plots that wait, the newest last, and how often it has started before, `start(std::span<const
/// Plot<Sensor>>, std::size_t)`, and gives an optional StartAt: nothing if it wants more of them. A late plot is
/// retrodicted exactly: the buffer is rolled back and what came after is taken again, so that the result is to the bit
/// that of the right order. `take` allocates nothing, if `start` does not and nothing is recorded. References that are
/// returned live as long as the target.
template <class Filter, class Start, Sensing Sensor = PositionSensor<Filter::axes>>
class Target {
 public:
  using Measurement = typename Filter::Measurement;
  using PlotType = Plot<Sensor>;
  using State = typename Filter::State;

  /// Waits for its start; what the filter was started with does not count. Throws std::invalid_argument if a rule
  /// makes no sense.
  Target(Filter filter, Start start, const TargetRules& rules = {})
      : filter_(std::move(filter)), start_(std::move(start)), rules_(rules) {
    if (!(rules.longest_gap > 0.0)) throw std::invalid_argument("the longest gap of a target is not positive");
    for (int m = 1; m <= max_measurement_size; ++m)
      gates_[static_cast<std::size_t>(m)] =
          rules.gate_probability == 1.0 ? no_gate : chi_square_quantile(rules.gate_probability, m);
    life_.waiting.reserve(room());
    buffer_.assign(rules.buffer + 1, Entry{{filter_.state(), life_}, PlotType{}});
    for (Entry& entry : buffer_) entry.before.life.waiting.reserve(room());
  }

  /// Runs already: the filter stands at `time`, in s. Throws std::invalid_argument if that is not finite.
  Target(Filter filter, double time, Start start, const TargetRules& rules = {})
      : Target(std::move(filter), std::move(start), rules) {
    if (!std::isfinite(time)) throw std::invalid_argument("a target starts at a time that is not finite");
    begin(time, PlotType(time));
  }

  /// Takes a plot: a measurement, or the news that there was none. `stepped(plot, is_start)` is called after each step
  /// or start that this completes, with the target as it was left.
  /// Throws std::invalid_argument, naming the times, if it is older than all that the buffer can roll back, and
  /// whatever the filter's step throws; the target is then what it was before.
  template <class Stepped>
  Verdict take(const PlotType& plot, const Stepped& stepped);

  /// @{
  /// The same without `stepped`; a position measured; and none.
  Verdict take(const PlotType& plot) {
    return take(plot, [](const PlotType&, bool) {});
  }
  Verdict take(double time, const Measurement& z) requires std::same_as<Sensor, PositionSensor<Filter::axes>> {
    return take(PlotType(time, z));
  }
  Verdict take(double time) { return take(PlotType(time)); }
  /// @}

  const Filter& filter() const { return filter_; }

  /// Whether it has started and goes on.
  bool running() const { return life_.running; }
  /// How often it started, and how many measurements the gate has turned away.
  std::size_t starts() const { return life_.starts; }
  std::size_t rejected() const { return life_.rejected; }

  /// The time of the latest step or start, and of the latest measurement that was accepted or started the target.
  double time() const { return life_.time; }
  double accepted_time() const { return life_.accepted_time; }

  /// Tells all that is known in other coordinates, as the filter's `transform`; plots that wait or are in the buffer
  /// stay as they were measured, so a target with either is left alone: returns whether it was told.
  bool transform(const SquareMatrix<Eigen::Dynamic, 3>& A, const Vector<Eigen::Dynamic, 3>& b);

  /// What is kept of a step or a start, for smoothing.
  struct Kept {
    double time;
    std::size_t tag;  ///< of the plot
    bool is_start;
    std::optional<double> nis;
    RecordedStep<typename Filter::ModelsType, typename Filter::kind> step;
    HistoryLinks links;  ///< of a filter that keeps histories
  };
  /// Calls visit(kept, state) for all that was recorded, in order, with the smoothed state. What came before a start
  /// knows nothing of what came after it. Throws std::domain_error if it cannot be smoothed, saying back to when.
  template <class Visit>
  void smoothed(const Visit& visit) const {
    smoothed(visit, [](const Kept&, const Table&, bool) {});
  }
  /// Also calls paired(kept, log_pairs, is_last) for each step from one record to the next, backwards from the last one
  /// of each start: log_pairs(i, j) is the smoothed weight of mode i before it and j after, and `kept` what came after.
  template <class Visit, class Paired>
  void smoothed(const Visit& visit, const Paired& paired) const;

  /// When did the mode change? Calls visit(kept, mode) for the first step of each mode in the history that is the most
  /// possible or probable by all that was recorded, in order; of each start its own.
  template <class Visit>
  void explained(const Visit& visit) const requires KeepsHistories<Filter>;

 private:
  /// All of a target that is not its filter's.
  struct Life {
    bool running = false;
    double time = -std::numeric_limits<double>::infinity();
    double accepted_time = -std::numeric_limits<double>::infinity();
    std::size_t rejected = 0;
    std::size_t starts = 0;
    std::size_t recorded = 0;
    std::vector<PlotType> waiting;  ///< for a start; while it runs, those rejected in a row

    /// The time of the latest plot that is in it.
    double latest() const { return waiting.empty() ? time : std::max(time, waiting.back().time); }
  };
  struct Snapshot {
    State state;
    Life life;
  };
  struct Entry {
    Snapshot before;
    PlotType plot;
  };

  std::size_t room() const { return std::max({rules_.waiting, rules_.rejections, std::size_t{1}}); }
  Entry& entry(std::size_t k) { return buffer_[(first_ + k) % buffer_.size()]; }
  void restore(const Snapshot& before) {
    filter_.restore(before.state);
    life_ = before.life;
    record_.erase(record_.begin() + static_cast<std::ptrdiff_t>(life_.recorded), record_.end());
  }

  template <class Stepped>
  Verdict replay(std::size_t k, const Stepped& stepped);
  template <class Stepped>
  Verdict process(const PlotType& plot, const Stepped& stepped);
  template <class Stepped>
  Verdict try_to_start(const PlotType& plot, const Stepped& stepped);
  Verdict step(const PlotType& plot);
  void keep_waiting(const PlotType& plot);
  void begin(double time, const PlotType& plot);
  void record(double dt, const PlotType& plot, bool is_start);

  Filter filter_;
  Start start_;
  TargetRules rules_;
  std::array<double, max_measurement_size + 1> gates_{};  ///< for so many measured quantities
  Life life_;
  std::vector<Kept> record_;
  std::vector<Entry> buffer_;  ///< a ring, oldest first, with room for one more than the rules keep
  std::size_t first_ = 0;
  std::size_t kept_ = 0;
};

template <class Filter, class Start, Sensing Sensor>
template <class Stepped>
Verdict Target<Filter, Start, Sensor>::take(const PlotType& plot, const Stepped& stepped) {
  if (!std::isfinite(plot.time)) throw std::invalid_argument("a measurement of a time that is not finite");
  std::size_t place = kept_;  // behind all that is not later
  while (place > 0 && entry(place - 1).plot.time > plot.time) --place;
  const double earliest = (place < kept_ ? entry(place).before.life : life_).latest();
  if (plot.time < earliest)
    throw std::invalid_argument("a measurement of " + std::to_string(plot.time) + " s came after one of " +
                                std::to_string(life_.latest()) + " s; the buffer goes back to " +
                                std::to_string(earliest) + " s");
  if (place < kept_) restore(entry(place).before);
  for (std::size_t k = kept_; k > place; --k) entry(k).plot = entry(k - 1).plot;
  entry(place).plot = plot;
  Verdict verdict = Verdict::missed;
  try {
    verdict = replay(place, stepped);
    for (std::size_t k = place + 1; k <= kept_; ++k) replay(k, stepped);
  } catch (...) {  // back to what was, which succeeded before
    restore(entry(place).before);
    for (std::size_t k = place; k < kept_; ++k) {
      entry(k).plot = entry(k + 1).plot;
      replay(k, stepped);
    }
    throw;
  }
  if (++kept_ == buffer_.size()) {  // one more than the rules keep
    first_ = (first_ + 1) % buffer_.size();
    --kept_;
  }
  return verdict;
}

/// Takes an entry of the buffer, from where the target stands.
template <class Filter, class Start, Sensing Sensor>
template <class Stepped>
Verdict Target<Filter, Start, Sensor>::replay(std::size_t k, const Stepped& stepped) {
  Entry& event = entry(k);
  event.before.state = filter_.state();
  event.before.life = life_;
  return process(event.plot, stepped);
}

template <class Filter, class Start, Sensing Sensor>
template <class Stepped>
Verdict Target<Filter, Start, Sensor>::process(const PlotType& plot, const Stepped& stepped) {
  if (life_.running && plot.time - life_.accepted_time > rules_.longest_gap) {
    life_.running = false;
    life_.waiting.clear();
  }
  if (!life_.running) {
    keep_waiting(plot);
    return try_to_start(plot, stepped);
  }
  const Verdict verdict = step(plot);
  if (verdict == Verdict::rejected && rules_.rejections > 0 && life_.waiting.size() == rules_.rejections) {
    life_.running = false;
    if (rules_.record) {  // the plot is of a start, or waits for one
      record_.pop_back();
      life_.recorded = record_.size();
    }
    return try_to_start(plot, stepped);
  }
  stepped(plot, false);
  return verdict;
}

template <class Filter, class Start, Sensing Sensor>
Verdict Target<Filter, Start, Sensor>::step(const PlotType& plot) {
  const double dt = plot.time - life_.time;
  if (plot.seen) {
    const auto& [z, sensor] = *plot.seen;
    filter_.step(dt, z, sensor, gates_[static_cast<std::size_t>(z.size())]);
  } else {
    filter_.step(dt);
  }
  life_.time = plot.time;
  if (filter_.measured()) {
    life_.accepted_time = plot.time;
    life_.waiting.clear();
  } else if (plot.seen) {
    ++life_.rejected;
    if (rules_.rejections > 0) keep_waiting(plot);
  }
  record(dt, plot, false);
  return filter_.measured() ? Verdict::accepted : plot.seen ? Verdict::rejected : Verdict::missed;
}

/// Asks for a start with the plots that wait; those that are not in it are steps after it.
template <class Filter, class Start, Sensing Sensor>
template <class Stepped>
Verdict Target<Filter, Start, Sensor>::try_to_start(const PlotType& plot, const Stepped& stepped) {
  const bool again = life_.starts > 0;
  const auto begin_at = [&](const auto& start, bool from_plots) {
    filter_.restart(start.estimates);
    begin(start.time, plot);
    stepped(plot, true);
    const std::vector<PlotType> later = from_plots ? std::vector<PlotType>{} : std::move(life_.waiting);
    life_.waiting.clear();
    for (const PlotType& each : later) {
      step(each);
      stepped(each, false);
    }
    return again ? Verdict::restarted : Verdict::started;
  };
  if constexpr (std::invocable<const Start&, const Measurement&>) {
    const auto position = detail::position_told<Filter::axes>(plot);
    if (position) return begin_at(StartAt<decltype(start_(*position))>{plot.time, start_(*position)}, true);
  } else {
    const std::span<const PlotType> waiting = life_.waiting;
    if (const auto start = start_(waiting, life_.starts)) return begin_at(*start, start->from_plots);
  }
  return Verdict::waiting;
}

/// Where there is no room, a miss goes first, and then the oldest.
template <class Filter, class Start, Sensing Sensor>
void Target<Filter, Start, Sensor>::keep_waiting(const PlotType& plot) {
  auto& waiting = life_.waiting;
  if (waiting.size() == room()) {
    const auto miss = std::find_if(waiting.begin(), waiting.end(), [](const PlotType& each) { return !each.seen; });
    waiting.erase(miss == waiting.end() ? waiting.begin() : miss);
  }
  waiting.push_back(plot);
}

template <class Filter, class Start, Sensing Sensor>
void Target<Filter, Start, Sensor>::begin(double time, const PlotType& plot) {
  life_.running = true;
  life_.time = life_.accepted_time = time;
  ++life_.starts;
  record(0.0, plot, true);
}

template <class Filter, class Start, Sensing Sensor>
void Target<Filter, Start, Sensor>::record(double dt, const PlotType& plot, bool is_start) {
  if (!rules_.record) return;
  const bool measured = filter_.measured();
  record_.push_back({life_.time,
                     plot.tag,
                     is_start,
                     measured ? std::optional(filter_.nis()) : std::nullopt,
                     measured ? filter_.recorded(dt, plot.seen->z, plot.seen->sensor) : filter_.recorded(dt),
                     {}});
  if constexpr (KeepsHistories<Filter>) record_.back().links = filter_.state().links();
  life_.recorded = record_.size();
}

template <class Filter, class Start, Sensing Sensor>
bool Target<Filter, Start, Sensor>::transform(const SquareMatrix<Eigen::Dynamic, 3>& A,
                                              const Vector<Eigen::Dynamic, 3>& b) {
  if (!life_.running || !life_.waiting.empty() || rules_.buffer > 0) return false;
  filter_.transform(A, b);
  std::size_t k = record_.size();
  while (k > 0) {  // back to the last start: what came before it is smoothed without what comes now
    --k;
    for_each_mode(record_[k].step.state.estimates,
                  [&](auto j) { sigmax::transform(A, b, mode(record_[k].step.state.estimates, j)); });
    for (auto& evidence : record_[k].step.seen) evidence.transform(A);
    if (record_[k].is_start) break;
  }
  return true;
}

template <class Filter, class Start, Sensing Sensor>
template <class Visit, class Paired>
void Target<Filter, Start, Sensor>::smoothed(const Visit& visit, const Paired& paired) const {
  FixedIntervalSmoother smoother(filter_);
  std::vector<HybridEstimate<typename Filter::ModelsType, typename Filter::kind>> states;
  for (std::size_t first = 0, end = 0; first < record_.size(); first = end) {
    states.clear();
    for (end = first; end < record_.size() && (end == first || !record_[end].is_start); ++end)
      states.push_back(record_[end].step.state);
    try {
      smoother.begin(record_[end - 1].step);
      for (std::size_t k = end - 1; k-- > first;) {
        smoother.step(record_[k].step);
        states[k - first] = smoother.state();
        paired(record_[k + 1], smoother.log_pairs(), k + 2 == end);
      }
    } catch (const std::domain_error& error) {
      throw std::domain_error("smoothing back to the start at " + std::to_string(record_[first].time) +
                              " s: " + error.what());
    }
    for (std::size_t k = first; k < end; ++k) visit(record_[k], states[k - first]);
  }
}

template <class Filter, class Start, Sensing Sensor>
template <class Visit>
void Target<Filter, Start, Sensor>::explained(const Visit& visit) const requires KeepsHistories<Filter> {
  std::vector<std::size_t> modes(record_.size());
  std::size_t h = 0;
  for (std::size_t k = record_.size(); k-- > 0;) {
    const HistoryLinks& links = record_[k].links;
    if (k + 1 == record_.size() || record_[k + 1].is_start) h = links.best;
    modes[k] = links.all[h].mode;
    h = links.all[h].parent;
  }
  for (std::size_t k = 0; k < record_.size(); ++k)
    if (record_[k].is_start || modes[k] != modes[k - 1]) visit(record_[k], modes[k]);
}

}  // namespace sigmax
