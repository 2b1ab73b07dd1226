#pragma once

#include "recording/doubts/trail.hpp"

namespace sigmax::apps::doubts {

/// Whether times are in the unit, the zone and the order that they were taken for.
class Clocks {
 public:
  /// The time of any row.
  void see(double time);
  /// The time of a position, and that of its track's one before, if there is one.
  void see(double time, std::optional<double> before);
  /// How far a sensor's target came in a step, and how much farther from its first position: what noise adds to ways.
  void see_way(double step, double way, double farther);
  /// A row of a sensor that came as far as before, in a much longer time.
  void see_slip(const Trail& trail, const Spoke& now);

  /// The usual step of a track in s; NaN if there is none.
  double step() const { return steps_.empty() ? nan : median(steps_); }

  /// Of so many tracks, which came so far in so many seconds.
  void say(Say& say, const RecordingReader& recording, std::size_t tracks, double moved, double duration) const;

 private:
  std::string other_times() const;
  bool puts_clocks_forward(double step, bool alone) const;
  void say_reading(Say& say, const RecordingReader& recording, double step) const;
  void say_cut(Say& say, double moved) const;
  void say_unit(Say& say, std::size_t tracks, double moved, double duration) const;
  bool are_dates() const { return latest_ >= 1.9e13 && latest_ < 2.1e13; }  // in digits
  bool is_far_off() const { return !are_dates() && latest_ > 1e11; }

  std::vector<double> steps_;  // between positions of a track, the first thousands
  double first_ = nan;         // time of them
  std::set<long> slips_;       // by how long, and -1 for what no clock does
  std::size_t slipped_ = 0;    // steps much longer than others, in which the target went as far as in one of those
  struct {
    std::size_t line;
    double dt, step;
  } slip_{};                                               // the first
  std::map<double, std::pair<std::size_t, double>> ways_;  // by step, of several: how many, and how much farther
  double path_ = 0.0;                                      // all ways
  std::size_t fractions_ = 0;                              // times of no whole second
  std::size_t times_ = 0, clocks_ = 0, minutes_ = 0, hours_ = 0, uneven_ = 0;
  double hundreds_ = nan, latest_ = 0.0;  // of the last time
};

}  // namespace sigmax::apps::doubts
