#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/hybrid/estimates.hpp>

namespace sigmax {

/// One history of the mode, r_1 … r_k: how it ends, where it comes from, and how possible or probable it is.
struct History {
  std::size_t mode = 0;
  std::size_t parent = 0;        ///< its place among the histories of the step before
  double log_weight = log_zero;  ///< of all histories the ⊕ is one
};

/// The first of the greatest weight, of all or of those that end in this mode; how many there are if none does.
std::size_t best_of(std::span<const History> histories, std::optional<std::size_t> mode = {});

/// The histories that a HistoryFilter keeps, each with the estimate of the state if it is true.
class HistorySet {
 public:
  HistorySet() = default;
  /// Room for so many histories of these models; it starts with one for each mode.
  HistorySet(const Estimates& starts, std::size_t room);

  std::size_t size() const { return size_; }
  std::size_t room() const { return histories_.size(); }
  void resize(std::size_t size) { size_ = size; }

  History& operator[](std::size_t h) { return histories_[h]; }
  const History& operator[](std::size_t h) const { return histories_[h]; }

  std::span<const History> all() const { return {histories_.data(), size_}; }

  /// @{
  /// The estimate of a history, in the components of its last mode.
  detail::ConstView view(std::size_t h) const {
    const double* const at = numbers_.data() + h * stride_;
    const int n = sizes_[histories_[h].mode];
    return {at, at + n, n};
  }
  detail::View view(std::size_t h) {
    double* const at = numbers_.data() + h * stride_;
    const int n = sizes_[histories_[h].mode];
    return {at, at + n, n};
  }
  /// @}

 private:
  std::vector<History> histories_;
  std::vector<int> sizes_;  ///< of each mode's estimates
  std::size_t stride_ = 0;
  std::vector<double> numbers_;
  std::size_t size_ = 0;
};

}  // namespace sigmax
