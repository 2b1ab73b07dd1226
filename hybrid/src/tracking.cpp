#include "tracking.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <sigmax/core/matching.hpp>
#include <sigmax/hybrid/existence.hpp>

#include "multiple_model_filter.hpp"

namespace sigmax::detail {
namespace {

/// The tracker of a kind of mode and a kind of pattern. One filter serves all tracks: a hypothesis is a step from the
/// state of a track.
template <ScalableUncertainty Kind, ScalableUncertainty Pattern>
class Tracks final : public Tracking {
  using A = AlgebraOf<Pattern>;
  using State = HybridEstimate<Kind>;

 public:
  Tracks(const TargetChoice& a_choice, const AssociationChoice& kinds, const MultiTargetRules& some)
      : Tracking(a_choice, some),
        filter_(chosen_filter<Kind>(choice)),
        match_(kinds.fuzzy_permutation ? &sigmax::match<Pattern, Fuzzy> : &sigmax::match<Pattern, Random>),
        weights_(DetectionWeights::of<Pattern>(rules.detection_probability, rules.gate_probability)),
        mixed_(filter_().state()) {
    if (A::selective && rules.detection_possibilities)
      weights_ = {std::log((*rules.detection_possibilities)[0]), std::log((*rules.detection_possibilities)[1])};
  }

  const std::vector<std::string>& components() const override { return filter_().components(); }

  std::vector<TrackedTarget> tracks(std::optional<double> at) const override {
    const auto own = filter_;  // a copy, with a state of its own
    MultipleModelFilter<Kind>& filter = own();
    std::vector<TrackedTarget> result;
    for (const Track& track : tracks_) {
      const double presence = track.existence.presence();
      TargetPoint point;
      point.time = at ? std::max(*at, track.time) : track.time;
      point.tag = track.tag;
      point.is_start = track.detected == 1;
      filter.restore(track.state);
      if (point.time > track.time) filter.step(point.time - track.time);
      tell(filter, filter.state(), choice.most_likely_output, point);
      result.push_back({track.number, std::move(point), presence, track.existence.necessity(),
                        track.confirmed && presence >= 0.5, track.first_time, track.detected});
    }
    return result;
  }

 private:
  struct Track {
    std::size_t number;
    State state;
    double time;  ///< of the state
    Existence<Pattern> existence;
    double first_time;
    std::size_t tag;
    bool confirmed = false;
    std::size_t scans = 0;  ///< after the first
    std::size_t detected = 1;
    std::size_t misses = 0;  ///< scans in a row without a detection
    std::size_t shared = 0;  ///< scans in a row with a detection that an older track has, too
  };

  /// What a track is if a detection is its own, or none; given that the target exists.
  struct Hypothesis {
    State* state;
    double time, log_weight;
    bool seen = true;
  };

  void take_scan(double elapsed) override {
    const auto survival = Existence<Pattern>::survival(std::pow(rules.survival_per_s, elapsed));
    problem_.clear();
    missed_.resize(std::max(missed_.size(), tracks_.size()), mixed_);
    for (std::size_t row = 0; row < tracks_.size(); ++row) {
      tracks_[row].existence.predict(survival);
      add_row(tracks_[row], missed_[row]);
    }
    const Matching matching = match_(problem_, {});
    exact = exact && matching.exact;
    for (std::size_t row = 0; row < tracks_.size(); ++row) update(row, matching);
    for (Spot& spot : spots) {
      spot.clutter->unexplained += std::max(1.0 - spot.explained_by_confirmed, 0.0);
      if (spot.explained >= rules.explained) continue;
      spot.owner = {spot.owner.tag, {}};
      if (spot.position) begin(spot);
    }
    std::erase_if(tracks_, [&](const Track& track) {
      const double presence = track.existence.presence();
      return presence <= rules.deletion || track.shared >= rules.duplicate_scans ||
             (!track.confirmed && track.scans >= rules.tentative_scans && presence < 0.5);
    });
  }

  /// The hypotheses of a track, and their weights in the matching.
  void add_row(const Track& track, State& missed) {
    // P_D = 1 of a target that certainly exists leaves no event without a detection, but data may.
    problem_.add_row(std::max(track.existence.log_none(weights_), -1e3));
    if (spots.empty() || !step(track, time)) return;
    const MultipleModelFilter<Kind>& filter = filter_();
    missed = filter.state();
    overlapping(expected(time - std::max(spots.front().detection.time, track.time)), found_);
    const double log_detected = track.existence.log_presence() + weights_.log_detected;
    for (const std::size_t i : found_) {
      const Spot& spot = spots[i];
      if (spot.detection.time < track.time || !step(track, spot.detection.time, &spot)) continue;
      const double log_weight = log_detected + filter.log_evidence() - spot.clutter->log_weight;
      if (!std::isfinite(log_weight)) continue;
      if (states_.size() == problem_.size()) states_.push_back(mixed_);
      states_[problem_.size()] = filter.state();
      problem_.add(i, log_weight);
    }
  }

