#pragma once

#include <cmath>

#include <sigmax/estimation/gaussian.hpp>

#include "recording/recording.hpp"

namespace sigmax::apps {

inline constexpr double metres_a_degree = 60.0 * units::nautical_mile;  // of latitude

/// The standard deviation of the rounding of numbers that come in whole steps; else 0, and infinite where they never
/// change.
double rounding_of(std::vector<double> numbers);

/// Signs that a recording's numbers mean something else than they were taken for, gathered row by row.
class Doubts {
 public:
  /// A row, and where its measurement was, in m.
  void see(const Row& row, const std::optional<Position>& position, int axes);

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
  static constexpr std::size_t few = 10;

  /// What rows told of a rate against how its quantity grew between them, as sums of products.
  struct Agreement {
    std::size_t count = 0;
    double product = 0.0, told = 0.0, grew = 0.0;

    void add(double told_now, double growth);
    double correlation() const { return product / std::sqrt(told * grew); }
    double growth_per_told() const { return product / told; }
    /// The square of the relative standard error of that.
    double error_square() const { return (told * grew / (product * product) - 1.0) / static_cast<double>(count); }
    bool fits() const { return count >= few && correlation() > 0.9; }
    /// Whether what is told is too small, or too great, whichever of the two is noisy.
    bool other_size() const {
      const double margin = 0.08 + 5.0 * std::sqrt(std::max(error_square(), 0.0));
      return growth_per_told() > 1.0 + margin || grew / product < 1.0 / (1.0 + margin);
    }
    /// Whether the rate has the other sign, by four standard errors of a correlation that is none.
    bool other_sign() const {
      const double square = correlation() * correlation();
      return count >= few && correlation() < -0.5 && square * static_cast<double>(count - 2) > 16.0 * (1.0 - square);
    }
  };
  /// The rates along x, y and z, and of the range; those of the first two together, taken for each other, and a right
  /// angle to the left.
  enum Rate : unsigned { x, y, z, range, velocities, exchanged, to_the_left };
  using Rates = std::array<Agreement, to_the_left + 1>;
  /// What grows by the first four: a position, with the height that the row tells, and the range.
  using Grown = Eigen::Array4d;
  /// What a sensor told: a position and what grows, and how fast it does.
  struct Spoke {
    double time;
    Vector<3> at;
    Grown grown, rate;
    Vector<3> error;  ///< about the truth
    std::optional<Vector<3>> from_radar;
    bool twice;     ///< whether it is the number that comes twice
    double height;  ///< as the row tells it
    std::size_t line;
  };
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
  /// Where a sensor's quantities were some rows ago, and how far they went since by the rates that it told.
  struct Since {
    double time;
    Grown grown, rate, told = Grown::Zero();
    std::size_t rows = 0;
    bool held = false;  ///< whether some rows told no rate, or there was a gap
  };
  /// From one row to the next much farther than before and after, and not back again: nothing turns so sharply.
  struct Leap {
    Vector<3> from;
    double way, dt;
    std::size_t line;      ///< of the row that it ends on
    std::size_t rows = 0;  ///< since
  };
  struct Sensor {
    Spoke last;
    std::array<Since, 3> since;
    std::optional<std::pair<double, Vector<3>>> before{};   // the last one
    double way = 0.0;                                       // between these, along the ground if there is a height
    std::array<std::size_t, 4> runs{};                      // of stays_, that last
    double step = std::numeric_limits<double>::infinity();  // up to it
    std::size_t even = 0;                                   // as many steps before are as long
    std::size_t silent = 0;                                 // rows since a velocity was told
    std::vector<Vector<3>> recent{};                        // the last few
    std::vector<std::pair<double, double>> moves{};         // the last few ways, and speeds along them
    std::optional<Leap> leap{};                             // that the next few rows confirm
  };
  /// How far a sensor's position is off the way between two of another one, and how that other one moves there.
  struct Off {
    Vector<3> by, velocity, at;
    std::optional<Vector<3>> from_radar;  ///< where it is from the sensor, of a radar
    double bend;                          ///< squared, of the other one's own last position off its own way
  };
  struct Bearing {
    Position from;
    double azimuth;
  };
  struct Track {
    double first_time = 0.0, time = 0.0;  // of those with a position
    std::optional<Vector<3>> first{}, last{};
    std::optional<Vector<3>> located{};     // by a sensor of positions
    std::optional<Bearing> bearing{};       // the last one
    std::map<std::string, Sensor> spoke{};  // by sensor
    std::string latest{};                   // of them
  };
  void see_bearing(const Bearing& now, std::optional<Bearing>& before);
  void see_rates(Sensor& before, Spoke now);
  void see_leap(Sensor& before, const Spoke& now, double jump);
  std::string shifted() const;
  bool comes_back() const;
  std::string other_times() const;
  bool puts_clocks_forward(double step) const;
  static std::string why_apart(const std::vector<Off>& rows, int axes);
  void see_other(const std::string& sensor, const Spoke& now, Track& track);

