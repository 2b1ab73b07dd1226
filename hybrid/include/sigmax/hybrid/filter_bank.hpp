#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <sigmax/hybrid/interacting_multiple_model.hpp>

namespace sigmax {

/// The measurements of one time for tracks of a bank, at most one for each.
template <std::floating_point Number>
class ScanOfTracks {
 public:
  /// Throws std::invalid_argument if the bank has no such number of a track, or z is not finite.
  void set(std::size_t track, detail::ConstView z);
  /// Removes the measurement of one track, or of all.
  void miss(std::size_t track) {
    numbers_[track / lanes_ * lanes_ * size_ + (size_ - 1) * lanes_ + track % lanes_] = 0;
  }
  void clear() { numbers_.assign(numbers_.size(), Number{}); }

 private:
  template <ScalableUncertainty, std::floating_point>
  friend class TrackBank;

  ScanOfTracks(std::size_t blocks, std::size_t lanes, int axes)
      : axes_(axes),
        size_(static_cast<std::size_t>(axes + axes * axes + 1)),
        lanes_(lanes),
        tracks_(blocks * lanes),
        numbers_(tracks_ * size_) {}

  const Number* block(std::size_t number) const { return numbers_.data() + number * lanes_ * size_; }

  /// Whether there is one of this track; z takes it.
  bool get(std::size_t track, detail::View z) const;

  int axes_;
  std::size_t size_;  ///< numbers of a track: z, R and whether there is one
  std::size_t lanes_;
  std::size_t tracks_;
  std::vector<Number> numbers_;
};

/// A bank of tracks in plain numbers; see FilterBank.
template <ScalableUncertainty Kind, std::floating_point Number>
class TrackBank {
 public:
  using Filter = InteractingFilter<Kind>;
  using State = HybridEstimate<Kind>;

  /// Throws std::invalid_argument if the transition does not fit the models, or they do not move along the same
  /// independent axes.
  TrackBank(const std::vector<AnyModel>& models, ModeTransition<Kind> transition, const Interaction<Kind>& interaction);

  /// Begins a track from one estimate in the order of the components, or from one for each model.
  template <class Start>
  std::size_t add(const Start& start) {
    general_.restart(start);
    return add_started();
  }

  /// Ends a track. Throws std::invalid_argument if there is none of that number.
  void remove(std::size_t track);

  /// Tracks that live, and one more than the greatest number that one may have.
  std::size_t size() const { return lives_.size() - free_.size(); }
  std::size_t capacity() const { return lives_.size(); }
  bool lives(std::size_t track) const { return track < lives_.size() && lives_[track]; }

  /// An empty scan with room for the tracks that there are.
  ScanOfTracks<Number> scan() const { return {blocks(), lanes_, general_.fast_path().axes()}; }

  void run(double dt, std::span<const ScanOfTracks<Number>> scans, std::size_t threads);

  /// What is known of a track. Throws std::invalid_argument if there is none of that number.
  State state(std::size_t track) const;

  const Filter& filter() const { return general_; }

 private:
  struct alignas(64) Line : std::array<Number, 64 / sizeof(Number)> {};

  std::size_t blocks() const { return lives_.size() / lanes_; }
  Number* block(std::size_t number) { return memory_[number * lines_of_block_].data(); }
  const Number* block(std::size_t number) const { return memory_[number * lines_of_block_].data(); }

  void require(std::size_t track) const;
  void read(std::size_t track, State& state) const;
  void write(std::size_t track, const State& state);
  std::size_t add_started();
  void run_blocks(double dt, std::span<const ScanOfTracks<Number>> scans, bool fast, std::size_t first,
                  std::size_t last, Filter& general);
  void step_generally(double dt, std::size_t track, const ScanOfTracks<Number>& scan, Filter& general);

