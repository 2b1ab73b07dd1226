#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include <sigmax/recognition/classifier.hpp>
#include <sigmax/recognition/decision.hpp>

namespace sigmax {

/// What one finding says of a pattern, and against its rival: one row of a table that explains a decision.
struct Contribution {
  std::size_t report;     ///< number of the report, from 0
  std::size_t feature;    ///< number of the feature in the classifier
  std::string reading;    ///< label of the crisp reading; empty if the finding was graded
  std::size_t value;      ///< value f of the feature by which the pattern explains it best; the first on a tie
  double share;           ///< L(z|f) L(f|c) of that value in their ⊕: one where max selects it, else part of a sum
  double log_likelihood;  ///< log L(z|c) of the pattern
  double rival_log_likelihood;  ///< and of the rival
  double log_ratio;      ///< how much the finding speaks for the pattern, forgetting included; ±∞ if it excludes one
  std::string equation;  ///< how `log_likelihood` came about, with its numbers
};

/// Why a pattern is preferred to a rival: the prior and the findings, whose logarithms of ratios add up.
struct PatternExplanation {
  std::size_t pattern;
  std::size_t rival;
  double log_prior;                         ///< of the pattern
  double rival_log_prior;                   ///< and of the rival
  double log_prior_ratio;                   ///< what is left of their ratio, forgetting included
  std::vector<Contribution> contributions;  ///< in the order of reports and features; missing findings have none

  /// log b(pattern)/b(rival): the sum of all; ±∞ if a finding excludes one of them, zero if both are excluded.
  double log_ratio() const {
    double sum = log_prior_ratio;
    bool pattern_excluded = log_prior == log_zero, rival_excluded = rival_log_prior == log_zero;
    for (const Contribution& each : contributions) {
      pattern_excluded = pattern_excluded || each.log_likelihood == log_zero;
      rival_excluded = rival_excluded || each.rival_log_likelihood == log_zero;
      sum += std::isfinite(each.log_ratio) ? each.log_ratio : 0.0;
    }
    if (pattern_excluded || rival_excluded)
      return pattern_excluded && rival_excluded ? 0.0 : (pattern_excluded ? log_zero : -log_zero);
    return sum;
  }
};

namespace detail {

/// log a − log b, zero where both are excluded.
inline double log_ratio_of(double log_a, double log_b) { return log_a == log_b ? 0.0 : log_a - log_b; }

/// The equation by which a pattern explains a finding, with its numbers and the value f that they are of; `reading` is
/// empty if the finding is graded.
template <Uncertainty Pattern, Uncertainty Feature>
std::string equation_of(const FeatureModel<Pattern, Feature>& feature, const std::string& reading,
                        const Likelihood<Feature>& evidence, double likelihood, std::size_t pattern,
                        std::size_t value) {
  constexpr bool selects = SelectiveAlgebra<AlgebraOf<Feature>>;
  const std::string& f = feature.feature().name();
  const std::string relation = selects ? "π(" : "p(";
  const std::string given = "|" + feature.pattern().name() + " = " + feature.pattern().label(pattern) + ")";
  const std::string at = f + " = " + feature.feature().label(value);
  std::ostringstream text;
  text.precision(4);
  if (!reading.empty() && !feature.has_sensor()) {
    text << relation << at << given << " = " << likelihood;
    return text.str();
  }
  const std::string read =
      reading.empty() ? "L(report"
                      : std::string(feature.reading_symbol()) + "(" + feature.readings().name() + " = " + reading;
  text << read << given << " = " << (selects ? "max" : "sum") << " over " << f << " of " << read << "|" << f << ") "
       << relation << f << given << " = " << likelihood << "; " << at << ": " << evidence[value] << " · "
       << feature.relation()(pattern, value);
  return text.str();
}

}  // namespace detail

/// What one feature's finding says of a pattern, and against its rival.
///
/// The value is the one for which L(z|f) ⊗ L(f|c) is greatest, of those within `tie_tolerance` the first. Max
/// inference, (45), (17), selects it, and it alone counts; sigma inference, (42), (18), adds all, and `share` tells how
/// much of the sum it is.
template <Uncertainty Pattern, Uncertainty Feature>
Contribution contribution(const FeatureModel<Pattern, Feature>& feature, const Finding<Feature>& finding,
                          std::size_t pattern, std::size_t rival) {
  const auto* const reading = std::get_if<Reading>(&finding);
  const Likelihood<Feature> evidence =
      reading ? feature.evidence(reading->index) : std::get<Likelihood<Feature>>(finding);
  const Likelihood<Pattern> likelihood = compose(evidence, feature.relation());

  std::vector<double> terms(feature.feature().size());
  for (std::size_t f = 0; f < terms.size(); ++f) terms[f] = evidence.log(f) + std::log(feature.relation()(pattern, f));
  const std::size_t value = first_of_tied(terms);

  Contribution result{};
  result.reading = reading ? reading->variable.label(reading->index) : "";
  result.value = value;
  result.share = terms[value] == log_zero ? 0.0 : std::exp(terms[value] - likelihood.log(pattern));
  result.log_likelihood = likelihood.log(pattern);
  result.rival_log_likelihood = likelihood.log(rival);
  result.log_ratio = detail::log_ratio_of(result.log_likelihood, result.rival_log_likelihood);
  result.equation = detail::equation_of(feature, result.reading, evidence, likelihood[pattern], pattern, value);
  return result;
}

/// Why a classifier that observed these reports, each with this forgetting factor, prefers `pattern` to `rival`, report
/// by report and feature by feature.
///
///     const auto best = best_patterns(belief, 2);
///     for (const auto& row : explain(classifier, reports, best[0], best[1]).contributions) …
///
/// Throws std::invalid_argument as `observe` does, or if there is no such pattern.
template <Uncertainty Pattern, Uncertainty Feature>
PatternExplanation explain(const Classifier<Pattern, Feature>& classifier, std::span<const Report<Feature>> reports,
                           std::size_t pattern, std::size_t rival, double forgetting = 1.0) {
  classifier.prior().variable().label(pattern);
  classifier.prior().variable().label(rival);
  const double log_prior = std::log(classifier.prior()[pattern]);
  const double rival_log_prior = std::log(classifier.prior()[rival]);
  const auto weight = [&](std::size_t report) {  // of what was said before the reports after it
    return std::pow(forgetting, static_cast<double>(reports.size() - report));
  };
  const auto left = [&](double log_ratio, std::size_t report) {
    return std::isfinite(log_ratio) ? weight(report) * log_ratio : log_ratio;
  };
  PatternExplanation result{
      pattern, rival, log_prior, rival_log_prior, left(detail::log_ratio_of(log_prior, rival_log_prior), 0), {}};
  for (std::size_t k = 0; k < reports.size(); ++k) {
    const auto places = classifier.places(reports[k]);
    for (std::size_t i = 0; i < places.size(); ++i) {
      Contribution each = contribution(classifier.features()[places[i]], reports[k][i], pattern, rival);
      each.report = k;
      each.feature = places[i];
      each.log_ratio = left(each.log_ratio, k + 1);
      result.contributions.push_back(std::move(each));
    }
  }
  return result;
}

/// The same of a single report.
template <Uncertainty Pattern, Uncertainty Feature>
PatternExplanation explain(const Classifier<Pattern, Feature>& classifier, const Report<Feature>& report,
                           std::size_t pattern, std::size_t rival) {
  return explain(classifier, std::span(&report, 1), pattern, rival);
}

}  // namespace sigmax
