#include "recognition_demo/contest.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <sigmax/core/compose.hpp>
#include <sigmax/recognition/decision.hpp>

#include "support/parallel.hpp"

namespace sigmax::apps {
namespace {

template <class Kind>
void observe(Classifier<Kind, Kind>& classifier, const Readings& report) {
  classifier.observe(report);
}
template <class Kind>
void observe(Classifier<Kind, Kind>& classifier, const GradedReport& report) {
  Likelihood<Kind> likelihood{classifier.features().front().feature()};
  for (std::size_t f = 0; f < report.size(); ++f) likelihood.set_log(f, report[f]);
  classifier.observe(likelihood);
}

/// Logarithms of the belief in the patterns, and the belief itself.
template <class Kind>
Belief<Kind> belief_in_patterns(const Contestant& contestant, const Classifier<Kind, Kind>& classifier) {
  if constexpr (std::is_same_v<Kind, Random>)
    if (contestant.pattern_given_state)
      return Belief<Random>{compose(*contestant.pattern_given_state, classifier.belief())};
  return classifier.log_belief();
}

template <class Reports>
Trace follow_reports(const Contestant& contestant, std::size_t truth, const Reports& reports) {
  return std::visit(
      [&](auto classifier) {
        Trace trace;
        for (const auto& report : reports) {
          try {
            observe(classifier, report);
          } catch (const std::domain_error&) {
            ++trace.refused;
          }
          trace.credit.push_back(credit_of(belief_in_patterns(contestant, classifier).logs(), truth));
        }
        const auto belief = belief_in_patterns(contestant, classifier).distribution();
        trace.belief.assign(belief.values().begin(), belief.values().end());
        return trace;
      },
      contestant.classifier);
}

bool is_fuzzy(const Contestant& contestant) { return std::holds_alternative<MaxClassifier>(contestant.classifier); }

}  // namespace

double credit_of(std::span<const double> logs, std::size_t truth) {
  const double greatest = *std::max_element(logs.begin(), logs.end());
  if (!ties(logs[truth], greatest)) return 0.0;
  const auto tied = std::count_if(logs.begin(), logs.end(), [greatest](double log) { return ties(log, greatest); });
  return 1.0 / static_cast<double>(tied);
}

Trace follow(const Contestant& contestant, std::size_t truth, const std::vector<Readings>& reports) {
  return follow_reports(contestant, truth, reports);
}

Trace follow(const Contestant& contestant, std::size_t truth, const std::vector<GradedReport>& reports) {
  return follow_reports(contestant, truth, reports);
}

std::vector<Score> score(const std::vector<Contestant>& contestants, std::size_t runs, int threads,
                         const std::function<RunTraces(std::size_t run)>& trace,
                         const std::function<void(std::size_t run, const RunTraces& traces)>& see) {
  std::vector<Score> scores(contestants.size());
  for (std::size_t i = 0; i < scores.size(); ++i) {
    scores[i].name = contestants[i].name;
    scores[i].fuzzy = is_fuzzy(contestants[i]);
  }
  for_each_run(runs, threads, trace, [&](std::size_t run, const RunTraces& result) {
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const Trace& one = result.traces[i];
      Score& all = scores[i];
      all.accuracy.resize(one.credit.size(), 0.0);
      for (std::size_t k = 0; k < one.credit.size(); ++k) all.accuracy[k] += one.credit[k];
      all.final_credits.push_back(one.credit.back());
      all.belief_in_truth += one.belief[result.truth];
      double others = 0.0;
      for (std::size_t c = 0; c < one.belief.size(); ++c)
        if (c != result.truth) others = std::max(others, one.belief[c]);
      all.necessity_of_truth += 1.0 - others;
      if (one.credit.back() > 0.0 && one.credit.back() < 1.0) all.ties += 1.0;
      all.refused += one.refused;
    }
    see(run, result);
  });
  const auto n = static_cast<double>(runs);
  for (Score& all : scores) {
    for (double& value : all.accuracy) value /= n;
    all.belief_in_truth /= n;
    all.necessity_of_truth /= n;
    all.ties /= n;
  }
  return scores;
}

Interval paired_difference(const Score& a, const Score& b) { return paired_interval(a.final_credits, b.final_credits); }

std::string points(const Interval& difference) {
  return fmt::format("{:+.2f} ± {:.2f}", 100.0 * difference.mean, 100.0 * difference.half_width);
}

std::string percent(double share) { return fmt::format("{:.1f}", 100.0 * share); }

}  // namespace sigmax::apps
