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
  const auto [missed, detected] = rules.detection_possibilities.value_or(std::array{0.0, 1.0});
  constexpr double greatest = std::numeric_limits<double>::max();
  for (const auto& [name, value, most] : {std::tuple{"detection_probability", rules.detection_probability, 1.0},
                                          {"survival_per_s", rules.survival_per_s, 1.0},
                                          {"birth_existence", rules.birth_existence, 1.0},
                                          {"confirmation", rules.confirmation, 1.0},
                                          {"explained", rules.explained, 1.0},
                                          {"greatest_speed", rules.greatest_speed, greatest},
                                          {"clutter_density", rules.clutter_density.value_or(1.0), greatest}})
    if (!(value > 0.0 && value <= most))
      throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + "; expected a positive number" +
                                  (most == 1.0 ? ", at most 1" : ""));
  if (!(rules.deletion >= 0.0 && rules.deletion < rules.birth_existence))
    throw std::invalid_argument("deletion is " + std::to_string(rules.deletion) +
                                "; expected 0 or more, and less than birth_existence");
  if (!(std::max(missed, detected) == 1.0 && std::min(missed, detected) >= 0.0))
    throw std::invalid_argument("the greatest possibility of detection is not 1, or one is negative");
  return rules;
}

}  // namespace

namespace detail {

Tracking::Tracking(const TargetChoice& a_choice, const MultiTargetRules& some)
    : choice(a_choice), rules(checked(some)), gate(Gate::probability(some.gate_probability)) {
  if (choice.likelihood == LikelihoodForm::possibility && !(rules.clutter_density.value_or(1.0) < 1.0))
    throw std::invalid_argument(
        "with likelihoods as possibilities the clutter density is the possibility that a detection is false: give one "
        "below 1");
}

void Tracking::scan(std::span<const AnyDetection> given) {
  // The order in which detections were given has no meaning, so it has no effect: not even on rounding.
  std::vector<std::pair<const AnyDetection*, std::size_t>> order;
  double latest = time;
  for (const AnyDetection& each : given) {
    if (!std::isfinite(each.time) || !std::ranges::all_of(each.z, [](double z) { return std::isfinite(z); }))
      throw std::invalid_argument("a detection of " + std::to_string(each.time) + " s is not finite");
    latest = std::max(latest, each.time);
    if (each.sensor != AnyDetection::Sensor::none) order.emplace_back(&each, order.size());
  }
  std::ranges::sort(order, {}, [](const auto& place) {
    const AnyDetection& each = *place.first;
    return std::tie(each.time, each.sensor, each.size, each.z, each.origin, each.tag);
  });
  spots.clear();
  spots.reserve(order.size());
  for (const auto& [each, place] : order) {
    spots.push_back({chosen_detection(*each, choice.axes), place, {each->tag, {}}});
    if (!check::finite(spots.back().detection.measurement()))
      throw std::invalid_argument("a detection of " + std::to_string(each->time) + " s has no covariance");
  }
  boxes.clear();
  longest = greatest_limit = 0.0;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    Spot& spot = spots[i];
    const AnyDetection& each = *order[i].first;
    spot.clutter = &clutter[{each.sensor, each.size}];
    spot.clutter->add(each);
    const double limit = std::min(gate.limit(each.size), 1e300);  // finite, so that no variance has no reach
    greatest_limit = std::max(greatest_limit, limit);
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), half = at;
    spot.position = spot.detection.position<Eigen::Dynamic>();
    if (spot.position && spot.position->size() == choice.axes) {
      at.head(choice.axes) = spot.position->mean;
      half.head(choice.axes) = (limit * spot.position->covariance.diagonal().cwiseMax(0.0)).cwiseSqrt();
    } else {
      spot.position.reset();
      half.fill(std::numeric_limits<double>::infinity());
    }
    boxes.emplace_back(Box(at - half, at + half), i);
    longest = std::max(longest, 2.0 * half.x());
  }
  std::ranges::sort(boxes, {}, [](const auto& each) { return each.first.min().x(); });
  for (auto& [type, each] : clutter)
    each.log_weight = rules.clutter_density                              ? std::log(*rules.clutter_density)
                      : choice.likelihood == LikelihoodForm::possibility ? 0.0
                                                                         : std::log(each.density());
  const double elapsed = scans == 0 ? 0.0 : latest - time;
  time = latest;
  ++scans;
  detections += spots.size();
  take_scan(elapsed);
  for (auto& [type, each] : clutter)
    if (each.seen || spots.empty()) each.end_scan();  // one without detections is a scan of all types
  owners.assign(spots.size(), {});
  for (const Spot& spot : spots) owners[spot.given] = spot.owner;
  spots.clear();
}

void Tracking::overlapping(const Box& box, std::vector<std::size_t>& found) const {
  found.clear();
  auto at = std::ranges::lower_bound(boxes, box.min().x() - longest, {},
                                     [](const auto& each) { return each.first.min().x(); });
  for (; at != boxes.end() && at->first.min().x() <= box.max().x(); ++at)
    if (at->first.intersects(box)) found.push_back(at->second);
  std::ranges::sort(found);
}

std::optional<std::string> Tracking::finding() const {
  if (scans < 10 || detections == 0) return std::nullopt;
  char text[240];
  const auto print = [&](const char* format, auto... numbers) {
    std::snprintf(text, sizeof(text), format, numbers...);
    return std::string(text);
  };
  if (rules.clutter_density && choice.likelihood == LikelihoodForm::density)
    for (const auto& [type, each] : clutter) {
      const double expected = *rules.clutter_density * each.box.volume(), all = expected * each.scans;
      if (all > 5.0 * each.unexplained + 20.0 || each.unexplained > 5.0 * all + 20.0)
        return print(
            "a clutter density of %.3g means %.3g false detections a scan, but %.3g stay unexplained; set "
            "a clutter density of %.2g, or none, so that it is estimated",
            *rules.clutter_density, expected, each.unexplained / each.scans, each.density());
    }
  if (looks >= 50.0 && detected < (rules.detection_probability - 0.2) * looks)
    return print(
        "confirmed targets were detected in %.0f %% of %.0f scans, but P_D is %.3g; set a detection probability of "
        "%.2g",
        100.0 * detected / looks, looks, rules.detection_probability, detected / looks);
  if (looks > 0.0) return std::nullopt;
  return print(
      "no track was confirmed in %zu scans of %.3g detections on average; set the greatest speed, now %.3g m/s, near "
      "the targets', and check the sensor's standard deviations",
      scans, static_cast<double>(detections) / static_cast<double>(scans), rules.greatest_speed);
}

}  // namespace detail

MultiTargetTracker::MultiTargetTracker(const TargetChoice& choice, const AssociationChoice& association,
                                       const MultiTargetRules& rules)
    : tracking_(detail::chosen_tracking(choice, association, rules)) {}

void MultiTargetTracker::scan(std::span<const AnyDetection> detections) { tracking_().scan(detections); }
const std::vector<std::string>& MultiTargetTracker::components() const { return tracking_().components(); }
std::vector<TrackedTarget> MultiTargetTracker::tracks(std::optional<double> time) const {
  return tracking_().tracks(time);
}
const std::vector<DetectionOwner>& MultiTargetTracker::owners() const { return tracking_().owners; }
std::size_t MultiTargetTracker::scans() const { return tracking_().scans; }
double MultiTargetTracker::time() const { return tracking_().time; }
bool MultiTargetTracker::exact() const { return tracking_().exact; }
std::optional<std::string> MultiTargetTracker::finding() const { return tracking_().finding(); }

}  // namespace sigmax
