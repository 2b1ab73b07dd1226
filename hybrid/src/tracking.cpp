#include "tracking.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <sigmax/core/matching.hpp>
#include <sigmax/hybrid/existence.hpp>

#include "multiple_model_filter.hpp"

namespace sigmax::detail {
namespace {

template <ScalableUncertainty Pattern>
DetectionWeights weights_of(const MultiTargetRules& rules) {
  if (AlgebraOf<Pattern>::selective && rules.detection_possibilities) {
    const auto [missed, detected] = *rules.detection_possibilities;
    return {std::log(missed), std::log(detected)};
  }
  return DetectionWeights::of<Pattern>(rules.detection_probability, rules.gate_probability);
}

/// The tracker of a kind of mode and a kind of pattern. One filter serves all tracks: a hypothesis is a step from the
/// state of a track.
template <ScalableUncertainty Kind, ScalableUncertainty Pattern>
class Tracks final : public Tracking {
  using A = AlgebraOf<Pattern>;
  using State = HybridEstimate<Kind>;

 public:
  Tracks(const TargetChoice& choice, const AssociationChoice& kinds, const MultiTargetRules& rules)
      : Tracking(choice, rules),
        nowhere_(anywhere(models_)),
        filter_(chosen_filter<Kind>(choice, models_, nowhere_)),
        match_(kinds.fuzzy_permutation ? &sigmax::match<Pattern, Fuzzy> : &sigmax::match<Pattern, Random>),
        weights_(weights_of<Pattern>(rules)),
        mixed_(filter_->state()) {}
  std::unique_ptr<Tracking> clone() const override { return std::make_unique<Tracks>(*this); }
  const std::vector<std::string>& components() const override { return filter_->components(); }

  std::vector<TrackedTarget> tracks(std::optional<double> time) const override {
    const OwnFilter filter = filter_;
    std::vector<TrackedTarget> result;
    for (const Track& track : tracks_) {
      const double presence = track.existence.presence();
      TargetPoint point;
      point.time = time ? std::max(*time, track.time) : track.time;
      point.tag = track.tag;
      point.is_start = track.detected == 1;
      filter->restore(track.state);
      if (point.time > track.time) filter->step(point.time - track.time);
      tell(*filter, filter->state(), choice_.most_likely_output, point);
      result.push_back({track.number, std::move(point), presence, track.existence.necessity(),
                        track.confirmed && presence >= 0.5, track.first_time, track.detected});
    }
    return result;
  }

 private:
  static constexpr std::size_t none = no_column;

  struct Track {
    std::size_t number;
    State state;
    double time;  ///< of the state
    Existence<Pattern> existence;
    double first_time;
    std::size_t tag;
    bool confirmed = false, ended = false;
    std::size_t scans = 0;  ///< after the first
    std::size_t detected = 1;
    std::size_t missed = 0;  ///< scans in a row without a detection
    std::size_t shared = 0;  ///< scans in a row with a detection that an older track has, too
  };

  struct OwnFilter : std::unique_ptr<MultipleModelFilter<Kind>> {
    using Pointer = std::unique_ptr<MultipleModelFilter<Kind>>;
    OwnFilter(Pointer filter) : Pointer(std::move(filter)) {}
    OwnFilter(const OwnFilter& other) : Pointer(other->clone()) {}
  };

  /// What a track is if a detection of the scan is its own, or none.
  struct Hypothesis {
    std::size_t spot;
    State state;
    double time;
    double log_weight;  ///< after the matching, given that the target exists
  };

  void take_scan() override {
    const auto survival = Existence<Pattern>::survival(std::pow(rules_.survival_per_s, elapsed_));
    problem_.clear();
    rows_.clear();
    used_ = 0;
    for (Track& track : tracks_) {
      track.existence.predict(survival);
      add_row(track);
    }
    rows_.push_back(used_);
    if (!tracks_.empty()) {
      const Matching matching = match_(problem_, {});
      exact_ = exact_ && matching.exact;
      for (std::size_t row = 0; row < tracks_.size(); ++row) update(row, matching);
    }
    for (Spot& spot : spots_) {
      clutter_.add_unexplained(spot.type, std::max(1.0 - spot.explained_by_confirmed, 0.0));
      if (spot.explained >= rules_.explained) continue;
      spot.owner = {spot.owner.tag, {}};
      if (spot.placed) begin(spot);
    }
    std::erase_if(tracks_, [&](const Track& track) {
      const double presence = track.existence.presence();
      return track.ended || presence < rules_.deletion || track.shared >= rules_.duplicate_scans ||
             (!track.confirmed && track.scans >= rules_.tentative_scans && presence < 0.5);
    });
  }

