#pragma once

#include "recording/doubts/clocks.hpp"
#include "recording/doubts/places.hpp"
#include "recording/doubts/rates.hpp"

namespace sigmax::apps {

inline constexpr double metres_a_degree = 60.0 * units::nautical_mile;  // of latitude

/// The standard deviation of the rounding of numbers that come in whole steps; else 0, and infinite where they never
/// change.
double rounding_of(std::vector<double> numbers);

/// Signs that a recording's numbers mean something else than they were taken for, gathered row by row.
class Doubts {
 public:
  /// A row, and where its measurement was, in m; of a place on the Earth, in this frame.
  void see(const Row& row, const std::optional<Position>& position, const LocalFrame* frame, int axes);

  /// The standard deviation of the rounding of coordinates in m, if they come in whole steps; of several the greatest.
  double rounding(const RecordingReader& recording) const;

  /// By what noise that is another one in each row positions scatter about their way, along an axis in m, where that is
  /// most of how they bend; nothing where they bend by another law, or steps are uneven.
  std::optional<double> scatter() const;

  /// The standard deviation along an axis that rows tell of positions, if hundreds do.
  std::optional<double> told_sigma() const;

  /// Sentences, each with the name or the option that mends it.
  std::vector<std::string> sentences(const RecordingReader& recording) const;

 private:
  struct Sensor {
    explicit Sensor(const doubts::Spoke& first) : trail{first}, rates(first) {}
    doubts::Trail trail;
    doubts::Rates::Sensor rates;
    doubts::Repeats::Sensor repeats{};
  };
  struct Track {
    double first_time = 0.0, time = 0.0;  // of those with a position
    std::optional<Vector<3>> first{}, last{};
    std::optional<Vector<3>> located{};                // by a sensor of positions
    std::optional<doubts::Places::Bearing> bearing{};  // the last one
    std::map<std::string, Sensor> sensors{};
    std::string latest{};  // of them
  };
  void see_next(const Track& track, const std::string& name, Sensor& sensor, doubts::Spoke& now);
  void see_bends(const doubts::Trail& trail, const doubts::Spoke& now);
  void say_reading(doubts::Say& say, const RecordingReader& recording) const;

  doubts::Rates rates_;
  doubts::Places places_;
  doubts::Repeats repeats_;
  doubts::Clocks clocks_;
  std::map<std::string, Track> tracks_;
  std::set<std::string> sensors_;
  static constexpr std::size_t enough_numbers = 1000;
  std::array<std::vector<double>, 2> numbers_;  // along x and y, as rows tell them, the first of them
  struct {
    std::vector<double> sizes{};          // the first thousands along an axis
    std::array<double, 4> products = {};  // of each with itself and those before
  } second_;                              // differences of positions
  struct {
    std::size_t count = 0;
    double sum = 0.0;
  } variances_;  // that rows tell of positions, along an axis
};

}  // namespace sigmax::apps
