#include <sigmax/hybrid/filter_bank.hpp>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/dense.hpp>
#include <sigmax/hybrid/sound.hpp>

namespace sigmax {
namespace {

/// act(stored, known) for every number of a track's estimates, in the order of a block, and where its
/// weights follow.
template <class Stored, class Known, class Act>
Stored* for_each_number(Stored* at, std::size_t lanes, Known& estimates, const Act& act) {
  const auto pass = [&](auto& known) {
    act(*at, known);
    at += lanes;
  };
  for (std::size_t j = 0; j < estimates.size(); ++j) {
    const auto estimate = estimates.view(j);
    for (int i = 0; i < estimate.n; ++i) pass(estimate.mean[i]);
    for (int i = 0; i < estimate.n; ++i)
      for (int k = 0; k <= i; ++k) pass(estimate.covariance[i + k * estimate.n]);
  }
  return at;
}

}  // namespace

template <std::floating_point Number>
void ScanOfTracks<Number>::set(std::size_t track, detail::ConstView z) {
  if (track >= tracks_)
    throw std::invalid_argument("a scan for " + std::to_string(tracks_) + " tracks has no number " +
                                std::to_string(track) + "; ask the bank for a new one");
  if (z.n != axes_)
    throw std::invalid_argument("the measurement of track " + std::to_string(track) + " has " + std::to_string(z.n) +
                                " quantities; expected " + std::to_string(axes_));
  if (!check::finite(z, std::numeric_limits<Number>::max()))
    throw std::invalid_argument("the measurement of track " + std::to_string(track) +
                                " is not finite, or too great for the bank's numbers");
  Number* to = numbers_.data() + track / lanes_ * lanes_ * size_ + track % lanes_;
  const auto put = [&](double number) {
    *to = static_cast<Number>(number);
    to += lanes_;
  };
  for (int i = 0; i < axes_; ++i) put(z.mean[i]);
  for (int i = 0; i < axes_ * axes_; ++i) put(z.covariance[i]);
  put(1.0);
}

template <std::floating_point Number>
bool ScanOfTracks<Number>::get(std::size_t track, detail::View z) const {
  const Number* const from = block(track / lanes_) + track % lanes_;
  if (from[(size_ - 1) * lanes_] == 0) return false;
  for (int i = 0; i < axes_; ++i) z.mean[i] = from[static_cast<std::size_t>(i) * lanes_];
  for (int i = 0; i < axes_ * axes_; ++i) z.covariance[i] = from[static_cast<std::size_t>(axes_ + i) * lanes_];
  return true;
}

template <ScalableUncertainty Kind, std::floating_point Number>
TrackBank<Kind, Number>::TrackBank(const std::vector<AnyModel>& models, ModeTransition<Kind> transition,
                                   const Interaction<Kind>& interaction)
    : general_(models, std::move(transition), detail::anywhere(models), interaction),
      lanes_(detail::lane_bytes() / sizeof(Number)) {
  if (general_.fast_path().axes() == 0)
    throw std::invalid_argument("a bank of tracks is for up to four models that move along the same independent axes");
  numbers_ = models.size() + 1;
  for (const AnyModel& model : models) {
    const auto n = static_cast<std::size_t>(model.size());
    numbers_ += n + n * (n + 1) / 2;
  }
  lines_of_block_ = (numbers_ * lanes_ + Line{}.size() - 1) / Line{}.size();
}

template <ScalableUncertainty Kind, std::floating_point Number>
std::size_t TrackBank<Kind, Number>::add_started() {
  if (free_.empty()) {
    for (std::size_t lane = lanes_; lane > 0; --lane) free_.push_back(lives_.size() + lane - 1);
    lives_.resize(lives_.size() + lanes_, false);
    memory_.resize(memory_.size() + lines_of_block_);
  }
  const std::size_t track = free_.back();
  write(track, general_.state());
  free_.pop_back();
  lives_[track] = true;
  return track;
}

template <ScalableUncertainty Kind, std::floating_point Number>
void TrackBank<Kind, Number>::remove(std::size_t track) {
  require(track);
  lives_[track] = false;
  free_.push_back(track);
  Number* at = block(track / lanes_) + track % lanes_;
  for (std::size_t number = 0; number < numbers_; ++number) at[number * lanes_] = 0;
}

template <ScalableUncertainty Kind, std::floating_point Number>
void TrackBank<Kind, Number>::require(std::size_t track) const {
  if (!lives(track)) throw std::invalid_argument("the bank has no track " + std::to_string(track));
}

template <ScalableUncertainty Kind, std::floating_point Number>
HybridEstimate<Kind> TrackBank<Kind, Number>::state(std::size_t track) const {
  require(track);
  State state = general_.state();
  read(track, state);
  return state;
}

template <ScalableUncertainty Kind, std::floating_point Number>
void TrackBank<Kind, Number>::read(std::size_t track, State& state) const {
  const Number* const at = for_each_number(block(track / lanes_) + track % lanes_, lanes_, state.estimates,
                                           [](Number stored, double& known) { known = stored; });
  for (std::size_t j = 0; j < state.estimates.size(); ++j) {
    const detail::View estimate = state.estimates.view(j);
    detail::mirror_lower(estimate.covariance, estimate.n);
  }
  state.belief.assign([&](std::size_t j) { return std::log(static_cast<double>(at[j * lanes_])); });
  state.most_likely_mode = static_cast<std::size_t>(at[state.belief.size() * lanes_]);
}

template <ScalableUncertainty Kind, std::floating_point Number>
void TrackBank<Kind, Number>::write(std::size_t track, const State& state) {
  for (std::size_t j = 0; j < state.estimates.size(); ++j)
    if (!check::finite(state.estimates.view(j), std::numeric_limits<Number>::max()))
      throw std::domain_error("track " + std::to_string(track) + " is too far or too uncertain for the bank's numbers");
  Number* at = for_each_number(block(track / lanes_) + track % lanes_, lanes_, state.estimates,
                               [](Number& stored, double known) { stored = static_cast<Number>(known); });
  for (const double log : state.belief.logs()) {  // however small, what is not excluded can come back
    *at = log == log_zero ? Number{} : std::max(static_cast<Number>(std::exp(log)), std::numeric_limits<Number>::min());
    at += lanes_;
  }
  *at = static_cast<Number>(state.most_likely_mode);
}

template <ScalableUncertainty Kind, std::floating_point Number>
void TrackBank<Kind, Number>::run(double dt, std::span<const ScanOfTracks<Number>> scans, std::size_t threads) {
  if (!(dt >= 0.0 && std::isfinite(dt)))
    throw std::invalid_argument("a step of " + std::to_string(dt) + " s; expected a finite time that is not negative");
  for (const auto& scan : scans)
    if (scan.tracks_ != blocks() * lanes_)
      throw std::invalid_argument("a scan for " + std::to_string(scan.tracks_) + " tracks; the bank has room for " +
                                  std::to_string(blocks() * lanes_) + ": ask it for a new one");
  const bool fast = general_.prepare_fast_path(dt);
  threads = std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(blocks(), 1));
  if (threads == 1) return run_blocks(dt, scans, fast, 0, blocks(), general_);
  std::vector<std::future<void>> team;
  for (std::size_t t = 0; t < threads; ++t)
    team.push_back(std::async(std::launch::async, [&, t] {
      Filter general = general_;
      run_blocks(dt, scans, fast, blocks() * t / threads, blocks() * (t + 1) / threads, general);
    }));
  for (auto& each : team) each.wait();
  for (auto& each : team) each.get();
}