  /// A step of the filter from a track to a time that is not earlier; false where its numbers or the gate forbid it.
  bool step(const Track& track, double to, const Spot* spot = nullptr) {
    MultipleModelFilter<Kind>& filter = filter_();
    filter.restore(track.state);
    try {
      const Seen seen = spot ? Seen{spot->detection.measurement(), sensor_of_models(spot->detection.sensor())} : Seen{};
      filter.step(to - track.time, spot ? &seen : nullptr, gate);
      return !spot || filter.accepted();
    } catch (const std::domain_error&) {
      return false;
    }
  }

  /// Where a detection may be that passes the gate, from `duration` before the filter's time on. It passes if −2 log ⊕
  /// w exp(−d²/2) does, and one of so many modes has as much but for their number.
  Box expected(double duration) const {
    const MultipleModelFilter<Kind>& filter = filter_();
    const auto modes = static_cast<double>(filter.modes());
    const Eigen::Index axes = choice.axes;
    Box box;
    for (std::size_t j = 0; j < filter.modes(); ++j) {
      const double limit = greatest_limit + 2.0 * (filter.belief().log(j) + std::log(modes));
      if (!(limit > 0.0)) continue;
      const auto own = filter.estimates()[j];
      Eigen::Vector3d at = Eigen::Vector3d::Zero(), half = at;
      at.head(axes) = own.mean.head(axes);
      half.head(axes) = (limit * own.covariance.diagonal().head(axes).cwiseMax(0.0)).cwiseSqrt();
      Eigen::Vector3d ago = at;
      if (own.size() >= 2 * axes) ago.head(axes) -= duration * own.mean.segment(axes, axes);
      if (own.size() >= 3 * axes) ago.head(axes) += 0.5 * duration * duration * own.mean.segment(2 * axes, axes);
      box.extend(at.cwiseMin(ago) - half).extend(at.cwiseMax(ago) + half);
    }
    return box;
  }

  /// A track after the scan, by the marginals of its row.
  void update(std::size_t row, const Matching& matching) {
    Track& track = tracks_[row];
    ++track.scans;
    const double log_none = matching.marginals.none(row);
    const auto entries = matching.marginals.entries(row);
    const double log_missed = track.existence.log_missed(weights_, log_none);
    const double log_any = log_total<Pattern>(entries.size(), [&](std::size_t k) { return entries.value(k); });
    if (std::max(log_any, log_missed) == log_zero) {
      track.existence = Existence<Pattern>(0.0);
      return;
    }
    track.existence.update(weights_, log_none, log_any);
    track.confirmed = track.confirmed || track.existence.necessity() >= rules.confirmation;
    hypotheses_.clear();
    for (std::size_t k = 0; k < entries.size(); ++k) {
      Spot& spot = spots[entries.index(k)];
      hypotheses_.push_back({&states_[problem_.offset(row) + k], spot.detection.time, entries.value(k)});
      const double support = std::exp(entries.value(k));
      spot.explained = A::plus(spot.explained, support);
      if (track.confirmed) spot.explained_by_confirmed = A::plus(spot.explained_by_confirmed, support);
      if (!spot.owner.track || support > spot.owner.support) spot.owner = {spot.owner.tag, track.number, support};
    }
    hypotheses_.push_back({&missed_[row], time, log_missed, false});
    const std::size_t none = entries.size();
    std::size_t best = index_of_greatest(entries.values);
    const auto taken = [&]() -> Spot& { return spots[entries.index(best)]; };
    // Two targets that are close may share a detection, too, but hardly ever have only that one.
    const bool contended = best != none && taken().first_taker < row && std::exp(log_none) >= 0.25 &&
                           entries.value(best) >= log_missed - 1.0;
    track.shared = contended ? track.shared + 1 : 0;
    // Of a target that exists a detection may be the best choice where otherwise it is none.
    const std::size_t winner = AnyEntries(entries).place_of(matching.winners[row]);
    if (winner != none || (best != none && ties(log_missed, entries.value(best)))) best = winner;
    ++track.misses;
    if (best != none) {
      if (track.confirmed) {
        looks += static_cast<double>(track.misses);
        detected += 1.0;
      }
      track.misses = 0;
      ++track.detected;
      track.tag = taken().owner.tag;
      taken().first_taker = std::min(taken().first_taker, row);
    }
    if (A::selective) hypotheses_.assign(1, Hypothesis(hypotheses_[best]));
    mix(track);
  }

