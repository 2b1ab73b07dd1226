#pragma once

#include <cmath>

#include <sigmax/core/mean_interval.hpp>
#include <sigmax/estimation/gaussian.hpp>

#include "recording/recording.hpp"

/// What the doubts about a recording have in common: what a sensor told, how two kinds of numbers agree, and how a
/// doubt is said. Each kind of doubt sees row by row and has a file: the rates, the clocks, the stations, and what is
/// repeated.
namespace sigmax::apps::doubts {

inline constexpr std::size_t few = 10, many = 10000;

inline double dot(const Vector<3>& a, const Vector<3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double length(const Vector<3>& a) { return std::sqrt(dot(a, a)); }

/// "12.5, -3": as many numbers as there are axes.
inline std::string numbers_of(const Vector<3>& a, int axes) {
  return fmt::format("{:.3g}", fmt::join(a.data(), a.data() + axes, ", "));
}

/// The upper one of two.
inline double median(std::vector<double> some) {
  const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
  std::ranges::nth_element(some, middle);
  return *middle;
}

/// The last few of what comes one after the other.
template <class One>
class Recent {
 public:
  void keep(const One& one) {
    if (is_full()) some_.erase(some_.begin());
    some_.push_back(one);
  }
  bool is_full() const { return some_.size() == 8; }
  /// Whether there are as many as that, and one more.
  bool reaches(std::size_t ago) const { return some_.size() > ago; }
  const One& operator[](std::size_t ago) const { return some_[some_.size() - 1 - ago]; }
  auto begin() const { return some_.begin(); }
  auto end() const { return some_.end(); }

 private:
  std::vector<One> some_;
};

/// What rows told of a quantity against what it was by others, as sums of products.
struct Agreement {
  std::size_t count = 0;
  double product = 0.0, told = 0.0, grew = 0.0;

  void add(double told_now, double growth) {
    if (std::isnan(told_now)) return;
    product += told_now * growth;
    told += told_now * told_now;
    grew += growth * growth;
    ++count;
  }
  double correlation() const { return product / std::sqrt(told * grew); }
  double growth_per_told() const { return product / told; }
  /// The square of the relative standard error of that.
  double error_square() const { return (told * grew / (product * product) - 1.0) / static_cast<double>(count); }
  /// Whether so much of the squares is explained by a time of a third to twenty steps.
  bool tells_a_delay(double explained, double step) const {
    const double delay = std::abs(growth_per_told());
    return correlation() * correlation() > explained && delay > 0.3 * step && delay < 20.0 * step;
  }
};

/// What grows: a position, with the height that the row tells, and the range.
using Grown = Eigen::Array4d;

/// What a sensor told: a position and what grows, and how fast it does.
struct Spoke {
  double time;
  Vector<3> at;
  Grown grown, rate;
  Vector<3> velocity;  ///< as the row tells it
  Vector<3> error;     ///< about the truth
  std::optional<Vector<3>> from_radar;
  double height;  ///< as the row tells it
  std::optional<double> twice;
  std::size_t line;
};

/// A sensor's last rows.
struct Trail {
  Spoke last;
  std::optional<std::pair<double, Vector<3>>> before{};   ///< the time and position of the one before
  Recent<Vector<3>> recent{};                             ///< positions
  double step = std::numeric_limits<double>::infinity();  ///< up to the last one, in s
  std::size_t even = 0;                                   ///< as many steps before are as long
};

/// How far a place is off the way between two others, by the times of all three.
inline Vector<3> off_the_way(double time, const Vector<3>& at, double from, const Vector<3>& a, double to,
                             const Vector<3>& b) {
  return at - a - (b - a) * (time - from) / (to - from);
}

/// How azimuths would run, if not as they are taken for, and what says so.
inline std::string_view other_way_of_azimuths(const RecordingReader& recording) {
  return recording.from_north() ? "counter-clockwise from east" : "clockwise from north";
}
inline std::string_view remedy_of_azimuths(const RecordingReader& recording) {
  return recording.from_north() ? "name the column azimuth_deg, without --azimuth-from" : "give --azimuth-from north";
}

/// Takes down the sentences of doubts that hold.
class Say {
 public:
  explicit Say(const std::string& file) : file_(file) {}
  template <class... Words>
  void operator()(bool holds, std::string_view format, const Words&... words) {
    if (holds) sentences.push_back(file_ + ": " + fmt::format(fmt::runtime(format), words...));
  }
  std::vector<std::string> sentences{};

 private:
  const std::string& file_;
};

}  // namespace sigmax::apps::doubts
