#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "himm_demo/filters/settings.hpp"
#include "himm_demo/scenario.hpp"
#include "himm_demo/sweep_lattice.hpp"
#include "support/campaign.hpp"
#include "support/statistic.hpp"

namespace sigmax::apps {

/// What decides every figure of `himm_demo sweep`.
struct SweepChoice {
  std::vector<int> scenarios = {1, 2};
  std::vector<double> mismatch = {0.5, 1.0, 2.0};  ///< of the radar's noise: believed over true
  std::vector<double> period = {0.5, 1.0, 2.0};    ///< of sampling, times the paper's
  std::vector<double> strength = {0.25, 0.5, 1.0, 2.0};
  std::vector<double> length = {0.5, 1.0, 2.0};
  bool cross = false;  ///< every combination of these rather than each alone, the others being 1
  std::vector<std::string> filters = {"imm",           "himm_selected", "himm_own", "himm_own_recentred",
                                      "himm_released", "gpb2",          "viterbi"};
  std::vector<double> probability = {0.02, 0.05, 0.15};  ///< the off-diagonals of P, each row apart
  std::vector<double> possibility = {0.05, 0.2, 0.5};    ///< the same of Π
  std::vector<double> sigma_w = {1.0, 3.0, 9.0};         ///< of each model apart
  std::vector<std::string> lifts = {"zero", "borrowed_variance", "unbiased"};
  int beyond = 6;  ///< steps by which the search may leave a list of numbers, at each end
  int tuning_runs = 20;
  int runs = 100;
  std::uint64_t seed = 1;
};

/// One situation in which filters are compared, as multiples of the paper's.
struct SweepCondition {
  int scenario;
  double mismatch = 1.0, period = 1.0, strength = 1.0, length = 1.0;

  bool operator==(const SweepCondition&) const = default;
};

/// What a tuned filter did on runs that it was not tuned on.
struct Tuned {
  BestPlace best;   ///< on the lattice of the filter, by the tuning runs
  Statistic score;  ///< the mean over axes and phases of RMSE over that of the measurement
};

/// All conditions and all settings.
class SweepWorld {
 public:
  /// Throws InputError for a filter that there is not.
  explicit SweepWorld(const SweepChoice& choice);

  const SweepChoice& choice() const { return choice_; }
  const std::vector<SweepCondition>& conditions() const { return conditions_; }
  const std::vector<FilterSettings>& filters() const { return filters_; }

  /// The settings that may be tried of a filter, the same in all conditions.
  SweepLattice lattice(std::size_t filter) const;

  /// The settings of a filter at a place of its lattice, in a condition.
  FilterSettings settings(std::size_t filter, std::size_t condition, const SweepLattice::Place& place) const;

  /// Tunes a filter in a condition and judges it on other runs. A cell is condition · filters + filter.
  Campaign campaign() const;

  Tuned tuned(const CellRows& rows, std::size_t condition, std::size_t filter) const;

 private:
  std::vector<double> work(std::size_t cell) const;
  BestPlace tune(std::size_t filter, std::size_t condition) const;
  Recording recording(std::size_t condition, std::uint64_t number) const;

  SweepChoice choice_;
  std::vector<SweepCondition> conditions_;
  std::vector<FilterSettings> filters_;
};

/// The scenario of the paper with another sampling period, and a manoeuvre of another strength and length.
Scenario scenario_of(const SweepCondition& condition);

}  // namespace sigmax::apps
