#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <sigmax/core/mean_interval.hpp>

namespace sigmax::apps {

/// A smooth function of means over independent batches of runs, with its first-order change with each batch (the delta
/// method). Statistics of the same batches are paired: what they share cancels.
///
///     const Statistic imm = sqrt(Statistic::mean(imm_squares, runs));    // sums and counts, by batch
///     const Statistic himm = sqrt(Statistic::mean(himm_squares, runs));
///     (himm / imm - 1.0).interval(9);   // one of nine intervals that hold together with 95 %
class Statistic {
 public:
  /// Σ sums / Σ counts; NaN without counts.
  static Statistic mean(std::span<const double> sums, std::span<const double> counts);

  double value() const { return value_; }

  /// @{
  /// All that it knows, as numbers in a row, and out of them again.
  std::vector<double> numbers() const;
  static Statistic of(std::span<const double> numbers);
  /// @}

  /// value ± t s/√B over B batches, by Student's t with B − 1 degrees of freedom and Bonferroni's share of the 5 % for
  /// one of so many intervals that hold together. Without a second batch the half width is infinite.
  Interval interval(std::size_t together = 1) const;

  friend Statistic sqrt(const Statistic& a) {
    const double root = std::sqrt(a.value_);
    return combined(root, a, root > 0.0 ? 0.5 / root : 0.0, a, 0.0);
  }
  friend Statistic operator+(const Statistic& a, const Statistic& b) {
    return combined(a.value_ + b.value_, a, 1.0, b, 1.0);
  }
  friend Statistic operator-(const Statistic& a, const Statistic& b) {
    return combined(a.value_ - b.value_, a, 1.0, b, -1.0);
  }
  friend Statistic operator/(const Statistic& a, const Statistic& b) {
    return combined(a.value_ / b.value_, a, 1.0 / b.value_, b, -a.value_ / (b.value_ * b.value_));
  }
  friend Statistic operator+(const Statistic& a, double b) { return combined(a.value_ + b, a, 1.0, a, 0.0); }
  friend Statistic operator-(const Statistic& a, double b) { return a + -b; }
  friend Statistic operator*(const Statistic& a, double b) { return combined(a.value_ * b, a, b, a, 0.0); }

 private:
  /// A function of two with its derivatives.
  static Statistic combined(double value, const Statistic& a, double by_a, const Statistic& b, double by_b) {
    Statistic result;
    result.value_ = value;
    result.change_.resize(a.change_.size());
    for (std::size_t i = 0; i < a.change_.size(); ++i)
      result.change_[i] = by_a * a.change_[i] + (by_b != 0.0 ? by_b * b.change_[i] : 0.0);
    return result;
  }

  double value_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> change_;  // by batch; their mean is 0
};

}  // namespace sigmax::apps
