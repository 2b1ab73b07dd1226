#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <sigmax/recognition/classifier.hpp>

namespace sigmax {

/// A pattern that no report can make the winner, and one that is always at least as good.
struct Dominance {
  std::size_t pattern;    ///< at best ties, and then loses the tie or draws even
  std::size_t dominator;  ///< is not dominated itself
  bool equal;             ///< whether both have the same numbers throughout, so that they always tie
};

namespace detail {

/// Whether `a` is at most `b` in the prior and in every number of every feature, hence after any reports.
template <Uncertainty Pattern, Uncertainty Feature>
bool never_exceeds(const Classifier<Pattern, Feature>& classifier, std::size_t a, std::size_t b) {
  if (classifier.prior()[a] > classifier.prior()[b]) return false;
  for (const auto& feature : classifier.features())
    for (std::size_t f = 0; f < feature.feature().size(); ++f)
      if (feature.relation()(a, f) > feature.relation()(b, f)) return false;
  return true;
}

}  // namespace detail

/// Patterns that a classifier can never prefer, found before any data is seen, in order; each with the first pattern
/// that dominates it and is not dominated itself.
///
/// What is listed can never win. What is not listed may still never win, because several patterns together stand above
/// it: of the possibilities (1, ½, 1), (½, 1, 1) and (0.7, 0.7, 1) the last is below the first or the second whatever
/// is read, but below neither of them always. An empty list is no promise.
///
/// c is dominated by c′ if L(f|c) ≤ L(f|c′) for every value f of every feature and its prior is no greater: then
/// L(z|c) ≤ L(z|c′) for every report, since ⊕ and ⊗ are monotone, and c at best ties. Nested 0/1 tables make such
/// patterns. Of patterns with the same numbers the first is not dominated by the others. The rows of p(f|c) sum to one,
/// so that a random feature dominates by equality only.
template <Uncertainty Pattern, Uncertainty Feature>
std::vector<Dominance> dominated_patterns(const Classifier<Pattern, Feature>& classifier) {
  const std::size_t n = classifier.prior().size();
  const auto dominates = [&](std::size_t b, std::size_t a) {
    return a != b && detail::never_exceeds(classifier, a, b) && (b < a || !detail::never_exceeds(classifier, b, a));
  };
  std::vector<std::vector<std::size_t>> dominators(n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      if (dominates(b, a)) dominators[a].push_back(b);
  std::vector<Dominance> result;
  for (std::size_t a = 0; a < n; ++a)
    for (const std::size_t b : dominators[a])
      if (dominators[b].empty()) {
        result.push_back({a, b, detail::never_exceeds(classifier, b, a)});
        break;
      }
  return result;
}

/// The same of one relation, all patterns being equally plausible or having the prior given.
///
///     dominated_patterns(manoeuvre_given_class)
template <Uncertainty Pattern, Uncertainty Feature>
std::vector<Dominance> dominated_patterns(const Relation<Feature, Pattern>& feature_given_pattern,
                                          const Distribution<Pattern>& prior) {
  return dominated_patterns(Classifier<Pattern, Feature>{prior, feature_given_pattern});
}
template <Uncertainty Pattern, Uncertainty Feature>
std::vector<Dominance> dominated_patterns(const Relation<Feature, Pattern>& feature_given_pattern) {
  return dominated_patterns(feature_given_pattern, uninformative(feature_given_pattern.from()));
}

}  // namespace sigmax
