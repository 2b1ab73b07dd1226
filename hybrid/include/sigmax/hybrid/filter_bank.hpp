#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sigmax/hybrid/interacting_multiple_model.hpp>

namespace sigmax {

/// Many tracks of one set of models, each as by its own InteractingMultipleModel, to rounding: their numbers stand side
/// by side, and a step takes several of them at once. For models that move along independent axes, and measured
/// positions.
///
///     FilterBank bank{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition};
///     const std::size_t track = bank.add(start);
///     auto scan = bank.scan();
///     scan.set(track, z);
///     bank.step(0.2, scan);   // who has no measurement misses
///     bank.estimate(track);
///
/// Tracks are independent: adding or removing one changes no other. Where a step by the short form would not be good
/// enough (docs/robustness.md), that track takes the general one.
///
/// A `FilterBank<Models, Kind, float>` holds and computes numbers of single precision, which takes half the memory and
/// half the time. A position then has 24 bits: of tracks 100 km from the origin, it is known to a centimetre. Modes
/// that are almost equally likely may be decided otherwise.
template <class Models, ScalableUncertainty Kind, std::floating_point Number = double>
class FilterBank {
  using Shortcut = detail::kinematic::Shortcut<Models, Kind>;
  static_assert(Shortcut::possible, "a FilterBank is for up to four models of motion along independent axes");

 public:
  using Filter = InteractingMultipleModel<Models, Kind>;
  using Measurement = typename Filter::Measurement;
  using Estimates = typename Filter::Estimates;
  using Estimate = typename Filter::Estimate;
  using State = typename Filter::State;
  static constexpr int axes = Filter::axes;

  /// The measurements of one time, at most one for each track.
  class Scan {
   public:
    /// Throws std::invalid_argument if the bank has no such number of a track, or z is not finite.
    void set(std::size_t track, const Measurement& z) {
      if (track >= tracks_)
        throw std::invalid_argument("a scan for " + std::to_string(tracks_) + " tracks has no number " +
                                    std::to_string(track) + "; ask the bank for a new one");
      if (!fits(z.mean) || !fits(z.covariance))
        throw std::invalid_argument("the measurement of track " + std::to_string(track) +
                                    " is not finite, or too great for the bank's numbers");
      Number* const to = numbers_.data() + track / lanes_ * lanes_ * size + track % lanes_;
      for (Eigen::Index i = 0; i < axes; ++i) to[static_cast<std::size_t>(i) * lanes_] = static_cast<Number>(z.mean(i));
      for (Eigen::Index i = 0; i < axes * axes; ++i)
        to[static_cast<std::size_t>(axes + i) * lanes_] = static_cast<Number>(z.covariance.data()[i]);
      to[(size - 1) * lanes_] = 1;
    }
    /// Removes the measurement of one track, or of all.
    void miss(std::size_t track) {
      numbers_[track / lanes_ * lanes_ * size + (size - 1) * lanes_ + track % lanes_] = 0;
    }
    void clear() { std::fill(numbers_.begin(), numbers_.end(), Number{}); }

   private:
    friend FilterBank;
    static constexpr std::size_t size = axes + axes * axes + 1;

    Scan(std::size_t blocks, std::size_t lanes)
        : lanes_(lanes), tracks_(blocks * lanes), numbers_(blocks * lanes * size) {}

    const Number* block(std::size_t number) const { return numbers_.data() + number * lanes_ * size; }

    std::optional<Measurement> of(std::size_t track) const {
      const Number* const from = block(track / lanes_) + track % lanes_;
      if (from[(size - 1) * lanes_] == 0) return std::nullopt;
      Measurement z;
      for (Eigen::Index i = 0; i < axes; ++i) z.mean(i) = from[static_cast<std::size_t>(i) * lanes_];
      for (Eigen::Index i = 0; i < axes * axes; ++i)
        z.covariance.data()[i] = from[static_cast<std::size_t>(axes + i) * lanes_];
      return z;
    }

    std::size_t lanes_;
    std::size_t tracks_;
    std::vector<Number> numbers_;
  };

  /// Throws std::invalid_argument if the transition does not fit the models.
  FilterBank(Models models, ModeTransition<Kind> transition, Interaction<Kind> interaction = {})
      : general_(models, transition, anywhere(models), interaction),
        transition_(std::move(transition)),
        shortcut_(models, interaction),
        lanes_(detail::kinematic::lane_bytes() / sizeof(Number)) {
    numbers_ = general_.modes() + 1;
    for_each_mode(models, [&](auto j) {
      const auto n = static_cast<std::size_t>(mode(models, j).size());
      numbers_ += n + n * (n + 1) / 2;
    });
    lines_of_block_ = (numbers_ * lanes_ + Line{}.size() - 1) / Line{}.size();
  }

