#pragma once

#include <cstddef>
#include <map>
#include <span>

#include <sigmax/estimation/chi_square.hpp>

namespace sigmax {

/// Are a filter's innovations what it believes? If it is right, each number of an innovation, in its own standard
/// deviations, has mean square 1 and does not depend on the one before, and the sum of their squares, the NIS, is χ²
/// with as many degrees of freedom (Bar-Shalom, Li, Kirubarajan 2001, 5.4). In memory that does not grow with the rows.
///
///     InnovationTally tally;
///     for (…) tally.add(point.normalized_innovation, before);   // `before` is the last one of the same sensor
///     if (tally.mean_square() > tally.band().upper) …           // the filter is too sure of itself
class InnovationTally {
 public:
  /// An innovation in its own standard deviations, and that before it, which may be empty or of another size.
  void add(std::span<const double> innovation, std::span<const double> before = {});

  /// An NIS of so many measured quantities, where nothing else is known of the innovation.
  void add_nis(double nis, std::size_t quantities);

  std::size_t count() const { return count_; }

  /// @{
  /// The NIS: its mean, its median to 0.1 %, and the share below the number below which 95 % should be. NaN, or 0 for
  /// the median, without any.
  double mean_nis() const;
  double expected_nis() const;  ///< the mean number of quantities, where that of a filter that is right is
  double median_nis() const;
  double share_inside() const;
  /// @}

  /// Mean square and autocorrelation of lag one of the numbers, each with its band: there it lies with a probability of
  /// 95 % if the filter is consistent. Numbers of `add_nis` do not count.
  double mean_square() const { return squares_ / static_cast<double>(numbers_); }
  Band band() const { return chi_square_band(1.0, static_cast<double>(numbers_)); }
  double autocorrelation() const { return products_ / squares_; }
  double autocorrelation_band() const;

 private:
  std::size_t count_ = 0;
  std::size_t quantities_ = 0;
  double nis_ = 0.0;
  std::size_t inside_ = 0;
  std::map<int, std::size_t> bins_;  ///< of the NIS' logarithm
  std::size_t numbers_ = 0;
  std::size_t pairs_ = 0;
  double squares_ = 0.0;
  double products_ = 0.0;
};

}  // namespace sigmax
