#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "himm_demo/sweep_world.hpp"

namespace sigmax::apps {

/// What was found of all filters in all conditions.
struct Findings {
  const SweepWorld& world;
  std::vector<std::vector<Tuned>> tuned;  ///< by condition and filter
  std::optional<std::size_t> imm;         ///< its place among the filters

  /// The fuzzy interacting filter whose score on the tuning runs is the least: what is called HIMM below.
  std::optional<std::size_t> himm(std::size_t condition) const;

  /// Whether it is a fuzzy interacting filter.
  bool is_himm(std::size_t f) const;

  /// By how much the score is above that of the tuned IMM, relatively; one of as many intervals as there are
  /// conditions.
  Interval against_imm(std::size_t condition, std::size_t f) const;

  /// The settings that were chosen.
  FilterSettings settings(std::size_t condition, std::size_t f) const;

  /// Whether the search ended where it was not allowed to go on.
  bool at_the_limit(std::size_t condition, std::size_t f) const;

  std::size_t conditions() const { return world.conditions().size(); }
  std::size_t filters() const { return world.filters().size(); }
};

Findings findings_of(const SweepWorld& world, const CellRows& rows);

/// "1, strength ×0.5".
std::string words_of(const SweepCondition& condition);

/// "zero", as a setting has it.
const char* name_of(Lift lift);

/// Whether zero is outside of it.
inline bool sure(const Interval& interval) { return interval.above_zero() || interval.below_zero(); }

/// HIMM against the tuned IMM in words.
std::string answer(const Findings& findings);

/// How many settings were tried, and by how many runs.
std::string searched(const Findings& findings);

/// How many of the tuned filters are at the limit of the search; empty if none is.
std::string limits(const Findings& findings);

}  // namespace sigmax::apps
