#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/experiment/figures.hpp"
#include "study/statistic.hpp"
#include "study/study.hpp"

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

/// Where settings of a filter are on its lattice: of four numbers, and of the lift.
using Place = std::array<std::size_t, 5>;
struct Axis;

/// The settings of a filter that did best on the tuning runs, and what they did on others.
struct Tuned {
  Place place;
  bool at_the_limit;    ///< whether the search for them ended where it was not allowed to go on
  double tuning_score;  ///< the mean over axes and phases of RMSE over that of the measurement
  std::size_t tried;    ///< how many settings were
  Statistic score;      ///< the same as the tuning score, of other runs
};

/// All conditions and filters, and what was found of them.
class SweepWorld {
 public:
  /// Throws InputError for a filter that there is not.
  explicit SweepWorld(const SweepChoice& choice);

  /// Tunes each filter in each condition and judges it on other runs. A cell is condition · filters + filter.
  Study study() const;
  void add(const Study::Row& row);  ///< of the next cell

  const SweepChoice& choice() const { return choice_; }
  const std::vector<SweepCondition>& conditions() const { return conditions_; }
  const std::vector<FilterSettings>& filters() const { return filters_; }
  const std::vector<Tuned>& all_tuned() const { return tuned_; }
  const Tuned& tuned(std::size_t condition, std::size_t f) const { return tuned_[condition * filters_.size() + f]; }

  /// How many settings are on the lists of a filter.
  std::size_t listed_settings(std::size_t f) const;

  /// The settings that were chosen.
  FilterSettings settings(std::size_t condition, std::size_t f) const {
    return settings(condition, f, tuned(condition, f).place);
  }

  /// The place of the IMM among the filters, and of the fuzzy interacting filter whose score on the tuning runs is the
  /// least: what is called HIMM.
  std::optional<std::size_t> imm() const;
  std::optional<std::size_t> himm(std::size_t condition) const;

  /// By how much the score is above that of the tuned IMM, relatively; one of as many intervals as there are
  /// conditions.
  Interval against_imm(std::size_t condition, std::size_t f) const;

 private:
  std::vector<Axis> lattice(std::size_t f) const;
  FilterSettings settings(std::size_t condition, std::size_t f, const Place& place) const;
  Recording recording(std::size_t condition, int number) const;
  std::vector<double> scores_of(std::size_t condition, std::size_t f, const std::vector<Place>& places) const;
  Study::Row work(std::size_t condition, std::size_t f) const;

  SweepChoice choice_;
  std::vector<SweepCondition> conditions_;
  std::vector<FilterSettings> filters_;
  std::vector<Tuned> tuned_;  // by condition and filter
};

/// The name of a lift in settings.
const char* name_of(Lift lift);

}  // namespace sigmax::apps
