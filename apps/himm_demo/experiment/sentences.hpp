#pragma once

#include <sigmax/core/mean_interval.hpp>

#include "himm_demo/filters/settings.hpp"

namespace sigmax::apps {

/// Of whom a sentence of section VI speaks.
enum class Actor {
  himm,
  himm_wide,  ///< with σ_w = 5
  imm,
  imm_most_likely,  ///< its output is that of the most probable model
  measurement,
  nobody
};

/// Of what it speaks. Where the sentence compares two, it is the first's figure relative to the second's.
enum class FigureOf {
  rmse,                ///< by axis and phase: relative difference
  onset_rmse,          ///< of z, the ten samples from the onset on relative to the ten before
  cross_time,          ///< mean of the runs, in samples
  cross_time_curves,   ///< of the averaged curves, in samples
  lead,                ///< share of the samples of a phase in which the manoeuvre model has the greatest weight
  switches,            ///< of the leading model, per run and phase
  switches_of_the_run  ///< in all phases together
};

/// Where a figure must lie for the sentence to hold.
struct Region {
  double above = -infinity, below = infinity;
};

/// What runs say of a region in which a figure should lie: its whole interval does, or none of it does, or neither.
enum class Finding { inside, outside, open };

Finding finding_of(const Interval& interval, const Region& region);

/// A part of a sentence that can be measured.
struct Statement {
  FigureOf figure;
  Actor of, against;
  int scenario, group;
  std::vector<std::size_t> phases;  ///< 0: before, 1: during, 2: after the manoeuvre
  Region region;
};

/// A sentence of section VI of the paper.
struct Sentence {
  std::string place;
  std::string words{};
  std::vector<Statement> statements{};
};

/// Differences of less than a tenth of the reference are called competitive here.
inline constexpr double competitive_fraction = 0.1;

/// What sections VI.D and VI.E say that can be checked, in the order of the paper.
const std::vector<Sentence>& sentences();

/// Where they have the relative difference of RMSE, HIMM against IMM, in a phase of a scenario and group, all counted
/// from 1 but the phase; and the word for it: "better", "worse" or "competitive".
Region claim_of(int scenario, int group, std::size_t phase);
std::string_view word_of(const Region& claim);

/// Whether the differences by axis are there, in m; the RMSE of the reference tells what is competitive, of the means.
std::string verdict(const Region& claim, const std::array<Interval, 3>& difference,
                    const std::array<double, 3>& reference);

/// Whether the paper's claims are about these two: HIMM against IMM.
bool judged(const FilterSettings& filter, const FilterSettings& reference);

/// The cross-time that the paper prints for such a filter, if it has it.
std::optional<double> paper_cross_time(int scenario, int group, const FilterSettings& filter);

}  // namespace sigmax::apps