  Filter general_;  ///< takes the steps that are not fast
  std::size_t lanes_;
  std::size_t numbers_ = 0;  ///< of a track
  std::size_t lines_of_block_ = 0;
  std::vector<Line> memory_;
  std::vector<bool> lives_;
  std::vector<std::size_t> free_;
};

extern template class ScanOfTracks<double>;
extern template class ScanOfTracks<float>;
extern template class TrackBank<Random, double>;
extern template class TrackBank<Random, float>;
extern template class TrackBank<Fuzzy, double>;
extern template class TrackBank<Fuzzy, float>;

namespace detail {

/// Whether a model may move along independent axes, as far as its type tells.
template <class Model>
inline constexpr bool may_move_along_axes = AxisMotion<AskedAs<Model>>::value;
template <>
inline constexpr bool may_move_along_axes<AnyModel> = true;

template <class Models>
inline constexpr bool may_all_move_along_axes = false;
template <class... Model>
inline constexpr bool may_all_move_along_axes<std::tuple<Model...>> = sizeof...(Model) <= StepPlan::max_modes &&
                                                                      (may_move_along_axes<Model> && ...);
template <class Model>
inline constexpr bool may_all_move_along_axes<std::vector<Model>> = may_move_along_axes<Model>;

}  // namespace detail

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
/// Tracks are independent: adding or removing one changes no other. Where a step by the fast path would not be good
/// enough (docs/robustness.md), that track takes the general one.
///
/// A `FilterBank<Models, Kind, float>` holds and computes numbers of single precision, which takes half the memory and
/// half the time. A position then has 24 bits: of tracks 100 km from the origin, it is known to a centimetre. Modes
/// that are almost equally likely may be decided otherwise.
template <class Models, ScalableUncertainty Kind, std::floating_point Number = double>
class FilterBank : public TrackBank<Kind, Number> {
  static_assert(detail::may_all_move_along_axes<Models>,
                "a FilterBank is for up to four models of motion along independent axes");
  using Tracks = TrackBank<Kind, Number>;

 public:
  using Filter = InteractingMultipleModel<Models, Kind>;
  using Measurement = typename Filter::Measurement;
  using Starts = typename Filter::Starts;
  using Estimate = typename Filter::Estimate;
  static constexpr int axes = Filter::axes;

  class Scan : public ScanOfTracks<Number> {
   public:
    Scan(ScanOfTracks<Number> scan) : ScanOfTracks<Number>(std::move(scan)) {}
    /// Throws std::invalid_argument if the bank has no such number of a track, or z is not finite.
    void set(std::size_t track, const Measurement& z) { ScanOfTracks<Number>::set(track, detail::view(z)); }
  };

  /// Throws std::invalid_argument if the transition does not fit the models.
  FilterBank(const Models& models, ModeTransition<Kind> transition, const Interaction<Kind>& interaction = {})
      : Tracks(detail::bank_of(models), std::move(transition), interaction) {}

  /// Begins a track from the components of one estimate, in the order of the filter's `components()`, and returns its
  /// number: that of a track removed, or the next. Throws std::invalid_argument as the filter's `restart`, and
  /// std::domain_error if a number is too great for the bank's.
  template <int N, int MaxN>
  std::size_t add(const Gaussian<N, MaxN>& start) {
    return Tracks::add(detail::view(start));
  }
  std::size_t add(const Starts& starts) { return Tracks::add(detail::starts_of(starts)); }

  /// An empty scan with room for the tracks that there are.
  Scan scan() const { return Tracks::scan(); }

  /// Steps all tracks once, or once for each scan, `dt` seconds apart. Threads share blocks of tracks; the result does
  /// not depend on the number of threads. Only starting threads allocates.
  /// Throws std::invalid_argument if dt or the size of a scan is wrong, and what the filter's step throws, with the
  /// number of the track; it keeps its state, and later tracks of the same thread may not have been stepped.
  void step(double dt, const Scan& scan) { run(dt, std::span<const Scan>(&scan, 1)); }
  void run(double dt, std::span<const Scan> scans, std::size_t threads = 1) {
    static_assert(sizeof(Scan) == sizeof(ScanOfTracks<Number>));
    const ScanOfTracks<Number>* const first = scans.data();
    Tracks::run(dt, {first, scans.size()}, threads);
  }

  /// The output of a track. Throws std::invalid_argument if there is none of that number.
  Estimate estimate(std::size_t track) const {
    const auto state = this->state(track);
    Estimate result;
    this->filter().output(state, detail::sized_view(result, this->filter().component_count()));
    return result;
  }
};

template <class Models, ScalableUncertainty Kind, class... Rules>
FilterBank(Models, Relation<Kind, Kind>, Rules...) -> FilterBank<Models, Kind>;
template <class Models, class Transition, class... Rules>
FilterBank(Models, Transition, Rules...) -> FilterBank<Models, typename Transition::kind>;

}  // namespace sigmax
