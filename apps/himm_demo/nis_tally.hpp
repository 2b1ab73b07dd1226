#pragma once

#include <cmath>
#include <cstddef>
#include <map>

namespace sigmax::apps {

/// The normalised innovations squared of many rows, in memory that does not grow with the rows.
class NisTally {
 public:
  /// `usual` is the number below which 95 % of them should be.
  void add(double nis, double usual) {
    ++count_;
    sum_ += nis;
    if (nis <= usual) ++inside_;
    ++bins_[nis > 0.0 ? static_cast<int>(std::floor(bins_per_octave * std::log2(nis))) : least];
  }

  std::size_t count() const { return count_; }
  double mean() const { return sum_ / static_cast<double>(count_); }
  /// The share below `usual`.
  double inside() const { return static_cast<double>(inside_) / static_cast<double>(count_); }
  /// To 0.1 %.
  double median() const {
    std::size_t below = 0;
    for (const auto& [bin, count] : bins_)
      if (2 * (below += count) >= count_) return bin == least ? 0.0 : std::exp2((bin + 0.5) / bins_per_octave);
    return 0.0;
  }

 private:
  static constexpr double bins_per_octave = 512.0;
  static constexpr int least = -10000000;
  std::size_t count_ = 0;
  double sum_ = 0.0;
  std::size_t inside_ = 0;
  std::map<int, std::size_t> bins_;
};

}  // namespace sigmax::apps
