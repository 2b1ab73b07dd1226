#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "himm_demo/tune_losses.hpp"

namespace sigmax::apps {

/// One fit: of these settings, to the rows that count. It draws no random numbers but those of the start.
class Fitter {
 public:
  /// Calls advance(work) as it goes.
  Fitter(const TuneData& data, const TuneOptions& options, Counts counts,
         const std::function<void(std::size_t)>& advance)
      : data_(data), options_(options), counts_(std::move(counts)), advance_(advance) {}

  struct Found {
    FilterSettings settings{};
    double value = std::numeric_limits<double>::infinity();  ///< of the objective
  };

  /// From far away: great steps, then a search from start number `start` about where they led.
  Found fit(const FilterSettings& settings, std::size_t start) const;

  /// From near by.
  Found refine(const FilterSettings& settings) const;

  /// So much work they are at most.
  static std::size_t work_of_fit(const FilterSettings& settings, const TuneData& data, const TuneOptions& options);
  static std::size_t work_of_refine(const FilterSettings& settings, const TuneData& data, const TuneOptions& options);

 private:
  double value(const FilterSettings& settings) const;
  bool take_if_better(Found& best, const FilterSettings& settings) const;
  bool improve(Found& best, std::size_t start, double step) const;
  void scan(Found& best) const;
  void search_numbers(Found& best, std::size_t start, double step) const;
  void learn_transition(Found& best) const;
  void try_lifts(Found& best) const;

  const TuneData& data_;
  const TuneOptions& options_;
  Counts counts_;
  const std::function<void(std::size_t)>& advance_;
};

}  // namespace sigmax::apps
