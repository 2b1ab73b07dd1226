#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <sigmax/hybrid/detection.hpp>
#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/target_rules.hpp>

namespace sigmax {

/// What is kept of a step or a start, for smoothing.
template <ScalableUncertainty Kind>
struct KeptStep {
  double time;
  std::size_t tag;  ///< of the detection
  bool is_start;
  std::optional<double> nis;
  RecordedStep<Kind> step;
  std::vector<History> histories;  ///< of a filter that keeps them
};

namespace detail {

/// All of a target that is not its filter's; see Target.
struct Life {
  bool running = false;
  double time = -std::numeric_limits<double>::infinity();
  double accepted_time = -std::numeric_limits<double>::infinity();
  std::size_t rejected = 0;
  std::size_t starts = 0;
  std::size_t recorded = 0;
  std::vector<Detection> waiting;  ///< for a start; while it runs, those rejected in a row

  /// The time of the latest detection that is in it.
  double latest() const { return waiting.empty() ? time : std::max(time, waiting.back().time); }
};

/// The life of a target, compiled once for each kind; see Target. The filter is the caller's, always the same.
template <ScalableUncertainty Kind>
class TrackManager {
  using Filter = MultipleModelFilter<Kind>;

 public:
  using Kept = KeptStep<Kind>;
  using Stepped = std::function<void(const Detection&, bool)>;
  using StartRule = std::function<std::optional<StartAt<Estimates>>(std::span<const Detection>, std::size_t)>;

  /// Throws std::invalid_argument if a rule makes no sense.
  TrackManager(const Filter& filter, StartRule start, const TargetRules& rules);

  /// Runs already: the filter stands at `time`, in s. Throws std::invalid_argument if that is not finite.
  void begin_at(const Filter& filter, double time);

  Verdict take(Filter& filter, const Detection& detection, const Stepped& stepped);
  bool transform(Filter& filter, const double* A, const double* b, int axes);
  void smoothed(const Filter& filter, const std::function<void(const Kept&, const HybridEstimate<Kind>&)>& visit) const;
  void explained(const std::function<void(const Kept&, std::size_t)>& visit) const;

  const Life& now() const { return now_; }

 private:
  struct Entry {
    HybridEstimate<Kind> state;  ///< before the detection, and the life then
    Life life;
    Detection detection;
  };

  std::size_t room() const;
  void restore(Filter& filter, const Entry& before);

  Verdict replay(Filter& filter, std::size_t k, const Stepped& stepped);
  Verdict process(Filter& filter, const Detection& detection, const Stepped& stepped);
  Verdict try_to_start(Filter& filter, const Detection& detection, const Stepped& stepped);
  Verdict step(Filter& filter, const Detection& detection);
  void keep_waiting(const Detection& detection);
  void begin(const Filter& filter, double time, const Detection& detection);
  void record(const Filter& filter, double dt, const Detection& detection, bool is_start);

  StartRule start_;
  TargetRules rules_;
  Gate gate_;
  Life now_;
  std::vector<Kept> record_;
  std::vector<Entry> buffer_;  ///< oldest first, with room for one more than the rules keep
  std::size_t kept_ = 0;
};

extern template class TrackManager<Random>;
extern template class TrackManager<Fuzzy>;

}  // namespace detail
}  // namespace sigmax