  /// The hypotheses of a track, and their weights in the matching.
  void add_row(const Track& track) {
    rows_.push_back(used_);
    // P_D = 1 of a target that certainly exists leaves no event without a detection, but data may.
    problem_.add_row(std::max(track.existence.log_none(weights_), -1e3));
    Box hull;
    const double first = spots_.empty() ? time_ : std::max(spots_.front().detection.time, track.time);
    if (!step(track, time_) || !expected(hull, time_ - first)) return;
    keep(none, time_);
    boxes_.overlapping(hull, found_);
    const double log_detected = track.existence.log_presence() + weights_.log_detected;
    for (const std::size_t i : found_) {
      const Spot& spot = spots_[i];
      if (spot.detection.time < track.time || !step(track, spot.detection.time, &spot)) continue;
      if (!(filter_->gate_distance() <= spot.limit)) continue;
      const double log_weight = log_detected + filter_->log_evidence() - spot.log_clutter;
      if (!std::isfinite(log_weight)) continue;
      problem_.add(i, log_weight);
      keep(i, spot.detection.time);
    }
  }

  /// A step of the filter from a track to a time that is not earlier, or false where its numbers do not allow it.
  bool step(const Track& track, double time, const Spot* spot = nullptr) {
    const Seen seen = spot ? spot->seen() : Seen{};
    filter_->restore(track.state);
    try {
      filter_->step(time - track.time, spot ? &seen : nullptr);
    } catch (const std::domain_error&) {
      return false;
    }
    return true;
  }

  void keep(std::size_t spot, double time) {
    if (used_ == hypotheses_.size()) hypotheses_.push_back({spot, filter_->state(), time, log_zero});
    Hypothesis& hypothesis = hypotheses_[used_++];
    hypothesis.spot = spot;
    hypothesis.state = filter_->state();
    hypothesis.time = time;
  }

  /// Where a detection may be that passes the gate, from `duration` before the filter's time on; false if nowhere. It
  /// passes if −2 log ⊕ w exp(−d²/2) does, and one of so many modes has as much but for their number.
  bool expected(Box& hull, double duration) const {
    std::array<double, 3> least{}, greatest{};
    bool any = false;
    for (std::size_t j = 0; j < filter_->modes(); ++j) {
      const double limit =
          greatest_limit_ + 2.0 * (filter_->belief().log(j) + std::log(static_cast<double>(filter_->modes())));
      if (!(limit > 0.0)) continue;
      const ConstView estimate = std::as_const(filter_->estimates()).view(j);
      for (int axis = 0; axis < choice_.axes; ++axis) {
        const auto derivative = [&](int order) {
          const int place = axis + order * choice_.axes;
          return estimate.n >= (order + 1) * choice_.axes ? estimate.mean[place] : 0.0;
        };
        const double at = derivative(0), ago = at - duration * (derivative(1) - 0.5 * duration * derivative(2));
        const double half = std::sqrt(limit * std::max(estimate.covariance[axis + axis * estimate.n], 0.0));
        double &low = least[static_cast<std::size_t>(axis)], &high = greatest[static_cast<std::size_t>(axis)];
        low = std::min(any ? low : at, std::min(at, ago) - half);
        high = std::max(any ? high : at, std::max(at, ago) + half);
      }
      any = true;
    }
    for (std::size_t axis = 0; axis < least.size(); ++axis) {
      hull.half[axis] = 0.5 * (greatest[axis] - least[axis]);
      hull.at[axis] = std::isfinite(hull.half[axis]) ? least[axis] + hull.half[axis] : 0.0;
    }
    return any;
  }

