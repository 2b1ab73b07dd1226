#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "himm_demo/experiment/sentences.hpp"
#include "himm_demo/reproduce/conditions.hpp"

namespace sigmax::apps {

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

enum class Verdict { holds, only_against_released, does_not_hold, undecided };

/// One sentence under one preset and reading, against both IMMs.
struct Judged {
  std::vector<Measured> against_correct;
  std::vector<Measured> against_released;

  /// A sentence holds if all its figures are inside their regions, and does not if one is outside. The correct IMM
  /// decides, unless it holds only against the released one.
  Verdict verdict() const;
};

/// Everything that is judged, by preset, reading and sentence.
using Judgements = std::map<Preset, std::map<std::string_view, std::vector<Judged>>>;

/// Measures every sentence for every preset and reading.
Judgements judge(const std::vector<Condition>& conditions);

}  // namespace sigmax::apps