  /// Begins a track from the components of one estimate, in the order of the filter's `components()`, and returns its
  /// number: that of a track removed, or the next. Throws std::invalid_argument as the filter's `restart`, and
  /// std::domain_error if a number is too great for the bank's.
  template <int N, int MaxN>
  std::size_t add(const Gaussian<N, MaxN>& start) {
    general_.restart(start);
    return add_started();
  }
  std::size_t add(const Estimates& starts) {
    general_.restart(starts);
    return add_started();
  }

  /// Ends a track. Throws std::invalid_argument if there is none of that number.
  void remove(std::size_t track) {
    require(track);
    lives_[track] = false;
    free_.push_back(track);
    Number* at = block(track / lanes_) + track % lanes_;
    for (std::size_t number = 0; number < numbers_; ++number) at[number * lanes_] = 0;
  }

  /// Tracks that live, and one more than the greatest number that one may have.
  std::size_t size() const { return lives_.size() - free_.size(); }
  std::size_t capacity() const { return lives_.size(); }
  bool lives(std::size_t track) const { return track < lives_.size() && lives_[track]; }

  /// An empty scan with room for the tracks that there are.
  Scan scan() const { return {blocks(), lanes_}; }

  /// One step of all tracks, and one for each scan, `dt` seconds apart; blocks of tracks are shared among the threads,
  /// and the result does not depend on how many there are. Only starting threads allocates.
  /// Throws std::invalid_argument if dt or the size of a scan is wrong, and what the filter's step throws, with the
  /// number of the track; it keeps its state, and later tracks of the same thread may not have been stepped.
  void step(double dt, const Scan& scan) { run(dt, std::span(&scan, 1)); }
  void run(double dt, std::span<const Scan> scans, std::size_t threads = 1) {
    if (!(dt >= 0.0 && std::isfinite(dt)))
      throw std::invalid_argument("a step of " + std::to_string(dt) +
                                  " s; expected a finite time that is not negative");
    for (const Scan& scan : scans)
      if (scan.tracks_ != blocks() * lanes_)
        throw std::invalid_argument("a scan for " + std::to_string(scan.tracks_) + " tracks; the bank has room for " +
                                    std::to_string(blocks() * lanes_) + ": ask it for a new one");
    const bool shortens = shortcut_.prepare(general_.system().models(), dt, transition_.over(dt));
    threads = std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(blocks(), 1));
    if (threads == 1) return run_blocks(dt, scans, shortens, 0, blocks(), general_);
    std::vector<std::exception_ptr> errors(threads);
    std::vector<std::jthread> team;
    for (std::size_t t = 0; t < threads; ++t)
      team.emplace_back([&, t] {
        try {
          Filter general = general_;
          run_blocks(dt, scans, shortens, blocks() * t / threads, blocks() * (t + 1) / threads, general);
        } catch (...) {
          errors[t] = std::current_exception();
        }
      });
    team.clear();  // joins
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
  }

  /// What is known of a track, and its output. Both throw std::invalid_argument if there is none of that number.
  State state(std::size_t track) const {
    require(track);
    State state = general_.state();
    read(track, state);
    return state;
  }
  Estimate estimate(std::size_t track) const { return general_.estimate(state(track)); }

  /// One of the filters that the bank stands for; its state means nothing.
  const Filter& filter() const { return general_; }

 private:
  struct alignas(64) Line : std::array<Number, 64 / sizeof(Number)> {};

  /// Whether all are finite as the bank's numbers.
  template <class Derived>
  static bool fits(const Eigen::MatrixBase<Derived>& numbers) {
    return numbers.template cast<Number>().allFinite();
  }

  static Estimates anywhere(const Models& models) {
    Estimates starts = detail::estimates_for(models);
    for_each_mode(models, [&](auto j) {
      mode(starts, j).mean.setZero(mode(models, j).size());
      mode(starts, j).covariance.setIdentity(mode(models, j).size(), mode(models, j).size());
    });
    return starts;
  }

  std::size_t blocks() const { return lives_.size() / lanes_; }
  Number* block(std::size_t number) { return memory_[number * lines_of_block_].data(); }
  const Number* block(std::size_t number) const { return memory_[number * lines_of_block_].data(); }

  void require(std::size_t track) const {
    if (!lives(track)) throw std::invalid_argument("the bank has no track " + std::to_string(track));
  }

