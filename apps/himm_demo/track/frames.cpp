#include "himm_demo/track/frames.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace sigmax::apps {
namespace {

Position position_of(const TargetPoint& point, int axes) {
  Position position{};
  std::copy_n(point.mean.begin(), axes, position.begin());
  return position;
}

Eigen::Matrix3d matrix(const std::array<Position, 3>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows[0].data());
}

/// Turns the mean and the covariance of each derivative of a point.
void turn_point(const Eigen::Matrix3d& turn, TargetPoint& point, Eigen::Index axes) {
  const auto n = static_cast<Eigen::Index>(point.mean.size());
  Eigen::Map<Eigen::VectorXd> means(point.mean.data(), n);
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> covariances(
      point.covariance.data(), n, n);
  for (Eigen::Index at = 0; at + axes <= n; at += axes) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    mean.head(axes) = means.segment(at, axes);
    covariance.topLeftCorner(axes, axes) = covariances.block(at, at, axes, axes);
    mean = turn * mean;
    covariance = turn * covariance * turn.transpose();
    means.segment(at, axes) = mean.head(axes);
    covariances.block(at, at, axes, axes) = covariance.topLeftCorner(axes, axes);
  }
}

}  // namespace

bool far_away(const Position& position) {
  return std::sqrt(position[0] * position[0] + position[1] * position[1]) > 50e3;
}

std::vector<TargetFrames::Segment>::const_iterator TargetFrames::segment(std::size_t filter, std::size_t tag) const {
  const auto& all = filters_[filter].segments;
  return std::prev(std::ranges::upper_bound(all.begin() + 1, all.end(), tag, {}, &Segment::first_tag));
}

void TargetFrames::add(Filter& filter, Segment segment) const {
  filter.segments.push_back(std::move(segment));
  if (!filter.keeps_all) filter.segments.erase(filter.segments.begin());
}

void TargetFrames::move(std::size_t filter, AnyTarget& target, const TargetPoint& last, std::size_t tag,
                        bool is_before) {
  Filter& own = filters_[filter];
  if (own.segments.back().starts == 0) own.segments.back().starts = target.starts();
  if (target.starts() > own.segments.back().starts) add(own, {tag, target.starts(), own.segments.back().frame});
  const Position position = position_of(last, axes_);
  if (!far_away(position) && !is_before) return;
  const auto [first_tag, starts, frame, unused_turn, unused_shift] = own.segments.back();
  const Eigen::Matrix3d turn = matrix(frame.local_axes(position));
  const Eigen::Vector3d shift = -turn * Eigen::Map<const Eigen::Vector3d>(position.data());
  std::vector<double> A, b;
  for (Eigen::Index i = 0; i < axes_; ++i) {
    for (Eigen::Index j = 0; j < axes_; ++j) A.push_back(turn(i, j));
    b.push_back(shift(i));
  }
  if (target.transform(A, b))
    add(own, {is_before ? tag : tag + 1, starts, LocalFrame(frame.to_geodetic(position), axes_), turn, shift});
}

TargetPoint TargetFrames::smoothed(std::size_t filter, TargetPoint point) const {
  Eigen::Map<Eigen::VectorXd> position(point.mean.data(), axes_);
  const auto own = segment(filter, point.tag);
  for (auto later = std::prev(filters_[filter].segments.end()); later != own; --later) {
    if (later->starts != own->starts) continue;
    position -= later->shift.head(axes_);
    turn_point(later->turn.inverse(), point, axes_);
  }
  return point;
}

Geodetic TargetFrames::to_anchor(std::size_t filter, TargetPoint& point, bool about_the_earth) const {
  const LocalFrame& frame = at(filter, point.tag);
  const Position position = position_of(point, axes_);
  const bool about = about_the_earth && axes_ == 3;
  const LocalFrame map = about ? LocalFrame(frame.origin(), 2) : frame;
  turn_point(matrix(map.local_axes(position)), point, axes_);
  Geodetic place = map.to_geodetic(position);
  if (about) place.altitude_m = frame.origin().altitude_m + position[2];
  const Position told = anchor_.to_local(place);
  std::copy_n(told.begin(), axes_, point.mean.begin());
  return place;
}

}  // namespace sigmax::apps
