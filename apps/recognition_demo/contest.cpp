#include "recognition_demo/contest.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <sigmax/core/compose.hpp>
#include <sigmax/recognition/decision.hpp>

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

/// Calls see(belief) after each report. What would exclude every pattern is passed over; returns how many reports were.
template <class Reports, class See>
std::size_t observe_all(const Contestant& contestant, const Reports& reports, const See& see) {
  std::size_t refused = 0;
  std::visit(
      [&](auto classifier) {
        classifier.reset();
        for (const auto& report : reports) {
          try {
            observe(classifier, report);
          } catch (const std::domain_error&) {
            ++refused;
          }
          see(belief_in_patterns(contestant, classifier));
        }
      },
      contestant.classifier);
  return refused;
}

template <class Kind>
std::vector<double> numbers_of(const Belief<Kind>& belief) {
  const auto distribution = belief.distribution();
  return {distribution.values().begin(), distribution.values().end()};
}

template <class Reports>
Trace follow_reports(const Contestant& contestant, std::size_t truth, const Reports& reports) {
  Trace trace;
  trace.refused = observe_all(contestant, reports, [&](const auto& belief) {
    trace.credit.push_back(credit_of(belief.logs(), truth));
    if (trace.credit.size() == reports.size()) trace.belief = numbers_of(belief);
  });
  return trace;
}

template <class Reports>
Beliefs beliefs_over_reports(const Contestant& contestant, const Reports& reports) {
  Beliefs beliefs;
  observe_all(contestant, reports, [&](const auto& belief) { beliefs.push_back(numbers_of(belief)); });
  return beliefs;
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

Beliefs beliefs_over(const Contestant& contestant, const std::vector<Readings>& reports) {
  return beliefs_over_reports(contestant, reports);
}

Beliefs beliefs_over(const Contestant& contestant, const std::vector<GradedReport>& reports) {
  return beliefs_over_reports(contestant, reports);
}

Scoreboard::Scoreboard(const std::vector<Contestant>& contestants) {
  for (const Contestant& contestant : contestants) {
    same_.emplace_back(sums_.size(), true);
    sums_.push_back(
        {.name = contestant.name, .fuzzy = is_fuzzy(contestant), .has_possibilities = contestant.has_possibilities});
  }
}

void Scoreboard::add(const RunTraces& run) {
  const auto last = [&](std::size_t i) { return run.traces[i].credit.back(); };
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Trace& trace = run.traces[i];
    Score& sum = sums_[i];
    sum.accuracy.resize(trace.credit.size(), 0.0);
    for (std::size_t k = 0; k < trace.credit.size(); ++k) sum.accuracy[k] += trace.credit[k];
    sum.minus_first.add(last(i) - last(0));
    sum.belief_in_truth += trace.belief[run.truth];
    sum.necessity_of_truth += 1.0 - greatest_other(trace.belief, run.truth);
    if (last(i) > 0.0 && last(i) < 1.0) sum.ties += 1.0;
    sum.refused += trace.refused;
    for (std::size_t j = 0; j < i; ++j)
      if (last(j) != last(i)) same_[i][j] = false;
  }
  ++runs_;
}

std::vector<Score> Scoreboard::scores() const {
  std::vector<Score> scores = sums_;
  const auto n = static_cast<double>(runs_);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    Score& score = scores[i];
    for (double& value : score.accuracy) value /= n;
    for (double* value : {&score.belief_in_truth, &score.necessity_of_truth, &score.ties}) *value /= n;
    score.same_as = static_cast<std::size_t>(std::find(same_[i].begin(), same_[i].end(), true) - same_[i].begin());
  }
  return scores;
}

}  // namespace sigmax::apps
