#include <sigmax/hybrid/any_target.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/track_manager.hpp>

#include "chosen.hpp"

namespace sigmax {
namespace {

using Start = std::optional<StartAt<Estimates>>;

/// From bearings seen from different places, as many as the models need, in the plane.
Start start_from_bearings(const TargetChoice& choice, std::span<const Detection> detections) {
  if (choice.axes != 2) return std::nullopt;
  std::vector<TimedBearing> bearings;
  for (const Detection& detection : detections)
    if (const auto* const sensor = detection.seen() ? detection.sensor().as<BearingSensor>() : nullptr)
      bearings.push_back({detection.time, sensor->origin(), radians(detection.measurement().mean[0]),
                          radians(std::sqrt(detection.measurement().covariance[0]))});
  const bool accelerates =
      std::ranges::any_of(choice.motions, [](const MotionChoice& motion) { return motion.known().derivatives == 3; });
  double wide_mean[6], wide_covariance[36], narrow_mean[4], narrow_covariance[16];
  const detail::View wide{wide_mean, wide_covariance, 6}, narrow{narrow_mean, narrow_covariance, 4};
  if (!detail::crossed_bearings_start(bearings, narrow)) return std::nullopt;
  if (accelerates && !detail::crossed_bearings_start(bearings, wide)) return std::nullopt;
  return StartAt<Estimates>{bearings.back().time, detail::chosen_start(choice, wide, narrow)};
}

/// From the last three positions at different times.
Start start_from_points(const TargetChoice& choice, std::span<const Detection> detections) {
  const int axes = choice.axes;
  std::vector<std::pair<double, Gaussian<Eigen::Dynamic, 3>>> points;
  for (const Detection& detection : detections) {
    const auto position = detection.position<Eigen::Dynamic>();
    if (!position || position->size() != axes) continue;
    if (!points.empty() && points.back().first == detection.time) points.pop_back();
    points.emplace_back(detection.time, *position);
  }
  if (points.size() < 3) return start_from_bearings(choice, detections);
  const auto view = [&](std::size_t back) {
    const auto& [time, position] = points[points.size() - back];
    return detail::TimedView{time, detail::view(position)};
  };
  const bool released = choice.start == StartRule::released;
  double wide_mean[9], wide_covariance[81], narrow_mean[6], narrow_covariance[36];
  const detail::View wide{wide_mean, wide_covariance, 3 * axes}, narrow{narrow_mean, narrow_covariance, 2 * axes};
  (released ? detail::released_start : detail::three_point_start)(view(3), view(2), view(1), wide);
  detail::two_point_start(view(2), view(1), narrow);
  return StartAt<Estimates>{points.back().first, detail::chosen_start(choice, wide, released ? wide : narrow)};
}

/// A given start without a time waits for the second detection: it is one step before the first.
Start given_start(const TargetChoice& choice, std::span<const Detection> detections) {
  if (!choice.start_time_s && detections.size() < 2) return std::nullopt;
  const double time = choice.start_time_s ? *choice.start_time_s : 2.0 * detections[0].time - detections[1].time;
  const int n = 3 * choice.axes;
  double mean[9], covariance[81] = {};
  for (int k = 0; k < n; ++k) {  // what is given always speaks of three axes
    const auto place = static_cast<std::size_t>(k / choice.axes * 3 + k % choice.axes);
    mean[k] = choice.start_mean[place];
    covariance[k + k * n] = choice.start_covariance_diagonal[place];
  }
  const detail::View all{mean, covariance, n};
  return StartAt<Estimates>{time, detail::chosen_start(choice, all, all), false};
}

auto start_rule(const TargetChoice& choice) {
  return [choice](std::span<const Detection> detections, std::size_t starts) {
    const bool given = choice.start == StartRule::given && starts == 0;
    return given ? given_start(choice, detections) : start_from_points(choice, detections);
  };
}

template <ScalableUncertainty Kind>
struct Followed {
  std::function<MultipleModelFilter<Kind>&()> filter;
  detail::TrackManager<Kind> life;

  explicit Followed(const TargetChoice& choice)
      : filter(detail::chosen_filter<Kind>(choice)), life(filter(), start_rule(choice), choice.rules) {}
};

using AnyFollowed = std::variant<Followed<Random>, Followed<Fuzzy>>;

}  // namespace

struct AnyTarget::Chosen {
  TargetChoice choice;
  AnyFollowed followed;
  bool compared = false;  ///< whether the last step had a measurement, taken or not

