#pragma once

#include "recognition_demo/emitters.hpp"

namespace sigmax::apps {

/// The names of the regimes: ways in which beliefs about the emitter world are wrong.
std::vector<std::string> regime_names();

/// Who does better in a regime, or in all of them: a table for each, and a verdict.
void run_regimes(const std::string& name_or_all, std::size_t reports, const DrawOptions& draws);

}  // namespace sigmax::apps
