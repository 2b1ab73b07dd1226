#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/estimation/chi_square.hpp>

#include "himm_demo/tune_losses.hpp"

namespace sigmax::apps {

/// The innovations of some rows, in their own standard deviations. If the filter is right, each of their numbers has
/// mean square 1 and is independent of the one before.
class InnovationTally {
 public:
  /// `before` is that of the last row of the same sensor and track, or null.
  void add(const std::vector<double>& innovation, const std::vector<double>* before);

  std::size_t rows() const { return rows_; }

  /// The NIS for each measured quantity: 1 is right.
  double mean_square() const { return squares_ / static_cast<double>(numbers_); }
  /// Where 95 % of the right filters have it.
  Band band() const;

  /// The correlation of neighbours.
  double autocorrelation() const { return products_ / squares_; }
  /// Of 95 % of the right filters the autocorrelation is not farther than this from 0.
  double autocorrelation_band() const;

 private:
  std::size_t rows_ = 0;
  std::size_t numbers_ = 0;
  std::size_t pairs_ = 0;
  double squares_ = 0.0;
  double products_ = 0.0;
};

/// What one filter's innovations say of its settings.
struct Diagnosis {
  struct Part {
    std::string name;
    InnovationTally innovations;
    double weight = 0.0;  ///< mean, of a mode
  };
  std::vector<Part> sensors;
  std::vector<Part> modes;  ///< rows of which the mode is the most likely
  Losses losses;
  std::optional<double> rmse_m;  ///< where the truth is known

  /// What is wrong with a sensor, and what to do, in words.
  static std::string verdict(const InnovationTally& sensor);
  /// The same of all: sentences.
  std::vector<std::string> advice() const;
};

/// Follows every track with these settings. Throws InputError where the filter fails.
Diagnosis diagnose(const TuneData& data, const FilterSettings& settings, Objective objective);

}  // namespace sigmax::apps