template <ScalableUncertainty Kind, std::floating_point Number>
void TrackBank<Kind, Number>::run_blocks(double dt, std::span<const ScanOfTracks<Number>> scans, bool fast,
                                         std::size_t first, std::size_t last, Filter& general) {
  const auto ask_for = [](const Number* numbers, std::size_t size) {  // has what comes next read meanwhile
    for (std::size_t k = 0; k < size; k += Line{}.size()) __builtin_prefetch(numbers + k);
  };
  const unsigned all = (2U << (lanes_ - 1)) - 1;
  for (std::size_t number = first; number < last; ++number)
    for (std::size_t s = 0; s < scans.size(); ++s) {
      const auto& scan = scans[s];
      if (s + 1 < scans.size()) {
        ask_for(scans[s + 1].block(number), scan.size_ * lanes_);
      } else if (number + 1 < last) {
        ask_for(scans[0].block(number + 1), scan.size_ * lanes_);
        ask_for(block(number + 1), numbers_ * lanes_);
      }
      unsigned left = fast ? general.fast_path().step_block(block(number), scan.block(number)) : all;
      for (std::size_t lane = 0; left != 0; ++lane, left >>= 1U)
        if ((left & 1U) != 0 && lives_[number * lanes_ + lane])
          step_generally(dt, number * lanes_ + lane, scan, general);
    }
}

template <ScalableUncertainty Kind, std::floating_point Number>
void TrackBank<Kind, Number>::step_generally(double dt, std::size_t track, const ScanOfTracks<Number>& scan,
                                             Filter& general) {
  State state = general.state();
  read(track, state);
  general.restore(state);
  double mean[3], covariance[9];
  const detail::View z{mean, covariance, general.fast_path().axes()};
  try {
    const Seen seen{z, detail::sensor_of_models(detail::position_sensor(z.n))};
    general.step(dt, scan.get(track, z) ? &seen : nullptr);
  } catch (const std::domain_error& error) {
    throw std::domain_error("track " + std::to_string(track) + ", " + error.what());
  }
  write(track, general.state());
}

template class ScanOfTracks<double>;
template class ScanOfTracks<float>;
template class TrackBank<Random, double>;
template class TrackBank<Random, float>;
template class TrackBank<Fuzzy, double>;
template class TrackBank<Fuzzy, float>;

}  // namespace sigmax