  /// The mixture of hypotheses by their weights, moment-matched mode by mode, at the time of the latest of their
  /// detections.
  void mix(Track& track) {
    double greatest = log_zero, latest = track.time;
    for (const Hypothesis& each : hypotheses_) greatest = std::max(greatest, each.log_weight);
    std::erase_if(hypotheses_, [&](const auto& each) { return each.log_weight < greatest - 30.0; });  // one in 10¹³
    for (const Hypothesis& each : hypotheses_)
      if (each.seen) latest = std::max(latest, each.time);
    const Hypothesis& winner = *std::ranges::max_element(hypotheses_, {}, &Hypothesis::log_weight);
    const std::size_t parts = hypotheses_.size();
    if (parts == 1) {
      if (winner.seen) {
        std::swap(track.state, *winner.state);
        track.time = winner.time;
      }
      return;
    }
    MultipleModelFilter<Kind>& filter = filter_();
    for (const Hypothesis& each : hypotheses_) {
      if (each.time == latest) continue;
      const bool later = each.time > latest;  // without a detection, from the state again
      filter.restore(later ? track.state : *each.state);
      filter.step(latest - (later ? track.time : each.time));
      *each.state = filter.state();
    }
    mixed_ = *winner.state;
    const std::size_t modes = filter.modes();
    Parts estimates(static_cast<int>(parts));
    OfModes weights(static_cast<int>(parts)), log_weights(static_cast<int>(modes));
    for (std::size_t j = 0; j < modes; ++j) {
      const auto joint = [&](std::size_t k) { return hypotheses_[k].log_weight + hypotheses_[k].state->belief.log(j); };
      const double total = log_total<Pattern>(parts, joint);
      log_weights[j] = total;
      for (std::size_t k = 0; k < parts; ++k) {
        estimates[k] = {std::as_const(hypotheses_[k].state->estimates).view(j)};
        weights[k] = total == log_zero ? (&hypotheses_[k] == &winner) : std::exp(joint(k) - total);
      }
      match_moments({estimates[0].estimate, {estimates.data(), parts}}, weights, weights, mixed_.estimates.view(j));
    }
    const auto log_weight = [&](std::size_t j) { return log_weights[j]; };
    mixed_.belief.assign(log_weight);
    mixed_.most_likely_mode =
        select(modes, log_weight, winner.state->most_likely_mode, filter.interaction().output_tie);
    std::swap(track.state, mixed_);
    track.time = latest;
  }

  /// A track from a detection that nothing explains: at its position, without a velocity.
  void begin(Spot& spot) {
    const int axes = choice.axes, n = 3 * axes;
    const double sigma_velocity = 0.5 * rules.greatest_speed, scale = choice.entry.root_mean_square();
    Gaussian<Eigen::Dynamic, 9> start{Vector<Eigen::Dynamic, 9>::Zero(n), SquareMatrix<Eigen::Dynamic, 9>::Zero(n, n)};
    start.mean.head(axes) = spot.position->mean;
    start.covariance.topLeftCorner(axes, axes) = spot.position->covariance;
    for (int i = axes; i < n; ++i)
      start.covariance(i, i) =
          i < 2 * axes ? sigma_velocity * sigma_velocity : choice.entry.variance(i % axes == 2 ? "az" : "ax", scale);
    filter_().restart(chosen_start(choice, view(start), view(start)));
    const double at = spot.detection.time;
    tracks_.push_back({++born_, filter_().state(), at, Existence<Pattern>(rules.birth_existence), at, spot.owner.tag});
    spot.owner = {spot.owner.tag, born_, 0.0, true};
  }

  std::function<MultipleModelFilter<Kind>&()> filter_;
  Matching (*match_)(const Choices&, const MatchingOptions&);
  DetectionWeights weights_;
  std::vector<Track> tracks_;  ///< in the order of their numbers
  std::size_t born_ = 0;
  State mixed_;
  // Of the scan in hand:
  Choices problem_;
  std::vector<State> states_, missed_;  ///< if an entry of the problem is taken, or none of a row; keep their memory
  std::vector<std::size_t> found_;
  std::vector<Hypothesis> hypotheses_;  ///< of one track
};

}  // namespace

std::function<Tracking&()> chosen_tracking(const TargetChoice& choice, const AssociationChoice& kinds,
                                           const MultiTargetRules& rules) {
  if (choice.scheme == Scheme::histories && !kinds.fuzzy_pattern)
    throw std::invalid_argument(
        "histories of the mode want a fuzzy pattern, as GNN has: a mixture of them has no moments");
  if (choice.fuzzy && kinds.fuzzy_pattern) return held<Tracking>(Tracks<Fuzzy, Fuzzy>(choice, kinds, rules));
  if (choice.fuzzy) return held<Tracking>(Tracks<Fuzzy, Random>(choice, kinds, rules));
  if (kinds.fuzzy_pattern) return held<Tracking>(Tracks<Random, Fuzzy>(choice, kinds, rules));
  return held<Tracking>(Tracks<Random, Random>(choice, kinds, rules));
}

}  // namespace sigmax::detail
