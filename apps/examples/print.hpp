#pragma once

#include <cstddef>
#include <iomanip>
#include <iostream>
#include <span>
#include <string_view>
#include <vector>

#include <sigmax/core/mean_interval.hpp>
#include <sigmax/core/variable.hpp>

namespace examples {

/// Prints "  title           young 0.67   middle 1.00".
inline void print(std::string_view title, const sigmax::Outcomes& outcomes, std::span<const double> values) {
  std::cout << "  " << std::left << std::setw(30) << title << std::fixed << std::setprecision(3);
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    std::cout << (i == 0 ? "" : "   ") << outcomes.label(i) << ' ' << values[i];
  std::cout << '\n';
}

/// Of a distribution, or what is induced of one.
template <class T>
void print(std::string_view title, const T& distribution) {
  print(title, distribution.variable(), distribution.values());
}

/// Of a relation, or what is induced of one: a line for each outcome of its condition.
template <class T>
void print_rows(const T& relation) {
  for (std::size_t i = 0; i < relation.from().size(); ++i)
    print(relation.to().name() + " | " + relation.from().label(i), relation.to(), relation.row(i));
}

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