  /// A track after the scan, by the marginals of its row.
  void update(std::size_t row, const Matching& matching) {
    Track& track = tracks_[row];
    ++track.scans;
    const std::span of_row(hypotheses_.data() + rows_[row], rows_[row + 1] - rows_[row]);
    const double log_none = matching.marginals.none(row);
    const auto entries = matching.marginals.entries(row);
    const double log_missed = track.existence.log_missed(weights_, log_none);
    const double log_any = log_total<Pattern>(entries.size(), [&](std::size_t k) { return entries.value(k); });
    if (std::max(log_any, log_missed) == log_zero) {
      track.ended = true;
      return;
    }
    track.existence.update(weights_, log_none, log_any);
    if (track.existence.necessity() >= rules_.confirmation) track.confirmed = confirmed_any_ = true;
    Hypothesis* best = nullptr;
    for (std::size_t k = 0; k < of_row.size(); ++k) {
      Hypothesis& hypothesis = of_row[k];
      hypothesis.log_weight = hypothesis.spot == none ? log_missed : entries.value(k - 1);
      if (hypothesis.spot == none) continue;
      if (!best || hypothesis.log_weight > best->log_weight) best = &hypothesis;
      explain(hypothesis, track);
    }
    // Two targets that are close may share a detection, too, but hardly ever have only that one.
    const bool contended = best && spots_[best->spot].first_taker < row && std::exp(log_none) >= 0.25 &&
                           best->log_weight >= log_missed - 1.0;
    track.shared = contended ? track.shared + 1 : 0;
    // Of a target that exists a detection may be the best choice where otherwise it is none.
    if (const std::size_t winner = matching.winners[row]; winner != none)
      best = &*std::ranges::find(of_row, winner, &Hypothesis::spot);
    else if (best && ties(log_missed, best->log_weight))
      best = nullptr;
    if (best) {
      if (track.confirmed) {
        looks_ += static_cast<double>(track.missed + 1);
        detected_ += 1.0;
      }
      ++track.detected;
      Spot& spot = spots_[best->spot];
      track.tag = spot.owner.tag;
      spot.first_taker = std::min(spot.first_taker, row);
    }
    track.missed = best ? 0 : track.missed + 1;
    if constexpr (A::selective) {
      if (best) adopt(track, *best);
    } else {
      mix(track, of_row);
    }
  }

  void explain(const Hypothesis& hypothesis, const Track& track) {
    Spot& spot = spots_[hypothesis.spot];
    const double support = std::exp(hypothesis.log_weight);
    spot.explained = A::plus(spot.explained, support);
    if (track.confirmed) spot.explained_by_confirmed = A::plus(spot.explained_by_confirmed, support);
    if (!spot.owner.track || support > spot.owner.support) spot.owner = {spot.owner.tag, track.number, support, false};
  }

  void adopt(Track& track, Hypothesis& hypothesis) {
    std::swap(track.state, hypothesis.state);
    track.time = hypothesis.time;
  }

