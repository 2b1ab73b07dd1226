#pragma once

#include <cmath>

#include "recording/recording.hpp"

namespace sigmax::apps {

/// Signs that a recording's numbers mean something else than they were taken for, gathered row by row.
class Doubts {
 public:
  /// A row, and where its measurement was, in m.
  void see(const Row& row, const std::optional<Position>& position, int axes);

  /// Sentences, each with the name or the option that mends it.
  std::vector<std::string> sentences(const RecordingReader& recording) const;

 private:
  /// What rows told of a rate against how its quantity grew between them, as sums of products.
  struct Agreement {
    std::size_t count = 0;
    double product = 0.0, told = 0.0, grew = 0.0;

    void add(double told_now, double growth);
    double correlation() const { return product / std::sqrt(told * grew); }
    double growth_per_told() const { return product / told; }
  };
  struct Spoke {
    double time;
    Position position, velocity;
    double range, range_rate;
  };
  struct Track {
    double first_time = 0.0, time = 0.0;  // of those with a position
    std::optional<Position> first{}, last{};
    std::optional<Position> located{};     // by a sensor of positions
    std::map<std::string, Spoke> spoke{};  // by sensor
  };
  void see_azimuth(double azimuth, const Position& from_radar);
  void see_rates(const Spoke& before, const Spoke& now);
  double median_step() const;

  std::map<std::string, Track> tracks_;
  std::vector<double> steps_;  // between measurements of a track, the first thousands
  Agreement range_rates_, velocities_, swapped_velocities_, climbs_;
  double path_ = 0.0;                 // of all positions, each sensor's own
  std::size_t jumps_ = 0, held_ = 0;  // of that path, and those of them that lead nowhere
  std::size_t azimuths_ = 0;
  double as_read_ = 0.0, other_way_ = 0.0, radians_ = 0.0;  // sums of cosines of azimuths' errors
};

}  // namespace sigmax::apps
