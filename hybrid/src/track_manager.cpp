#include <sigmax/hybrid/track_manager.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/filtering.hpp>

namespace sigmax::detail {
namespace {

std::optional<Seen> seen_of(const Detection& detection) {
  if (!detection.seen()) return std::nullopt;
  return Seen{detection.measurement(), sensor_of_models(detection.sensor())};
}

}  // namespace

template <ScalableUncertainty Kind>
TrackManager<Kind>::TrackManager(const Filter& filter, StartRule start, const TargetRules& rules)
    : start_(std::move(start)), rules_(rules), gate_(Gate::probability(rules.gate_probability)) {
  if (!(rules.longest_gap > 0.0)) throw std::invalid_argument("the longest gap of a target is not positive");
  now_.waiting.reserve(room());
  buffer_.assign(rules.buffer + 1, Entry{filter.state(), now_, Detection{}});
  for (Entry& entry : buffer_) entry.life.waiting.reserve(room());
}

template <ScalableUncertainty Kind>
std::size_t TrackManager<Kind>::room() const {
  return std::max({rules_.waiting, rules_.rejections, std::size_t{1}});
}

template <ScalableUncertainty Kind>
void TrackManager<Kind>::begin_at(const Filter& filter, double time) {
  if (!std::isfinite(time)) throw std::invalid_argument("a target starts at a time that is not finite");
  begin(filter, time, Detection(time));
}

template <ScalableUncertainty Kind>
Verdict TrackManager<Kind>::take(Filter& filter, const Detection& detection, const Stepped& stepped) {
  if (!std::isfinite(detection.time)) throw std::invalid_argument("a measurement of a time that is not finite");
  std::size_t place = kept_;  // behind all that is not later
  while (place > 0 && buffer_[place - 1].detection.time > detection.time) --place;
  const double earliest = (place < kept_ ? buffer_[place].life : now_).latest();
  if (detection.time < earliest)
    throw std::invalid_argument("a measurement of " + std::to_string(detection.time) + " s came after one of " +
                                std::to_string(now_.latest()) + " s; the buffer goes back to " +
                                std::to_string(earliest) + " s");
  if (place < kept_) restore(filter, buffer_[place]);
  for (std::size_t k = kept_; k > place; --k) buffer_[k].detection = buffer_[k - 1].detection;
  buffer_[place].detection = detection;
  Verdict verdict = Verdict::missed;
  try {
    verdict = replay(filter, place, stepped);
    for (std::size_t k = place + 1; k <= kept_; ++k) replay(filter, k, stepped);
  } catch (...) {  // back to what was, which succeeded before
    restore(filter, buffer_[place]);
    for (std::size_t k = place; k < kept_; ++k) {
      buffer_[k].detection = buffer_[k + 1].detection;
      replay(filter, k, stepped);
    }
    throw;
  }
  if (kept_ + 1 < buffer_.size())
    ++kept_;
  else
    std::rotate(buffer_.begin(), buffer_.begin() + 1, buffer_.end());  // one more than the rules keep
  return verdict;
}

template <ScalableUncertainty Kind>
void TrackManager<Kind>::restore(Filter& filter, const Entry& before) {
  filter.restore(before.state);
  now_ = before.life;
  record_.erase(record_.begin() + static_cast<std::ptrdiff_t>(now_.recorded), record_.end());
}

/// Takes an entry of the buffer, from where the target stands.
template <ScalableUncertainty Kind>
Verdict TrackManager<Kind>::replay(Filter& filter, std::size_t k, const Stepped& stepped) {
  buffer_[k].state = filter.state();
  buffer_[k].life = now_;
  return process(filter, buffer_[k].detection, stepped);
}

template <ScalableUncertainty Kind>
Verdict TrackManager<Kind>::process(Filter& filter, const Detection& detection, const Stepped& stepped) {
  if (now_.running && detection.time - now_.accepted_time > rules_.longest_gap) {
    now_.running = false;
    now_.waiting.clear();
  }
  if (!now_.running) {
    keep_waiting(detection);
    return try_to_start(filter, detection, stepped);
  }
  const Verdict verdict = step(filter, detection);
  if (verdict == Verdict::rejected && rules_.rejections > 0 && now_.waiting.size() == rules_.rejections) {
    now_.running = false;
    if (rules_.record) {  // the detection is of a start, or waits for one
      record_.pop_back();
      now_.recorded = record_.size();
    }
    return try_to_start(filter, detection, stepped);
  }
  stepped(detection, false);
  return verdict;
}

template <ScalableUncertainty Kind>
Verdict TrackManager<Kind>::step(Filter& filter, const Detection& detection) {
  const double dt = detection.time - now_.time;
  const auto seen = seen_of(detection);
  filter.step(dt, seen ? &*seen : nullptr, gate_);
  now_.time = detection.time;
  if (filter.accepted()) {
    now_.accepted_time = detection.time;
    now_.waiting.clear();
  } else if (detection.seen()) {
    ++now_.rejected;
    if (rules_.rejections > 0) keep_waiting(detection);
  }
  record(filter, dt, detection, false);
  return filter.accepted() ? Verdict::accepted : detection.seen() ? Verdict::rejected : Verdict::missed;
}

/// Asks for a start with the detections that wait; those that are not in it are steps after it.
template <ScalableUncertainty Kind>
Verdict TrackManager<Kind>::try_to_start(Filter& filter, const Detection& detection, const Stepped& stepped) {
  const bool again = now_.starts > 0;
  const auto start = start_(now_.waiting, now_.starts);
  if (!start) return Verdict::waiting;
  if (start->estimates.size() == 1 && filter.modes() > 1)
    filter.restart(std::as_const(start->estimates).view(0));
  else
    filter.restart(start->estimates);
  begin(filter, start->time, detection);
  stepped(detection, true);
  const std::vector<Detection> later = start->from_detections ? std::vector<Detection>{} : std::move(now_.waiting);
  now_.waiting.clear();
  for (const Detection& each : later) {
    step(filter, each);
    stepped(each, false);
  }
  return again ? Verdict::restarted : Verdict::started;
}

/// Where there is no room, a miss goes first, and then the oldest.
template <ScalableUncertainty Kind>
void TrackManager<Kind>::keep_waiting(const Detection& detection) {
  auto& waiting = now_.waiting;
  if (waiting.size() == room()) {
    const auto miss = std::find_if(waiting.begin(), waiting.end(), [](const Detection& each) { return !each.seen(); });
    waiting.erase(miss == waiting.end() ? waiting.begin() : miss);
  }
  waiting.push_back(detection);
}

template <ScalableUncertainty Kind>
void TrackManager<Kind>::begin(const Filter& filter, double time, const Detection& detection) {
  now_.running = true;
  now_.time = now_.accepted_time = time;
  ++now_.starts;
  record(filter, 0.0, detection, true);
}

template <ScalableUncertainty Kind>
void TrackManager<Kind>::record(const Filter& filter, double dt, const Detection& detection, bool is_start) {
  if (!rules_.record) return;
  const auto seen = filter.accepted() ? seen_of(detection) : std::nullopt;
  const auto histories = filter.state().histories.all();
  record_.push_back({now_.time,
                     detection.tag,
                     is_start,
                     seen ? std::optional(filter.nis()) : std::nullopt,
                     filter.recorded(dt, seen ? &*seen : nullptr),
                     {histories.begin(), histories.end()}});
  now_.recorded = record_.size();
}

template <ScalableUncertainty Kind>
bool TrackManager<Kind>::transform(Filter& filter, const double* A, const double* b, int axes) {
  if (!now_.running || !now_.waiting.empty() || rules_.buffer > 0) return false;
  filter.transform(A, b, axes);
  for (std::size_t k = record_.size(); k-- > 0;) {  // to the last start: what came before is smoothed without it
    RecordedStep<Kind>& step = record_[k].step;
    for (std::size_t j = 0; j < step.state.estimates.size(); ++j)
      detail::transform(A, b, axes, step.state.estimates.view(j));
    for (FutureEvidence& evidence : step.seen) evidence.transform(A, axes);
    if (record_[k].is_start) break;
  }
  return true;
}

template <ScalableUncertainty Kind>
void TrackManager<Kind>::smoothed(const Filter& filter,
                                  const std::function<void(const Kept&, const HybridEstimate<Kind>&)>& visit) const {
  FixedIntervalSmoother<Kind> smoother(filter);
  std::vector<HybridEstimate<Kind>> states;
  for (std::size_t first = 0, end = 1; first < record_.size(); first = end++) {
    while (end < record_.size() && !record_[end].is_start) ++end;
    states.resize(end - first, filter.state());
    try {
      smoother.back_over(
          first, end, [&](std::size_t k) -> const auto& { return record_[k].step; },
          [&](std::size_t k) { states[k - first] = smoother.state(); });
    } catch (const std::domain_error& error) {
      throw std::domain_error("smoothing back to the start at " + std::to_string(record_[first].time) +
                              " s: " + error.what());
    }
    for (std::size_t k = first; k < end; ++k) visit(record_[k], states[k - first]);
  }
}

template <ScalableUncertainty Kind>
void TrackManager<Kind>::explained(const std::function<void(const Kept&, std::size_t)>& visit) const {
  std::vector<std::size_t> modes(record_.size());
  std::size_t h = 0;
  for (std::size_t k = record_.size(); k-- > 0;) {
    const std::vector<History>& histories = record_[k].histories;
    if (histories.empty()) return;
    if (k + 1 == record_.size() || record_[k + 1].is_start) h = best_of(histories);
    modes[k] = histories[h].mode;
    h = histories[h].parent;
  }
  for (std::size_t k = 0; k < record_.size(); ++k)
    if (record_[k].is_start || modes[k] != modes[k - 1]) visit(record_[k], modes[k]);
}

template class TrackManager<Random>;
template class TrackManager<Fuzzy>;

}  // namespace sigmax::detail
