#pragma once

#include <cstddef>
#include <span>

namespace sigmax {

/// A mean with its interval of 95 % confidence: mean ± half_width.
struct Interval {
  double mean = 0.0;
  double half_width = 0.0;

  double lower() const { return mean - half_width; }
  double upper() const { return mean + half_width; }
  bool above_zero() const { return lower() > 0.0; }
  bool below_zero() const { return upper() < 0.0; }
};

/// The mean of numbers that come one by one, by Welford's recursion. The numbers are not kept.
///
///     RunningMean error;
///     for (…) error.add(estimate - truth);
///     error.interval();   // mean ± half width
class RunningMean {
 public:
  void add(double number) {
    ++count_;
    const double before = number - mean_;
    mean_ += before / static_cast<double>(count_);
    squares_ += before * (number - mean_);
  }

  /// Adds all numbers of another one, which may have been collected elsewhere.
  void add(const RunningMean& other) {
    if (other.count_ == 0) return;
    const auto n = static_cast<double>(count_), m = static_cast<double>(other.count_);
    const double apart = other.mean_ - mean_;
    count_ += other.count_;
    mean_ += apart * (m / (n + m));
    squares_ += other.squares_ + apart * apart * (n * m / (n + m));
  }

  std::size_t count() const { return count_; }

  /// Throws std::domain_error if there is no number.
  double mean() const;

  /// Mean ± t s/√n, with s the standard deviation (divided by n − 1) and t the 97.5 % quantile of Student's t with
  /// n − 1 degrees of freedom. One number alone has an infinite half width. Throws std::domain_error if there is none.
  Interval interval() const;

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  // of the deviations from the mean
};

/// The interval of a `RunningMean` of these numbers.
Interval mean_interval(std::span<const double> numbers);

}  // namespace sigmax
