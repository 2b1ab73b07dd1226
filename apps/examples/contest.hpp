#pragma once

#include <iomanip>
#include <iostream>

#include <sigmax/core/mean_interval.hpp>
#include <sigmax/recognition/decision.hpp>

namespace examples {

/// Shares of right decisions on the same reports, and how many points more than the first, ± 95 % by paired runs.
class Contest {
 public:
  /// Adds a run: the credit of each classifier, in the order of the names that `print` gets.
  void add(const std::vector<double>& credits) {
    right_.resize(credits.size());
    more_.resize(credits.size());
    for (std::size_t i = 0; i < credits.size(); ++i) {
      right_[i].add(credits[i]);
      more_[i].add(credits[i] - credits[0]);
    }
  }

  void print(std::string_view title, const std::vector<std::string_view>& names) const {
    std::cout << title << '\n' << std::fixed;
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::cout << "  " << std::left << std::setw(40) << names[i] << std::right << std::setprecision(1) << std::setw(5)
                << 100.0 * right_[i].mean() << " %";
      const double half_width = more_[i].interval().half_width;
      if (i > 0 && half_width > 0.0)  // else all runs are alike
        std::cout << std::showpos << std::setw(8) << 100.0 * more_[i].mean() << std::noshowpos << " ± "
                  << 100.0 * half_width << " points";
      std::cout << '\n';
    }
  }

 private:
  std::vector<sigmax::RunningMean> right_, more_;
};

}  // namespace examples
