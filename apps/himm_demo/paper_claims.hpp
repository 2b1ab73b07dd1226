#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "himm_demo/experiment.hpp"
#include "himm_demo/filters/settings.hpp"
#include "himm_demo/sentences.hpp"

namespace sigmax::apps {

/// What section VI says of HIMM against IMM in a phase.
enum class Claim { better, worse, competitive };

std::string_view word(Claim claim);

/// The claim about a phase of scenario and group, all counted from 1 but the phase.
Claim claim_of(int scenario, int group, std::size_t phase);

/// The cross-time that the paper prints for such a filter, if it has it.
std::optional<double> paper_cross_time(int scenario, int group, const FilterSettings& filter);

/// What the paper's claims are about: HIMM against IMM.
bool judged(const FilterSettings& filter, const FilterSettings& reference);

/// Whether the paper's claim about a phase is what the runs show. `reference` is the RMSE of the reference by axis.
std::string verdict(Claim claim, const std::array<Interval, 3>& difference, const std::array<double, 3>& reference);

}  // namespace sigmax::apps
