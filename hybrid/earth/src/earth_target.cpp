#include <sigmax/earth/earth_target.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <sigmax/estimation/filtering.hpp>
#include <sigmax/estimation/radar.hpp>

namespace sigmax {
namespace {

using Turn = SquareMatrix<Eigen::Dynamic, 3>;

/// So far from the origin of a frame its axes are no longer east and north.
bool far_away(const Position& position) { return std::hypot(position[0], position[1]) > 50e3; }

Position position_of(const TargetPoint& point, int axes) {
  Position position{};
  std::copy_n(point.mean.begin(), axes, position.begin());
  return position;
}

Turn local_axes(const LocalFrame& frame, const Position& at, int axes) {
  const auto rows = frame.local_axes(at);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows[0].data()).topLeftCorner(axes, axes);
}

/// Turns a point by A, by columns, and then shifts its position.
void turn(const double* A, const Position& shift, int axes, TargetPoint& point) {
  detail::transform(A, shift.data(), axes,
                    {point.mean.data(), point.covariance.data(), static_cast<int>(point.mean.size())});
}

const Geodetic& checked(const Geodetic& place) {
  if (!place.is_valid())
    throw std::invalid_argument(
        "a latitude is not within ±90°, a longitude not within ±360°, or an altitude not finite");
  return place;
}

bool is_sighting(const AnyDetection& detection) {
  using enum AnyDetection::Sensor;
  return detection.sensor == polar || detection.sensor == doppler || detection.sensor == bearing;
}

}  // namespace

std::optional<Geodetic> place_of(const AnyDetection& detection, int axes, double altitude_m) {
  const auto latitude = component_of(detection, 0), longitude = component_of(detection, 1);
  if (!latitude || !longitude) return std::nullopt;
  return Geodetic{*latitude, *longitude, axes == 3 ? component_of(detection, 2).value_or(altitude_m) : 0.0};
}

AnyDetection in_frame(AnyDetection detection, const LocalFrame& frame, const Position& at, int axes) {
  Vector<3> v = Vector<3>::Zero();
  for (int i = 0; i < axes; ++i) v[i] = component_of(detection, axes + i).value_or(0.0);
  if (is_moving(detection, axes)) v = (local_axes(frame, at, 3).transpose() * v).eval();
  for (std::size_t i = 0; i < static_cast<std::size_t>(detection.size); ++i) {
    const int place = detection.sensor == AnyDetection::Sensor::position ? static_cast<int>(i) : detection.places[i];
    detection.z[i] = place < axes ? at[static_cast<std::size_t>(place)] : v[place - axes];
  }
  return detection;
}

AnyDetection seen_from(const Geodetic& sensor, AnyDetection detection, const LocalFrame& frame, int axes) {
  detection.origin = frame.to_local(sensor);
  const bool is_bearing = detection.sensor == AnyDetection::Sensor::bearing;
  const bool has_elevation = !is_bearing && axes == 3 && detection.size > 2;
  double& azimuth = detection.z[is_bearing ? 0 : 1];
  const Vector<3> seen = to_cartesian({1.0, radians(azimuth), radians(has_elevation ? detection.z[2] : 0.0)});
  const Polar turned = to_polar(local_axes(frame, detection.origin, 3).transpose() * seen);
  azimuth = turned.azimuth.radians();
  if (has_elevation) detection.z[2] = turned.elevation.radians();
  return detection;
}

EarthPoint on_earth(TargetPoint point, const LocalFrame& frame, int axes) {
  const Position position = position_of(point, axes);
  turn(local_axes(frame, position, axes).data(), {}, axes, point);
  std::copy_n(position.begin(), axes, point.mean.begin());
  return {std::move(point), frame.to_geodetic(position)};
}

EarthTarget::EarthTarget(const TargetChoice& choice)
    : AnyTarget(choice),
      axes_(choice.axes),
      may_move_(std::ranges::count(choice.motions, "ou_position", &MotionChoice::name) == 0),  // which has a home
      starts_at_origin_(choice.start == StartRule::given),
      keeps_all_(choice.rules.record) {}

void EarthTarget::begin(const Geodetic& origin, const Geodetic& here, bool moves) {
  if (axes_ == 1) throw std::invalid_argument("a target on the Earth has two axes or three");
  anchor_.emplace(checked(origin), axes_);
  moves_ = moves && may_move_;
  const bool stays = !moves_ || starts_at_origin_ || !far_away(anchor_->to_local(checked(here)));
  segments_ = {{0, 0, stays ? *anchor_ : LocalFrame(here, axes_)}};
}