  /// act(filter and life).
  template <class Act>
  decltype(auto) visit(const Act& act) {
    return std::visit(act, followed);
  }

  const detail::Life& now() {
    return visit([](const auto& target) -> const auto& { return target.life.now(); });
  }
};

AnyTarget::AnyTarget(const TargetChoice& choice)
    : chosen_(detail::held<Chosen>(
          Chosen{choice, choice.fuzzy ? AnyFollowed(Followed<Fuzzy>(choice)) : Followed<Random>(choice)})) {}

Verdict AnyTarget::take(const AnyDetection& detection, const Stepped& stepped) {
  const Detection own = detail::chosen_detection(detection, chosen_().choice.axes);
  return chosen_().visit([&](auto& target) {
    return target.life.take(target.filter(), own, [&](const Detection& taken, bool is_start) {
      chosen_().compared = !is_start && taken.seen();
      if (stepped) stepped(taken.tag, is_start);
    });
  });
}

bool AnyTarget::running() const { return chosen_().now().running; }
std::size_t AnyTarget::starts() const { return chosen_().now().starts; }
std::size_t AnyTarget::rejected() const { return chosen_().now().rejected; }
double AnyTarget::time() const { return chosen_().now().time; }
double AnyTarget::accepted_time() const { return chosen_().now().accepted_time; }
const std::vector<std::string>& AnyTarget::components() const {
  return chosen_().visit([](const auto& target) -> const auto& { return target.filter().components(); });
}

bool AnyTarget::transform(std::span<const double> A, std::span<const double> b) {
  const int axes = chosen_().choice.axes;
  const auto n = static_cast<std::size_t>(axes);
  if (A.size() != n * n || b.size() != n)
    throw std::invalid_argument("a transformation of " + std::to_string(axes) + " axes has as many rows and columns");
  const SquareMatrix<Eigen::Dynamic, 3> by_columns =
      Eigen::Map<const Eigen::MatrixXd>(A.data(), axes, axes).transpose();
  return chosen_().visit(
      [&](auto& target) { return target.life.transform(target.filter(), by_columns.data(), b.data(), axes); });
}

TargetPoint AnyTarget::output() const {
  TargetPoint result;
  output(result);
  return result;
}

void AnyTarget::output(TargetPoint& result) const {
  chosen_().visit([&](const auto& target) {
    const auto& filter = target.filter();
    result.time = target.life.now().time;
    double numbers[max_measurement_size];
    const int m = filter.accepted() ? filter.normalized_innovation(numbers) : 0;
    result.normalized_innovation.assign(numbers, numbers + m);
    result.nis = filter.accepted() ? std::optional(filter.nis()) : std::nullopt;
    result.log_evidence = chosen_().compared ? std::optional(filter.log_evidence()) : std::nullopt;
    result.log_score = chosen_().compared ? std::optional(filter.log_score()) : std::nullopt;
    detail::tell(filter, filter.state(), chosen_().choice.most_likely_output, result);
  });
}

void AnyTarget::smoothed(const std::function<void(const TargetPoint&)>& visit) const {
  chosen_().visit([&](const auto& target) {
    TargetPoint point;
    target.life.smoothed(target.filter(), [&](const auto& kept, const auto& state) {
      point.time = kept.time;
      point.tag = kept.tag;
      point.is_start = kept.is_start;
      point.nis = kept.nis;
      detail::tell(target.filter(), state, chosen_().choice.most_likely_output, point);
      visit(point);
    });
  });
}

std::vector<ModeStay> AnyTarget::explained() const {
  std::vector<ModeStay> stays;
  chosen_().visit([&](const auto& target) {
    target.life.explained([&](const auto& kept, std::size_t mode) {
      stays.push_back({kept.time, kept.tag, mode, kept.is_start});
    });
  });
  return stays;
}

void AnyTarget::follow(std::span<const AnyDetection> detections, const std::function<void(const TargetPoint&)>& visit) {
  TargetPoint point;
  const auto stepped = [&](std::size_t tag, bool is_start) {
    output(point);
    point.tag = tag;
    point.is_start = is_start;
    visit(point);
  };
  for (const AnyDetection& detection : detections) take(detection, stepped);
}

}  // namespace sigmax