  std::map<std::string, Track> tracks_;
  std::set<std::string> sensors_;
  std::array<std::vector<double>, 2> numbers_;  // along x and y, as rows tell them, the first thousand
  std::vector<double> steps_;                   // between measurements of a track, the first thousands
  std::array<Rates, 3> rates_;                  // from row to row, where noise hides what is slow, and over many rows
  Agreement offset_;  // of what ten rows tell from how they grew: its squares, and those of what is told
  Vector<3> offsets_ = Vector<3>::Zero();  // the sum
  struct {
    std::size_t count = 0;
    double off = 0.0, rough = 0.0;
  } computed_;  // squares: how far velocities are off the way between the rows beside them, and by what noise would be
  struct {
    std::vector<double> sizes{};          // the first thousands along an axis
    std::array<double, 4> products = {};  // of each with itself and those before
  } second_;                              // differences of positions
  struct {
    std::size_t count = 0;
    double sum = 0.0;
  } variances_;                    // that rows tell of positions, along an axis
  std::array<Agreement, 3> late_;  // how velocities change over these rows, and what positions grow beyond them
  double farthest_ = 0.0;          // of positions from where they are counted
  double path_ = 0.0;              // of all positions, each sensor's own
  std::array<Stays, 4> stays_;     // of positions, heights, velocities and truths
  std::size_t held_again_ = 0;     // positions that change, where the next one does not
  std::set<long> ways_;            // how far those went, some, as logarithms to three digits
  struct {
    std::size_t count = 0;
    double sum = 0.0;
    double mean() const { return sum / static_cast<double>(count); }
  } steps_on_[2];               // ways after a position that was not held, and after one that was
  std::size_t returns_ = 0;     // positions that are near one of the last few, but not near the last
  std::optional<Leap> leap_{};  // the first, and how many there are
  std::size_t leaps_ = 0;
  std::set<long> slips_;     // by how long, and -1 for what no clock does
  std::size_t slipped_ = 0;  // steps much longer than others, in which the target went as far as in one of those
  struct {
    std::size_t line;
    double dt, step;
  } slip_{};  // the first
  Stranger zero_heights_, zero_truths_;
  std::optional<double> twice_;  // the first number that is both coordinates of a position
  std::size_t twice_rows_ = 0;
  double to_twice_ = 0.0;                                                  // the path there and back
  std::map<std::pair<std::string, std::string>, std::vector<Off>> apart_;  // sensors of one track, the first thousand
  // How far positions are off the line between the two beside them, and these from each other.
  std::map<const Sensor*, std::vector<std::pair<double, double>>> bends_;
  std::size_t bent_ = 0;               // of those, the first thousands
  std::size_t errors_ = 0, same_ = 0;  // about the truth, and those that are much as the one before
  double off_ = 0.0;                   // sum of those
  Agreement lag_;                      // of the truth's velocity with them
  // Sums of errors, their squares, and their products with those before.
  Eigen::Array3d error_ = Eigen::Array3d::Zero(), square_ = error_, next_ = error_;
  std::size_t azimuths_ = 0;
  double as_read_ = 0.0, other_way_ = 0.0, radians_ = 0.0;     // sums of cosines of azimuths' errors
  std::size_t pairs_ = 0, crossing_ = 0, crossing_other_ = 0;  // bearings of two places
  std::size_t times_ = 0, clocks_ = 0, minutes_ = 0, uneven_ = 0;
  std::size_t hours_ = 0;
  double hundreds_ = nan, latest_ = 0.0;  // of the last time
};

}  // namespace sigmax::apps