  /// act(stored, known) for every number of a track's estimates, in the order of kinematic_plan.hpp, and where its
  /// weights follow.
  template <class Stored, class Known, class Act>
  static Stored* for_each_number(Stored* at, std::size_t lanes, Known& estimates, const Act& act) {
    for_each_mode(estimates, [&](auto j) {
      auto& estimate = mode(estimates, j);
      const Eigen::Index n = estimate.size();
      const auto pass = [&](auto& known) {
        act(*at, known);
        at += lanes;
      };
      for (Eigen::Index i = 0; i < n; ++i) pass(estimate.mean(i));
      for (Eigen::Index a = 0; a < n; a += axes)
        for (Eigen::Index b = 0; b <= a; b += axes)
          for (Eigen::Index k = 0; k < axes; ++k)
            for (Eigen::Index i = a == b ? k : 0; i < axes; ++i) pass(estimate.covariance(a + i, b + k));
    });
    return at;
  }

  void read(std::size_t track, State& state) const {
    const Number* at = for_each_number(block(track / lanes_) + track % lanes_, lanes_, state.estimates,
                                       [](Number stored, double& known) { known = stored; });
    for_each_mode(state.estimates, [&](auto j) { detail::mirror_lower(mode(state.estimates, j).covariance); });
    state.belief.assign([&](std::size_t j) { return std::log(static_cast<double>(at[j * lanes_])); });
    state.most_likely_mode = static_cast<std::size_t>(at[state.belief.size() * lanes_]);
  }
  void write(std::size_t track, const State& state) {
    for_each_mode(state.estimates, [&](auto j) {
      const auto& estimate = mode(state.estimates, j);
      if (!fits(estimate.mean) || !fits(estimate.covariance))
        throw std::domain_error("track " + std::to_string(track) +
                                " is too far or too uncertain for the bank's numbers");
    });
    Number* at = for_each_number(block(track / lanes_) + track % lanes_, lanes_, state.estimates,
                                 [](Number& stored, double known) { stored = static_cast<Number>(known); });
    for (const double log : state.belief.logs()) {  // however small, what is not excluded can come back
      *at =
          log == log_zero ? Number{} : std::max(static_cast<Number>(std::exp(log)), std::numeric_limits<Number>::min());
      at += lanes_;
    }
    *at = static_cast<Number>(state.most_likely_mode);
  }

  std::size_t add_started() {
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

  /// Has the memory of what comes next read meanwhile.
  static void ask_for(const Number* numbers, std::size_t size) {
    for (std::size_t k = 0; k < size; k += Line{}.size()) __builtin_prefetch(numbers + k);
  }

  void run_blocks(double dt, std::span<const Scan> scans, bool shortens, std::size_t first, std::size_t last,
                  Filter& general) {
    const unsigned all = (2U << (lanes_ - 1)) - 1;
    for (std::size_t number = first; number < last; ++number)
      for (std::size_t s = 0; s < scans.size(); ++s) {
        if (s + 1 < scans.size()) {
          ask_for(scans[s + 1].block(number), Scan::size * lanes_);
        } else if (number + 1 < last) {
          ask_for(scans[0].block(number + 1), Scan::size * lanes_);
          ask_for(block(number + 1), numbers_ * lanes_);
        }
        const Scan& scan = scans[s];
        unsigned left = shortens ? shortcut_.step_block(block(number), scan.block(number)) : all;
        for (std::size_t lane = 0; left != 0; ++lane, left >>= 1U)
          if ((left & 1U) != 0 && lives_[number * lanes_ + lane])
            step_generally(dt, number * lanes_ + lane, scan, general);
      }
  }

  void step_generally(double dt, std::size_t track, const Scan& scan, Filter& general) {
    State state = general.state();
    read(track, state);
    general.restore(state);
    const auto z = scan.of(track);
    try {
      z ? general.step(dt, *z) : general.step(dt);
    } catch (const std::domain_error& error) {
      throw std::domain_error("track " + std::to_string(track) + ", " + error.what());
    }
    write(track, general.state());
  }

  Filter general_;  ///< takes the steps that are not short
  ModeTransition<Kind> transition_;
  Shortcut shortcut_;
  std::size_t lanes_;
  std::size_t numbers_ = 0;  ///< of a track
  std::size_t lines_of_block_ = 0;
  std::vector<Line> memory_;
  std::vector<bool> lives_;
  std::vector<std::size_t> free_;
};

template <class Models, ScalableUncertainty Kind>
FilterBank(Models, Relation<Kind, Kind>) -> FilterBank<Models, Kind>;
template <class Models, ScalableUncertainty Kind>
FilterBank(Models, Relation<Kind, Kind>, Interaction<Kind>) -> FilterBank<Models, Kind>;
template <class Models, class Transition>
FilterBank(Models, Transition) -> FilterBank<Models, typename Transition::kind>;
template <class Models, class Transition, ScalableUncertainty Kind>
FilterBank(Models, Transition, Interaction<Kind>) -> FilterBank<Models, Kind>;

}  // namespace sigmax
