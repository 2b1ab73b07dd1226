#include <sigmax/hybrid/multi_target_tracker.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <tuple>

#include <sigmax/hybrid/sound.hpp>

#include "tracking.hpp"

namespace sigmax {
namespace {

const MultiTargetRules& checked(const MultiTargetRules& rules) {
  const auto require = [](bool right, const char* name, double value, const char* expected) {
    if (!right)
      throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + "; expected " + expected);
  };
  for (const auto& [name, value] : {std::pair{"detection_probability", rules.detection_probability},
                                    {"survival_per_s", rules.survival_per_s},
                                    {"birth_existence", rules.birth_existence},
                                    {"confirmation", rules.confirmation},
                                    {"explained", rules.explained}})
    require(value > 0.0 && value <= 1.0, name, value, "more than 0, at most 1");
  for (const auto& [name, value] :
       {std::pair{"greatest_speed", rules.greatest_speed}, {"clutter_density", rules.clutter_density.value_or(1.0)}})
    require(value > 0.0 && std::isfinite(value), name, value, "a positive number");
  require(rules.deletion >= 0.0 && rules.deletion < rules.birth_existence, "deletion", rules.deletion,
          "0 or more, and less than birth_existence");
  const auto [missed, detected] = rules.detection_possibilities.value_or(std::array{1.0, 1.0});
  require(std::max(missed, detected) == 1.0 && std::min(missed, detected) >= 0.0,
          "the greatest possibility of detection", std::max(missed, detected), "1, and none negative");
  return rules;
}

}  // namespace

namespace detail {

Tracking::Tracking(const TargetChoice& choice, const MultiTargetRules& rules)
    : choice_(checked(choice)),
      rules_(sigmax::checked(rules)),
      models_(chosen_models(choice)),
      gate_(Gate::probability(rules.gate_probability)) {}

void Tracking::scan(std::span<const AnyDetection> detections) {
  // The order in which detections were given has no meaning, so it has no effect: not even on rounding.
  std::vector<std::size_t> order;
  double latest = time_;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (!std::isfinite(detections[i].time)) throw std::invalid_argument("a detection of a time that is not finite");
    latest = std::max(latest, detections[i].time);
    if (detections[i].sensor != AnyDetection::Sensor::none) order.push_back(i);
  }
  std::ranges::sort(order, {}, [&](std::size_t i) {
    const AnyDetection& each = detections[i];
    return std::tie(each.time, each.sensor, each.size, each.z, each.origin, each.tag);
  });
  read_.clear();
  for (const std::size_t i : order) {
    read_.push_back({chosen_detection(detections[i], choice_.axes), i, {detections[i].tag, {}}});
    if (!check::finite(read_.back().detection.measurement()))
      throw std::invalid_argument("a detection of " + std::to_string(detections[i].time) + " s is not finite");
  }
  std::swap(spots_, read_);
  std::vector<Box> boxes;
  greatest_limit_ = 0.0;
  for (Spot& spot : spots_) {
    spot.type = clutter_.add(detections[spot.given]);
    spot.limit = gate_.limit(spot.detection.measurement().n);
    greatest_limit_ = std::max(greatest_limit_, spot.limit);
    Box& box = boxes.emplace_back();
    const auto position = spot.detection.position<Eigen::Dynamic>();
    spot.placed = position && position->size() == choice_.axes;
    if (!spot.placed) box.half.fill(std::numeric_limits<double>::infinity());
    for (std::size_t axis = 0; spot.placed && axis < static_cast<std::size_t>(choice_.axes); ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      box.at[axis] = position->mean(i);
      box.half[axis] = std::sqrt(spot.limit * std::max(position->covariance(i, i), 0.0));
    }
  }
  boxes_.assign(std::move(boxes));
  for (Spot& spot : spots_)
    spot.log_clutter = rules_.clutter_density ? std::log(*rules_.clutter_density)
                       : choice_.likelihood == LikelihoodForm::possibility
                           ? 0.0
                           : std::log(clutter_.types()[spot.type].density());
  elapsed_ = scans_ == 0 ? 0.0 : latest - time_;
  time_ = latest;
  ++scans_;
  detections_ += spots_.size();
  take_scan();
  clutter_.end_scan();
  std::vector<std::optional<DetectionOwner>> given(detections.size());
  for (const Spot& spot : spots_) given[spot.given] = spot.owner;
  owners_.clear();
  for (const auto& owner : given)
    if (owner) owners_.push_back(*owner);
}

std::optional<std::string> Tracking::finding() const {
  if (scans_ < 10 || detections_ == 0) return std::nullopt;
  char text[240];
  const auto print = [&](const char* format, auto... numbers) {
    std::snprintf(text, sizeof(text), format, numbers...);
    return std::string(text);
  };
  if (rules_.clutter_density && choice_.likelihood == LikelihoodForm::density)
    for (const ClutterEstimate::Type& type : clutter_.types()) {
      const double expected = *rules_.clutter_density * type.volume(), all = expected * type.scans;
      if (all > 5.0 * type.unexplained + 20.0 || type.unexplained > 5.0 * all + 20.0)
        return print(
            "a clutter density of %.3g means %.3g false detections a scan, but %.3g stay unexplained; set "
            "clutter_density=%.2g, or leave it unset to estimate it",
            *rules_.clutter_density, expected, type.unexplained / type.scans, type.density());
    }
  if (looks_ >= 50.0 && detected_ < (rules_.detection_probability - 0.2) * looks_)
    return print(
        "confirmed targets were detected in %.0f %% of %.0f scans, but P_D is %.3g; set detection_probability=%.2g",
        100.0 * detected_ / looks_, looks_, rules_.detection_probability, detected_ / looks_);
  if (confirmed_any_) return std::nullopt;
  return print(
      "no track was confirmed in %zu scans of %.3g detections on average; set greatest_speed, now %.3g m/s, near that "
      "of the targets, and check the standard deviations of the sensor",
      scans_, static_cast<double>(detections_) / static_cast<double>(scans_), rules_.greatest_speed);
}

}  // namespace detail

MultiTargetTracker::MultiTargetTracker(const TargetChoice& choice, const AssociationChoice& association,
                                       const MultiTargetRules& rules)
    : tracking_(detail::chosen_tracking(choice, association, rules)) {}
MultiTargetTracker::MultiTargetTracker(const MultiTargetTracker& other) : tracking_(other.tracking_->clone()) {}
MultiTargetTracker::MultiTargetTracker(MultiTargetTracker&&) noexcept = default;
MultiTargetTracker& MultiTargetTracker::operator=(MultiTargetTracker other) noexcept {
  tracking_ = std::move(other.tracking_);
  return *this;
}
MultiTargetTracker::~MultiTargetTracker() = default;

void MultiTargetTracker::scan(std::span<const AnyDetection> detections) { tracking_->scan(detections); }
const std::vector<std::string>& MultiTargetTracker::components() const { return tracking_->components(); }
std::vector<TrackedTarget> MultiTargetTracker::tracks(std::optional<double> time) const {
  return tracking_->tracks(time);
}
const std::vector<DetectionOwner>& MultiTargetTracker::owners() const { return tracking_->owners(); }
std::size_t MultiTargetTracker::scans() const { return tracking_->scans(); }
double MultiTargetTracker::time() const { return tracking_->time(); }
bool MultiTargetTracker::exact() const { return tracking_->exact(); }
std::optional<std::string> MultiTargetTracker::finding() const { return tracking_->finding(); }

}  // namespace sigmax
