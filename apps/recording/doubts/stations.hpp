#pragma once

#include "recording/doubts/trail.hpp"

namespace sigmax::apps::doubts {

/// Whether sensors stand and look where they are said to: by the truth, by positions, and by each other.
class Stations {
 public:
  struct Bearing {
    Position from;
    double azimuth;
  };

  /// Where a radar that moves saw its target, read as it is, and with its azimuths the other way; which bends as if its
  /// own x were its y.
  struct Path {
    std::array<Recent<Vector<3>>, 2> at{};
    Recent<double> times{};
    std::optional<Position> from{};
  };
  void see_path(const Vector<3>& at, const AnyPlot& plot, Path& path);
  /// A plot, and the truth or the last position of its track.
  void see(const AnyPlot& plot, const std::optional<Vector<3>>& reference, std::optional<Bearing>& before);
  /// A position.
  void see(const Vector<3>& at) { farthest_ = std::max(farthest_, std::hypot(at[0], at[1])); }
  /// A row after the first of its sensor.
  void see_error(const Spoke& last, const Spoke& now);
  /// What a sensor told between another one's last row and now; that one's last row is off its own way by `bend`.
  void see_other(const std::string& sensor, const Spoke& last, const Spoke& now, const Vector<3>& bend,
                 const std::string& other, const Spoke& told);

  /// Whether bearings come from one place that moves: from row to row by little, rather than between two that stand.
  bool from_one_that_moves() const;

  /// The distance of sensors and positions from where they are counted, in m.
  double farthest() const { return farthest_; }
  /// So far off is the farthest place on a map of two axes on which lines of sight from elsewhere are straight, in m.
  double off_the_map() const { return std::pow(farthest_, 3) / (6.0 * earth * earth); }

  /// `step` is the usual one in s; `no_truth` whether a truth of (0, 0) stands for none.
  void say(Say& say, const RecordingReader& recording, double step, bool no_truth) const;

 private:
  /// How far a sensor's position is off the way between two of another one, and how that other one moves there.
  struct Off {
    Vector<3> by, velocity, at;
    std::optional<Vector<3>> from_radar;  ///< where it is from the sensor, of a radar
    double bend;                          ///< squared, of the other one's own last position off its own way
    Vector<3> way = velocity;             ///< the velocity of the rows about it
  };
  static std::string why_apart(std::vector<Off> rows, int axes);
  std::string shifted() const;
  void say_azimuths(Say& say, const RecordingReader& recording) const;
  void say_truth(Say& say, double step) const;
  void say_sensors(Say& say, const RecordingReader& recording) const;

  std::size_t azimuths_ = 0;
  double as_read_ = 0.0, other_way_ = 0.0, radians_ = 0.0;     // sums of cosines of azimuths' errors
  std::size_t pairs_ = 0, crossing_ = 0, crossing_other_ = 0;  // bearings of two places
  struct {
    std::size_t count = 0, moves = 0;
    double way = 0.0;
    Eigen::Array3d least = Eigen::Array3d::Constant(infinity), greatest = -least;
  } places_;  // from which bearings were
  struct {
    std::size_t count = 0;
    std::array<double, 2> sums{};
  } bends_;  // of paths, so read
  static constexpr double earth = 6.371e6;
  double farthest_ = 0.0;
  std::size_t errors_ = 0, same_ = 0;  // about the truth, and those that are much as the one before
  double off_ = 0.0;                   // sum of those
  Agreement lag_;                      // of the truth's velocity with them
  // Sums of errors, their squares, and their products with those before.
  Eigen::Array3d error_ = Eigen::Array3d::Zero(), square_ = error_, next_ = error_;
  std::map<std::pair<std::string, std::string>, std::vector<Off>> apart_;  // sensors of one track, the first thousand
};

}  // namespace sigmax::apps::doubts