void EarthTarget::follow(std::span<const AnyDetection> detections,
                         const std::function<void(const EarthPoint&)>& visit) {
  for (const AnyDetection& detection : detections) {
    const auto& [latitude, longitude, altitude] = detection.origin;
    const auto here = is_sighting(detection) ? Geodetic{latitude, longitude, altitude} : place_of(detection, axes_);
    if (!anchor_ && here) begin(*here, *here);
    if (anchor_) follow_in_frame(in_frame(detection), [&](const TargetPoint& point) { visit(on_earth(point)); });
  }
}

AnyDetection EarthTarget::in_frame(const AnyDetection& detection) const {
  const LocalFrame& frame = segments_.back().frame;
  if (detection.sensor == AnyDetection::Sensor::none) return detection;
  if (is_sighting(detection))
    return seen_from(checked({detection.origin[0], detection.origin[1], detection.origin[2]}), detection, frame, axes_);
  const int seen = axes_seen(detection, axes_);
  Position at{};
  if (seen < axes_) {
    if (!running()) return {.time = detection.time, .tag = detection.tag};
    const TargetPoint last = output();
    const auto n = static_cast<std::size_t>(axes_);
    for (std::size_t i = 0; i < n; ++i)
      at[i] = last.mean[i] + (i + n < last.mean.size() ? (detection.time - last.time) * last.mean[i + n] : 0.0);
  }
  if (seen > 0) {
    const Geodetic expected = seen < axes_ ? frame.to_geodetic(at) : Geodetic{};
    at = frame.to_local(checked({component_of(detection, 0).value_or(expected.latitude_deg),
                                 component_of(detection, 1).value_or(expected.longitude_deg),
                                 axes_ == 3 ? component_of(detection, 2).value_or(expected.altitude_m) : 0.0}));
  }
  return sigmax::in_frame(detection, frame, at, axes_);
}

void EarthTarget::follow_in_frame(const AnyDetection& detection, const std::function<void(const TargetPoint&)>& visit) {
  std::optional<Position> last;
  AnyTarget::follow({&detection, 1}, [&](const TargetPoint& point) {
    last = position_of(point, axes_);
    visit(point);
  });
  if (moves_ && last && running()) move(*last, detection.tag, false);
}

void EarthTarget::predict(double time, std::size_t tag, const std::function<void(const TargetPoint&)>& visit) {
  if (moves_ && running()) move(position_of(output(), axes_), tag, true);
  const AnyDetection nothing{.time = time, .tag = tag};
  AnyTarget::follow({&nothing, 1}, visit);
}

std::vector<EarthTarget::Segment>::const_iterator EarthTarget::segment(std::size_t tag) const {
  return std::prev(std::ranges::upper_bound(segments_.begin() + 1, segments_.end(), tag, {}, &Segment::first_tag));
}

void EarthTarget::add(const Segment& segment) {
  segments_.push_back(segment);
  if (!keeps_all_) segments_.erase(segments_.begin());
}

/// Moves the frame there if that is far away, from the detection behind `tag` on, or before that detection is
/// predicted.
void EarthTarget::move(const Position& to, std::size_t tag, bool is_before) {
  if (segments_.back().starts == 0) segments_.back().starts = starts();
  const LocalFrame frame = segments_.back().frame;
  if (starts() > segments_.back().starts) add({tag, starts(), frame});
  if (!far_away(to) && !is_before) return;
  const Turn axes = local_axes(frame, to, axes_), rows = axes.transpose(), back = axes.inverse();
  const Vector<Eigen::Dynamic, 3> shift = -axes * Eigen::Map<const Eigen::VectorXd>(to.data(), axes_);
  if (!transform({rows.data(), rows.data() + rows.size()}, {shift.data(), shift.data() + axes_})) return;
  add({is_before ? tag : tag + 1, starts(), LocalFrame(frame.to_geodetic(to), axes_), {}, to});
  std::copy_n(back.data(), back.size(), segments_.back().back.begin());
}

void EarthTarget::smoothed(const std::function<void(const TargetPoint&)>& visit) const {
  AnyTarget::smoothed([&](TargetPoint point) {  // which is in the last frame of its start
    if (anchor_)
      for (auto own = segment(point.tag), later = segments_.end(); --later != own;)
        if (later->starts == own->starts) turn(later->back.data(), later->to, axes_, point);
    visit(point);
  });
}

EarthPoint EarthTarget::on_earth(TargetPoint point, bool is_predicted) const {
  const LocalFrame& frame = segment(point.tag)->frame;
  const double up = position_of(point, axes_)[2];
  const bool about_the_earth = is_predicted && moves_ && axes_ == 3;
  EarthPoint result =
      sigmax::on_earth(std::move(point), about_the_earth ? LocalFrame(frame.origin(), 2) : frame, axes_);
  if (about_the_earth) result.place.altitude_m = frame.origin().altitude_m + up;
  std::copy_n(anchor_->to_local(result.place).begin(), axes_, result.mean.begin());
  return result;
}

}  // namespace sigmax
