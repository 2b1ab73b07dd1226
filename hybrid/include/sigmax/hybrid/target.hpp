#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/estimation/chi_square.hpp>
#include <sigmax/hybrid/multiple_model_filter.hpp>

namespace sigmax {

/// What to do with measurements that are late, missing or not of the target.
struct TargetRules {
  double gate_probability = 0.9999;  ///< of the target's own measurement to pass the gate on the NIS, below 1
  std::size_t rejections = 3;        ///< so many in a row, and the last of them starts the target again
  double longest_gap = std::numeric_limits<double>::infinity();  ///< s; if none was accepted for longer, the next
                                                                 ///< starts the target again
  std::size_t buffer = 0;  ///< steps that are kept: a measurement that belongs among them may come late
};

/// What became of a measurement.
enum class Verdict { accepted, rejected, restarted, missed };

/// One target as it is met in practice: any multiple-model filter with a gate, restarts, and late measurements.
///
///     Target target{filter, 0.0, [](const Gaussian<3>& z) { return one_point_start(z); }, rules};
///     target.take(0.2, z);   // accepted, rejected or restarted
///     target.take(0.4);      // missed
///
/// `start(z)` gives the estimate, in the filter's `components()`, with which a target starts at one measurement. A late
/// measurement is retrodicted exactly: the buffer is rolled back and what came after is taken again, so that the result
/// is to the bit that of the right order. `take` allocates nothing, if `start` does not.
template <class Filter, class Start>
class Target {
 public:
  using Measurement = typename Filter::Measurement;

  /// The filter stands at `time`, in s. Throws std::invalid_argument if the time or a rule makes no sense.
  Target(Filter filter, double time, Start start, const TargetRules& rules = {})
      : filter_(std::move(filter)),
        start_(std::move(start)),
        rules_(rules),
        gate_(chi_square_quantile(rules.gate_probability, Filter::measurement_size)),
        time_(time),
        accepted_time_(time),
        buffer_(rules.buffer + 1, Entry{snapshot(), time, std::nullopt}) {
    if (!std::isfinite(time)) throw std::invalid_argument("a target starts at a time that is not finite");
    if (rules.rejections == 0) throw std::invalid_argument("a target starts again after one rejection or more");
    if (!(rules.longest_gap > 0.0)) throw std::invalid_argument("the longest gap of a target is not positive");
  }

  /// Takes a measurement, or the news that there was none at that time.
  /// Throws std::invalid_argument, naming the times, if it is older than all that the buffer can roll back, and
  /// whatever the filter's step throws; the target is then what it was before.
  Verdict take(double time, const Measurement& z) { return take_event(time, z); }
  Verdict take(double time) { return take_event(time, std::nullopt); }

  const Filter& filter() const { return filter_; }

  /// The time of the latest measurement or miss, and of the latest measurement that was accepted or started the target.
  double time() const { return time_; }
  double accepted_time() const { return accepted_time_; }

 private:
  struct Snapshot {
    typename Filter::State state;
    double time;
    double accepted_time;
    std::size_t rejected;
  };
  struct Entry {
    Snapshot before;
    double time;
    std::optional<Measurement> z;
  };

  Snapshot snapshot() const { return {filter_.state(), time_, accepted_time_, rejected_}; }
  Entry& entry(std::size_t k) { return buffer_[(first_ + k) % buffer_.size()]; }

  void restore(const Snapshot& before) {
    filter_.restore(before.state);
    time_ = before.time;
    accepted_time_ = before.accepted_time;
    rejected_ = before.rejected;
  }

  Verdict take_event(double time, const std::optional<Measurement>& z) {
    if (!std::isfinite(time)) throw std::invalid_argument("a measurement of a time that is not finite");
    std::size_t place = kept_;  // behind all that is not later
    while (place > 0 && entry(place - 1).time > time) --place;
    const double earliest = place < kept_ ? entry(place).before.time : time_;
    if (time < earliest)
      throw std::invalid_argument("a measurement of " + std::to_string(time) + " s came after one of " +
                                  std::to_string(time_) + " s; the buffer goes back to " + std::to_string(earliest) +
                                  " s");
    if (place < kept_) restore(entry(place).before);
    for (std::size_t k = kept_; k > place; --k) move_event(entry(k - 1), entry(k));
    entry(place).time = time;
    entry(place).z = z;
    Verdict verdict = Verdict::missed;
    try {
      verdict = replay(place);
      for (std::size_t k = place + 1; k <= kept_; ++k) replay(k);
    } catch (...) {  // back to what was, which succeeded before
      restore(entry(place).before);
      for (std::size_t k = place; k < kept_; ++k) {
        move_event(entry(k + 1), entry(k));
        replay(k);
      }
      throw;
    }
    if (++kept_ == buffer_.size()) {  // one more than the rules keep
      first_ = (first_ + 1) % buffer_.size();
      --kept_;
    }
    return verdict;
  }

  static void move_event(const Entry& from, Entry& to) {
    to.time = from.time;
    to.z = from.z;
  }

  /// Takes an entry of the buffer, from where the target stands.
  Verdict replay(std::size_t k) {
    Entry& event = entry(k);
    event.before.state = filter_.state();
    event.before.time = time_;
    event.before.accepted_time = accepted_time_;
    event.before.rejected = rejected_;
    const Verdict verdict = process(event.time, event.z);
    time_ = event.time;
    return verdict;
  }

  Verdict process(double time, const std::optional<Measurement>& z) {
    if (!z) {
      filter_.step(time - time_);
      return Verdict::missed;
    }
    if (time - accepted_time_ > rules_.longest_gap) return restart(time, *z);
    filter_.step(time - time_, *z, gate_);
    if (filter_.measured()) {
      accepted_time_ = time;
      rejected_ = 0;
      return Verdict::accepted;
    }
    return ++rejected_ < rules_.rejections ? Verdict::rejected : restart(time, *z);
  }

  Verdict restart(double time, const Measurement& z) {
    filter_.restart(start_(z));
    accepted_time_ = time;
    rejected_ = 0;
    return Verdict::restarted;
  }

  Filter filter_;
  Start start_;
  TargetRules rules_;
  double gate_;
  double time_;
  double accepted_time_;
  std::size_t rejected_ = 0;   ///< in a row
  std::vector<Entry> buffer_;  ///< a ring, oldest first, with room for one more than the rules keep
  std::size_t first_ = 0;
  std::size_t kept_ = 0;
};

}  // namespace sigmax
