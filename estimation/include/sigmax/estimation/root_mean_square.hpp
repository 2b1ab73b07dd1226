#pragma once

#include <cmath>
#include <cstddef>

namespace sigmax {

/// Root mean square of errors added one by one; 0 before the first.
class RootMeanSquare {
 public:
  void add(double error) { add_square(error * error); }
  void add_square(double square) {
    sum_ += square;
    ++count_;
  }
  std::size_t count() const { return count_; }
  double value() const { return count_ == 0 ? 0.0 : std::sqrt(sum_ / static_cast<double>(count_)); }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace sigmax
