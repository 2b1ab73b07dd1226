#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "himm_demo/reproduce_world.hpp"
#include "himm_demo/sentences.hpp"

namespace sigmax::apps {

/// What runs say of a region in which a figure should lie: its whole interval does, or none of it does, or neither.
enum class Finding { inside, outside, open };

/// One figure of a sentence, measured. The intervals of all figures of one sentence hold together with 95 %.
struct Measured {
  const Statement* statement;
  std::optional<std::size_t> phase;
  std::optional<std::size_t> axis;
  Interval interval;
  Finding finding;
};

/// Which filters a sentence is read of.
struct Cast {
  std::string_view reading;  ///< of (57), for HIMM
  bool released_imm;         ///< the authors' program's IMM rather than the correct one

  std::string filter(Actor subject) const;
};

/// All figures of a sentence. `conditions` are those of one preset.
std::vector<Measured> measure(const Sentence& sentence, const std::vector<const Condition*>& conditions,
                              const Cast& cast);

enum class Verdict { holds, only_against_released, does_not_hold, undecided };

/// A sentence holds if all its figures are inside their regions, and does not if one is outside. Of two accounts,
/// against the correct and the released IMM, the first decides, unless only the second holds.
Verdict verdict(const std::vector<Measured>& against_correct, const std::vector<Measured>& against_released);

std::string_view words_of(Verdict verdict);
std::string_view letter_of(Verdict verdict);

}  // namespace sigmax::apps