  /// The mixture of hypotheses by their weights, moment-matched mode by mode, at the time of the latest of their
  /// detections.
  void mix(Track& track, std::span<Hypothesis> of_row) {
    parts_.clear();
    double greatest = log_zero, latest = track.time;
    for (const Hypothesis& hypothesis : of_row) greatest = std::max(greatest, hypothesis.log_weight);
    for (Hypothesis& hypothesis : of_row) {
      if (hypothesis.log_weight < greatest - 30.0) continue;  // one in 10¹³
      parts_.push_back(&hypothesis);
      if (hypothesis.spot != none) latest = std::max(latest, hypothesis.time);
    }
    if (parts_.size() < 2) {
      if (!parts_.empty() && parts_[0]->spot != none) adopt(track, *parts_[0]);
      return;
    }
    for (Hypothesis* part : parts_) {
      if (part->time == latest) continue;
      const bool is_none = part->spot == none;
      filter_->restore(is_none ? track.state : part->state);
      if (const double dt = latest - (is_none ? track.time : part->time); dt > 0.0) filter_->step(dt);
      part->state = filter_->state();
    }
    const auto winner = *std::ranges::max_element(parts_, {}, [](const Hypothesis* part) { return part->log_weight; });
    mixed_ = winner->state;
    const std::size_t modes = filter_->modes();
    Parts estimates(static_cast<int>(parts_.size()));
    OfModes weights(static_cast<int>(parts_.size())), log_weights(static_cast<int>(modes));
    for (std::size_t j = 0; j < modes; ++j) {
      const auto joint = [&](std::size_t k) { return parts_[k]->log_weight + parts_[k]->state.belief.log(j); };
      const double total = log_total<Pattern>(parts_.size(), joint);
      log_weights[j] = total;
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        estimates[k] = {std::as_const(parts_[k]->state.estimates).view(j)};
        weights[k] = total == log_zero ? (parts_[k] == winner) : std::exp(joint(k) - total);
      }
      match_moments({estimates[0].estimate, {estimates.data(), parts_.size()}}, weights, weights,
                    mixed_.estimates.view(j));
    }
    const auto log_weight = [&](std::size_t j) { return log_weights[j]; };
    mixed_.belief.assign(log_weight);
    mixed_.most_likely_mode =
        select(modes, log_weight, winner->state.most_likely_mode, filter_->interaction().output_tie);
    std::swap(track.state, mixed_);
    track.time = latest;
  }

  /// A track from a detection that nothing explains: at its position, without a velocity.
  void begin(Spot& spot) {
    const auto position = *spot.detection.position<Eigen::Dynamic>();
    const int axes = choice_.axes;
    const double sigma_velocity = 0.5 * rules_.greatest_speed, scale = choice_.entry.root_mean_square();
    filter_->restart(estimates_from(choice_, nowhere_, [&](int n, EstimateAt<double>& own) {
      own.mean.head(axes) = position.mean;
      own.covariance.topLeftCorner(axes, axes) = position.covariance;
      for (int i = axes; i < n; ++i)
        own.covariance(i, i) =
            i < 2 * axes ? sigma_velocity * sigma_velocity : choice_.entry.variance(i % axes == 2 ? "az" : "ax", scale);
    }));
    const double time = spot.detection.time;
    tracks_.push_back(
        {++born_, filter_->state(), time, Existence<Pattern>(rules_.birth_existence), time, spot.owner.tag});
    spot.owner = {spot.owner.tag, born_, 0.0, true};
    if (tracks_.back().existence.necessity() >= rules_.confirmation) tracks_.back().confirmed = confirmed_any_ = true;
  }

  Estimates nowhere_;
  OwnFilter filter_;
  Matching (*match_)(const Choices&, const MatchingOptions&);
  DetectionWeights weights_;
  std::vector<Track> tracks_;  ///< in the order of their numbers
  std::size_t born_ = 0;
  State mixed_;
  // Of the scan in hand:
  Choices problem_;
  std::vector<Hypothesis> hypotheses_;  ///< keeps its memory; the first `used_` count
  std::size_t used_ = 0;
  std::vector<std::size_t> rows_;  ///< where the hypotheses of each track begin
  std::vector<std::size_t> found_;
  std::vector<Hypothesis*> parts_;
};

template <ScalableUncertainty Kind>
std::unique_ptr<Tracking> tracking_of(const TargetChoice& choice, const AssociationChoice& kinds,
                                      const MultiTargetRules& rules) {
  if (kinds.fuzzy_pattern) return std::make_unique<Tracks<Kind, Fuzzy>>(choice, kinds, rules);
  return std::make_unique<Tracks<Kind, Random>>(choice, kinds, rules);
}

}  // namespace

std::unique_ptr<Tracking> chosen_tracking(const TargetChoice& choice, const AssociationChoice& kinds,
                                          const MultiTargetRules& rules) {
  if (choice.scheme == Scheme::histories && !kinds.fuzzy_pattern)
    throw std::invalid_argument("histories of the mode want a fuzzy pattern: a mixture of them has no moments");
  if (choice.fuzzy) return tracking_of<Fuzzy>(choice, kinds, rules);
  return tracking_of<Random>(choice, kinds, rules);
}

}  // namespace sigmax::detail
