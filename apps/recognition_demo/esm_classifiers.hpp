#pragma once

#include <vector>

#include "recognition_demo/contest.hpp"
#include "recognition_demo/esm_world.hpp"

namespace sigmax::apps {

/// Sigma inference, (41)–(43): p(z|c) = Σ p(z|f) p(f|c).
Contestant sigma_contestant(std::string name, const Relation<Random, Random>& emitter_given_platform,
                            const std::vector<Relation<Random, Random>>& sensors);

/// Max inference, (44)–(46): π(z|c) = max π(z|f) π(f|c).
Contestant max_contestant(std::string name, const Relation<Fuzzy, Fuzzy>& emitter_given_platform,
                          const std::vector<Relation<Fuzzy, Fuzzy>>& sensors);

/// Sigma-max inference, (17) without β and (19): p⁺(z|c) = max p(z|f) π(f|c).
Contestant sigma_max_contestant(std::string name, const Relation<Fuzzy, Fuzzy>& emitter_given_platform,
                                const std::vector<Relation<Random, Random>>& sensors);

/// The other mixture, (18) without β and (20): π⁺(z|c) = Σ π(z|f) p(f|c).
Contestant max_sigma_contestant(std::string name, const Relation<Random, Random>& emitter_given_platform,
                                const std::vector<Relation<Fuzzy, Fuzzy>>& sensors);

/// Sigma inference that knows how usages are drawn and averages over them: its patterns are usages, a grid of equal
/// probability for Dirichlet(α). The reference: nothing can be better but by what the grid leaves out.
Contestant usage_aware_contestant(std::string name, const EsmWorld& world, const Usage& usage,
                                  const std::vector<Relation<Random, Random>>& sensors);

}  // namespace sigmax::apps
