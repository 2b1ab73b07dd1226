#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/core/choices.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax {

/// What may be left out, or approximated.
struct MatchingOptions {
  /// How many states a cluster of rows may need, all its rows together, before its marginals are approximated.
  std::size_t max_states = 100'000;

  /// Whether the marginals of a fuzzy pattern with a fuzzy permutation are computed: a shortest-path search a row.
  bool marginals = true;
};

/// What all events together say of rows and columns. An event gives each row a column or none, and no column twice; its
/// weight is the product of the weights of what its rows take.
struct Matching {
  double log_total;   ///< the logarithm of the ⊕ of the weights of all events
  Choices marginals;  ///< for each choice of a row its logarithm, normalised by the row's own ⊕; may be left empty
  std::vector<std::size_t> winners;  ///< of each row the choice of greatest marginal, `no_column` among them
  std::vector<std::size_t> best;     ///< the event of greatest weight, a choice for each row
  double log_best;                   ///< the logarithm of its weight
  bool exact;                        ///< false if a cluster had too many states
};

namespace detail {

Matching match(const Choices& log_weights, const AnyAlgebra& pattern, const AnyAlgebra& permutation,
               const MatchingOptions& options);

}  // namespace detail

/// Marginals of all events between rows (targets) and columns (detections), whose log weights are ratios to clutter.
/// The *pattern* of an event is which rows are detected and which columns are used (φ and ψ of Blom and Bloem, IEEE
/// Trans. AC 45, 2000); its *permutation* is which column belongs to which row. The permutation is eliminated first:
///
///     pattern   permutation   known as   marginal of row i and column j
///     random    random        JPDA       the sum over all events with i → j
///     random    fuzzy         JPDA*      the sum over all patterns whose best event has i → j
///     fuzzy     fuzzy         GNN        the maximum over all events with i → j
///     fuzzy     random        –          the maximum over all patterns of the sum over their events with i → j
///
///     Choices log_weights;
///     log_weights.add_row(std::log(1 - P_D), {{0, std::log(P_D * density / clutter)}, …});   // a row for each target
///     const Matching events = match<Random, Random>(log_weights);
///     events.marginals.entries(0).value(0);                                                  // log β
///
/// −∞ (`log_zero`) excludes a choice: of no column it says that the row is detected for certain.
///
/// The result is exact: a forward–backward pass over the rows of each cluster of rows that share columns. A state is
/// the set of used columns that later rows want. Where the kinds differ it keeps the pattern as well, within cycles of
/// rows and columns; a cluster without cycles has one event for each pattern. Fuzzy with fuzzy is exact at any size:
/// the best event by successive shortest paths, max-marginals by shortest alternating paths.
///
/// A cluster that needs more than `max_states` is approximated, and `exact` is false. If the kinds differ, the ⊕ of the
/// pattern eliminates permutations as well. If a sum still takes too many states, messages are passed (Williams and
/// Lau, IEEE Trans. AES 50, 2014); on trees they are exact.
///
/// Events tie within `tie_tolerance`. The best event is the one that gives the first row the first column, then the
/// second row, and so on; no column comes last. Of events of one pattern that tie the best event counts, or else any
/// one. The winner of a row is its choice in the best event if that ties with the greatest marginal; otherwise the
/// first choice that ties.
///
/// Throws std::invalid_argument for NaN and +∞, std::domain_error, naming a row, if there is no event at all.
template <ScalableUncertainty Pattern, ScalableUncertainty Permutation>
Matching match(const Choices& log_weights, const MatchingOptions& options = {}) {
  return detail::match(log_weights, detail::algebra_of<Pattern>(), detail::algebra_of<Permutation>(), options);
}

}  // namespace sigmax
