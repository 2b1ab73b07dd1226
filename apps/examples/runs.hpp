#pragma once

#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <string_view>
#include <vector>

namespace examples {

/// A mean over independent runs, with the half width of its 95 % confidence interval.
class MeanOfRuns {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
    ++count_;
  }
  double mean() const { return sum_ / count_; }
  double half_width() const { return 1.96 * std::sqrt((squares_ / count_ - mean() * mean()) / (count_ - 1.0)); }

 private:
  double sum_ = 0.0, squares_ = 0.0, count_ = 0.0;
};

/// The root mean square errors of four estimates over many runs: what sums and what maxima make of the same
/// measurements.
class Study {
 public:
  using Track = std::vector<double>;

  /// Adds a run: the truth, one number or several a step, and the estimates.
  void add(const Track& truth, const std::vector<Track>& estimates) {
    for (std::size_t i = 0; i < estimates.size(); ++i) squares_[i].add(mean_square(estimates[i], truth));
    loss_.add(mean_square(estimates[2], truth) - mean_square(estimates[0], truth));
  }

  void print() const {
    const std::vector<std::string_view> names{"random: mean", "random: most probable", "fuzzy: mean of (35)",
                                              "fuzzy: most possible"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double root = std::sqrt(squares_[i].mean());
      print(names[i], root, squares_[i].half_width() / (2.0 * root));
    }
    print("mean square of mean, fuzzy less random", loss_.mean(), loss_.half_width());
  }

 private:
  static double mean_square(const Track& estimate, const Track& truth) {
    double sum = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) sum += (estimate[k] - truth[k]) * (estimate[k] - truth[k]);
    return sum / static_cast<double>(truth.size());
  }
  static void print(std::string_view title, double value, double half_width) {
    std::cout << "  " << std::left << std::setw(40) << title << std::fixed << std::setprecision(2) << value << " ± "
              << half_width << '\n';
  }

  std::vector<MeanOfRuns> squares_ = std::vector<MeanOfRuns>(4);
  MeanOfRuns loss_;
};

}  // namespace examples
