#pragma once

#include <sigmax/earth/earth_detection.hpp>
#include <sigmax/hybrid/any_target.hpp>

namespace sigmax {

/// What is known of a target on the Earth at one time. Its position is counted from the target's origin, and all else
/// is along east, north and up at its place.
struct EarthPoint : TargetPoint {
  Geodetic place;
};

/// A point in a frame, with axes along east, north and up at the frame's origin, on the Earth.
EarthPoint on_earth(TargetPoint point, const LocalFrame& frame, int axes);

/// An AnyTarget on the Earth, along two or three axes. It is followed in a local frame that moves along with it, so
/// that its axes are east, north and up wherever it goes.
///
///     EarthTarget target{choice};
///     target.follow(detections, [](const EarthPoint& point) { use(point.place.latitude_deg,
///     point.place.longitude_deg); });
///
/// Where steps are recorded, to be smoothed, the tags of detections must grow.
class EarthTarget : public AnyTarget {
 public:
  /// Throws as AnyTarget, and for one axis.
  explicit EarthTarget(const TargetChoice& choice);

  /// Positions are counted from `origin`, where it is followed, too, unless it begins far from there and may move. A
  /// target that is not told where it begins does so at the first place of what it follows.
  void begin(const Geodetic& origin, const Geodetic& here, bool moves = true);
  /// The frame from which positions are counted, once it has begun.
  const std::optional<LocalFrame>& anchor() const { return anchor_; }

  /// Takes detections on the Earth, see earth_detection.hpp, one after another, and calls visit(point) after each step
  /// and start. An altitude alone, or a place without one, is a detection. Throws std::invalid_argument for what is no
  /// place.
  void follow(std::span<const AnyDetection> detections, const std::function<void(const EarthPoint&)>& visit);

  /// @{
  /// The parts of `follow`. `in_frame` gives a detection in the current frame; components that it lacks are taken from
  /// the predicted place. `follow_in_frame` steps with a detection in that frame. `on_earth` puts a point of that frame
  /// on the Earth. `in_frame` and `on_earth` require a target that has begun. Before that, a step is AnyTarget's, and a
  /// detection without a whole place is missed.
  AnyDetection in_frame(const AnyDetection& detection) const;
  void follow_in_frame(const AnyDetection& detection, const std::function<void(const TargetPoint&)>& visit);
  EarthPoint on_earth(TargetPoint point, bool is_predicted = false) const;
  /// @}

  /// A last step without a detection, however long: on_earth(point, true) goes on about the Earth, not into space.
  void predict(double time, std::size_t tag, const std::function<void(const TargetPoint&)>& visit);

  /// As AnyTarget::smoothed, each point in the frame of its step.
  void smoothed(const std::function<void(const TargetPoint&)>& visit) const;

 private:
  /// A frame from a tag on, and the turn, by columns, and shift back to the frame before, of the same start.
  struct Segment {
    std::size_t first_tag, starts;
    LocalFrame frame;
    std::array<double, 9> back{};
    Position to{};
  };

  std::vector<Segment>::const_iterator segment(std::size_t tag) const;
  void add(const Segment& segment);
  void move(const Position& to, std::size_t tag, bool is_before);

  int axes_;
  bool may_move_, moves_ = false, starts_at_origin_, keeps_all_;
  std::optional<LocalFrame> anchor_;
  std::vector<Segment> segments_;  // the last one, or of what is recorded all
};

}  // namespace sigmax
