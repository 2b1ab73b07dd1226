#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/core/logarithm.hpp>
#include <sigmax/core/uncertainty.hpp>
#include <sigmax/hybrid/bank.hpp>

namespace sigmax {

/// One history of the mode, r_1 … r_k: how it ends, where it comes from, and how possible or probable it is.
struct History {
  std::size_t mode = 0;
  std::size_t parent = 0;        ///< its place among the histories of the step before
  double log_weight = log_zero;  ///< of all histories the ⊕ is one
};

/// Where the histories of one step came from: what is kept of them to tell the best one from its beginning.
struct HistoryLinks {
  struct Link {
    std::size_t mode, parent;
  };
  std::vector<Link> all;  ///< in the order of the set
  std::size_t best = 0;
};

/// The histories that a HistoryFilter keeps, each with the estimate of the state if it is true: all that its next step
/// depends on.
template <class Models>
class HistorySet {
 public:
  using Estimates = typename Bank<Models>::Estimates;

  /// Room for so many histories; it starts with one for each mode.
  HistorySet(const Estimates& starts, std::size_t room) : histories_(room), estimates_(detail::pairs_for(starts)) {
    for_each_mode(starts, [&](auto j) { mode(estimates_, j).resize(room, mode(starts, j)); });
    resize(mode_count(starts));
  }
  HistorySet(const HistorySet&) = default;

  /// Copies what is there; allocates nothing if there is as much room.
  HistorySet& operator=(const HistorySet& other) {
    if (this == &other) return *this;
    histories_ = other.histories_;
    for_each_mode(estimates_, [&](auto j) { mode(estimates_, j).resize(room(), mode(other.estimates_, j).front()); });
    resize(other.size());
    most_likely_mode = other.most_likely_mode;
    for (std::size_t h = 0; h < size(); ++h)
      for_each_mode(estimates_, [&](auto j) {
        if (j == histories_[h].mode) mode(estimates_, j)[h] = mode(other.estimates_, j)[h];
      });
    return *this;
  }

  std::size_t size() const { return size_; }
  std::size_t room() const { return histories_.size(); }
  void resize(std::size_t size) { size_ = size; }

  History& operator[](std::size_t h) { return histories_[h]; }
  const History& operator[](std::size_t h) const { return histories_[h]; }

  /// The first of the greatest weight.
  std::size_t best() const {
    std::size_t best = 0;
    for (std::size_t h = 1; h < size(); ++h)
      if (histories_[h].log_weight > histories_[best].log_weight) best = h;
    return best;
  }

  HistoryLinks links() const {
    HistoryLinks links{{}, best()};
    for (std::size_t h = 0; h < size(); ++h) links.all.push_back({histories_[h].mode, histories_[h].parent});
    return links;
  }

  /// Of mode j, the estimates at the places of the histories that end in it; the others mean nothing.
  template <class Index>
  auto& estimates(Index j) {
    return mode(estimates_, j);
  }
  template <class Index>
  const auto& estimates(Index j) const {
    return mode(estimates_, j);
  }
  typename Bank<Models>::Pairs& estimates() { return estimates_; }

  std::size_t most_likely_mode = 0;  ///< where the output rule has broken ties

 private:
  std::vector<History> histories_;
  typename Bank<Models>::Pairs estimates_;
  std::size_t size_ = 0;
};

}  // namespace sigmax
