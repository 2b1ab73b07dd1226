#pragma once

#include "recording/doubts/trail.hpp"

namespace sigmax::apps::doubts {

/// How often something stays as it was, to the last digit, and after how many rows it changes.
struct Stays {
  std::size_t same = 0, changed = 0;
  std::map<std::size_t, std::size_t> after{};  ///< so many that were the same, so often
  std::set<float> changes{};                   ///< how great they are, some

  void see(double change, std::size_t& run);
  /// Whether nearly all changes come after as many rows, as where a slower source is repeated; but for one row, if it
  /// changes by more than a few steps, as what is rounded does.
  bool regular() const;
};

/// What is told once more, or stands for nothing, and yet counts as measured.
class Repeats {
 public:
  struct Sensor {
    double way = 0.0;                           // of the last row, along the ground if there is a height
    std::array<std::size_t, 4> runs{};          // of stays_, that last
    Recent<std::pair<double, double>> moves{};  // ways, and speeds along them
    using Offs = std::vector<std::pair<double, double>>;
    Offs bends{};   // how far positions are off the line between the two beside them, and these from each other
    Offs curves{};  // fourth differences, which a cubic has none of, and how far their first is from their last
    /// From one row to the next much farther than before and after, and not back again: nothing turns so sharply.
    struct Leap {
      Vector<3> from;
      double way, dt;
      std::size_t line;      ///< of the row that it ends on
      std::size_t rows = 0;  ///< since
    };
    std::optional<Leap> leap{};  // that the next few rows confirm
  };

  void see(const Row& row, const Spoke& now, int axes);
  /// A row after the first of its sensor.
  void see(Sensor& sensor, const Trail& trail, const Spoke& now);
  /// A row after one of another sensor, that came so far from its own one before, and not from that one.
  void see_other(double way, bool same);
  /// How far the last row is off the way between the one before and this one.
  void see_bend(Sensor& sensor, const Trail& trail, const Spoke& now, double bend);

  const Stays& velocities() const { return stays_[2]; }
  /// Whether a truth of (0, 0) stands for none.
  bool no_truth() const { return zero_truths_.stands_out(); }
  /// Whether positions alternate, as those of several targets in one do.
  bool comes_back() const;

  void say_interpolated(Say& say, const std::vector<const Sensor*>& sensors, double rounding) const;
  /// `moved` is how far all tracks came, in m.
  void say(Say& say, const RecordingReader& recording, std::size_t tracks, double moved) const;

 private:
  /// A number that may stand for none: in how many rows it is, and whether it is always much farther off than all else.
  struct Stranger {
    std::size_t rows = 0, others = 0;
    double least = std::numeric_limits<double>::infinity(), greatest_other = 0.0;

    void see(bool is_it, double off) {
      if (is_it) {
        least = std::min(least, off);
      } else {
        ++others;
        greatest_other = std::max(greatest_other, off);
      }
    }
    bool stands_out() const { return rows > 1 && others > 0 && std::isfinite(least) && least > 5.0 * greatest_other; }
  };
  bool is_twice(const Spoke& spoke) const { return spoke.twice && spoke.twice == twice_; }
  void see_leap(Sensor& sensor, const Trail& trail, const Spoke& now, double jump);
  void say_held(Say& say, std::size_t tracks, double moved) const;

  std::array<Stays, 4> stays_;        // of positions, heights, velocities and truths
  double path_ = 0.0;                 // of all positions, each sensor's own
  std::size_t held_again_ = 0;        // positions that change, where the next one does not
  std::set<long> ways_;               // how far those went, some, as logarithms to three digits
  RunningMean on_, after_;            // ways after a position that was not held, and after one that was
  std::size_t returns_ = 0;           // positions that are near one of the last few, but not near the last
  std::optional<Sensor::Leap> leap_;  // the first, and how many there are
  std::size_t leaps_ = 0;
  std::size_t bent_ = 0;                 // bends of all sensors
  std::size_t others_ = 0, echoes_ = 0;  // rows after those of other sensors, and those that only repeat one
  std::set<float> echoed_;               // their own ways, some
  Stranger zero_heights_, zero_truths_;
  std::optional<double> twice_;  // the first number that is both coordinates of a position
  std::size_t twice_rows_ = 0;
  double to_twice_ = 0.0;  // the path there and back
};

}  // namespace sigmax::apps::doubts
