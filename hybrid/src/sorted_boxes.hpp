#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sigmax::detail {

/// Where something may be: within `half` of `at`, along each axis.
struct Box {
  std::array<double, 3> at{}, half{};

  bool overlaps(const Box& other) const {
    for (std::size_t axis = 0; axis < at.size(); ++axis)
      if (std::abs(at[axis] - other.at[axis]) > half[axis] + other.half[axis]) return false;
    return true;
  }
};

/// Finds the boxes that overlap another, without looking at all: sorted along x, but for boxes that have no end there.
class SortedBoxes {
 public:
  void assign(std::vector<Box> boxes) {
    boxes_ = std::move(boxes);
    sorted_.clear();
    endless_.clear();
    reach_ = 0.0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const bool ends = std::isfinite(boxes_[i].half[0]);
      (ends ? sorted_ : endless_).push_back(i);
      if (ends) reach_ = std::max(reach_, boxes_[i].half[0]);
    }
    std::ranges::sort(sorted_, {}, [this](std::size_t i) { return boxes_[i].at[0]; });
  }

  /// Writes the numbers of those that overlap, ascending.
  void overlapping(const Box& box, std::vector<std::size_t>& found) const {
    found.clear();
    const double reach = box.half[0] + reach_;
    const auto from =
        std::ranges::lower_bound(sorted_, box.at[0] - reach, {}, [this](auto i) { return boxes_[i].at[0]; });
    for (auto k = from; k != sorted_.end() && boxes_[*k].at[0] <= box.at[0] + reach; ++k)
      if (boxes_[*k].overlaps(box)) found.push_back(*k);
    for (const std::size_t i : endless_)
      if (boxes_[i].overlaps(box)) found.push_back(i);
    std::ranges::sort(found);
  }

 private:
  std::vector<Box> boxes_;
  std::vector<std::size_t> sorted_, endless_;
  double reach_ = 0.0;  ///< half the length of the longest box that is sorted
};

}  // namespace sigmax::detail
