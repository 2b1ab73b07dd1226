#pragma once

#include "recording/doubts/repeats.hpp"

namespace sigmax::apps::doubts {

/// Whether velocities and range rates are those by which positions and ranges grow.
class Rates {
 public:
  /// Over so many rows the two are compared.
  static constexpr std::array<std::size_t, 3> lengths = {1, 10, 100};

  /// Where a sensor's quantities were some rows ago, and how far they went since by the rates that it told.
  struct Since {
    explicit Since(const Spoke& from) : time(from.time), grown(from.grown), rate(from.rate) {}
    double time;
    Grown grown, rate, told = Grown::Zero();
    std::size_t rows = 0;
    bool held = false;  ///< whether some rows told no rate, or there was a gap
  };
  struct Sensor {
    explicit Sensor(const Spoke& first) : since{Since(first), Since(first), Since(first)} {}
    std::array<Since, lengths.size()> since;
    std::size_t silent = 0;  ///< rows since a velocity was told
  };

  /// A row of a sensor, which goes on with the rates before where it tells none.
  void see(Sensor& sensor, const Trail& trail, Spoke& now);

  /// `step` is the usual one in s; `turned` how far one's north may be from another's.
  void say(Say& say, const RecordingReader& recording, const Stays& told, double step, double turned) const;

  /// How far positions and the ways by velocities that change are apart, in standard deviations that are expected, over
  /// as many rows as make it most.
  double apart(double step, double sigma_position, double sigma_velocity) const;

 private:
  /// The rates along x, y and z, and of the range; those of the first two together, taken for each other, and a right
  /// angle to the left.
  enum Rate : unsigned { x, y, z, range, velocities, exchanged, to_the_left };
  struct Compared : Agreement {
    bool fits() const { return count >= few && correlation() > 0.9; }
    bool other_size(double bent) const;
    bool other_sign() const;
  };
  using Pairs = std::array<Compared, to_the_left + 1>;

  bool same_size() const;
  /// Of what a constant takes from the squares of `off_`.
  double square_off() const { return dot(off_.sum, off_.sum) / static_cast<double>(off_.squares.count); }
  bool say_exchanged(Say& say, const RecordingReader& recording) const;
  bool say_signs(Say& say, const RecordingReader& recording, bool is_exchanged) const;
  bool say_scale(Say& say, Rate rate, std::string_view name, std::string_view others) const;
  bool say_turn(Say& say, const RecordingReader& recording, double turned) const;
  void say_source(Say& say, const Stays& told, double step, double turned) const;

  std::array<Pairs, lengths.size()> pairs_;       // from row to row, where noise hides what is slow, and over many rows
  double changes_ = 0.0;                          // of velocities from row to row, squares
  std::array<Agreement, lengths.size()> late_{};  // how velocities change, and what positions grow beyond them
  struct {
    Agreement squares{};
    Vector<3> sum = Vector<3>::Zero();
    double speeds = 0.0;  // squares, of speeds
  } off_;                 // what ten rows tell from how they grew
  struct {
    std::size_t count = 0;
    double off = 0.0, rough = 0.0;
  } computed_;  // squares: how far velocities are off the way between the rows beside them, and by what noise would be
};

}  // namespace sigmax::apps::doubts
