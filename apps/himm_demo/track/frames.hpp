#pragma once

#include <Eigen/Core>

#include <sigmax/hybrid/any_target.hpp>

#include "table/geodesy.hpp"

namespace sigmax::apps {

/// So far from the origin of a frame its axes are no longer east and north.
bool far_away(const Position& position);

/// The local frames of a target on the Earth: the anchor, from which positions are counted in the output, and for each
/// filter the frame in which it follows the target, which moves along with it.
class TargetFrames {
 public:
  TargetFrames(const LocalFrame& anchor, int axes) : anchor_(anchor), axes_(axes) {}

  /// Adds a filter that begins in this frame. Of a filter that is to be smoothed all frames are kept.
  void add(const LocalFrame& first, bool keeps_all) { filters_.push_back({{{0, 0, first}}, keeps_all}); }

  const LocalFrame& anchor() const { return anchor_; }

  /// The frame of a filter now, and where the row with a tag was.
  const LocalFrame& now(std::size_t filter) const { return filters_[filter].segments.back().frame; }
  const LocalFrame& at(std::size_t filter, std::size_t tag) const { return segment(filter, tag)->frame; }

  /// Moves the frame of a filter to its last estimate if that is far away, from the row behind `tag` on; or before the
  /// target of that row is predicted.
  void move(std::size_t filter, AnyTarget& target, const TargetPoint& last, std::size_t tag, bool is_before);

  /// A smoothed point, which is in the last frame of its start, in the frame of its row.
  TargetPoint smoothed(std::size_t filter, TargetPoint point) const;

  /// Turns a point of a filter to the anchor: its position is counted from there, and all else is along east, north and
  /// up at the point. Of the covariance, the blocks of each derivative are turned. Returns where the point is. What is
  /// predicted on the Earth goes on about it, rather than straight into space.
  Geodetic to_anchor(std::size_t filter, TargetPoint& point, bool about_the_earth) const;

 private:
  /// A frame from a row on, and the rotation and shift from the frame before, of the same start.
  struct Segment {
    std::size_t first_tag, starts;
    LocalFrame frame;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  };
  struct Filter {
    std::vector<Segment> segments;
    bool keeps_all;
  };

  std::vector<Segment>::const_iterator segment(std::size_t filter, std::size_t tag) const;
  void add(Filter& filter, Segment segment) const;

  LocalFrame anchor_;
  int axes_;
  std::vector<Filter> filters_;
};

}  // namespace sigmax::apps
