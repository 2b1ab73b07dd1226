#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <sigmax/core/distribution.hpp>
#include <sigmax/recognition/classifier.hpp>
#include <sigmax/recognition/evaluation.hpp>

namespace sigmax::apps {

using SigmaClassifier = Classifier<Random, Random>;
using MaxClassifier = Classifier<Fuzzy, Fuzzy>;

/// A report: for every feature the index of what was read, or `missing`.
using Readings = std::vector<std::size_t>;

/// One of the classifiers that are compared on the same reports.
struct Contestant {
  std::string name;
  std::variant<SigmaClassifier, MaxClassifier> classifier;
  /// For a sigma classifier of something finer than the pattern: the pattern of each of its outcomes.
  std::optional<Relation<Random, Random>> pattern_given_state = std::nullopt;
};

/// What a classifier made of one run.
struct Trace {
  /// After each report: 1 if the truth alone is the most likely pattern, 1/n if it is one of n, else 0.
  std::vector<double> credit;
  /// Probability or possibility of every pattern after the last report.
  std::vector<double> belief;
  /// Reports that would have excluded every pattern; the classifier passed over them.
  std::size_t refused = 0;
};

/// 1 if the greatest value is that of `truth` alone, 1/n if n values tie, else 0; ties as `decide` has them.
double credit_of(std::span<const double> logs, std::size_t truth);

/// A graded report about the only feature: log-likelihoods of its values.
using GradedReport = std::vector<double>;

/// The contestant's classifier, from its prior on, over the reports of one run.
Trace follow(const Contestant& contestant, std::size_t truth, const std::vector<Readings>& reports);
Trace follow(const Contestant& contestant, std::size_t truth, const std::vector<GradedReport>& reports);

/// What all runs together say of one contestant.
struct Score {
  std::string name;
  bool fuzzy = false;
  std::vector<double> accuracy;       ///< mean credit after 1, 2, … reports
  std::vector<double> final_credits;  ///< of every run, after its last report
  double belief_in_truth = 0.0;       ///< mean probability or possibility of the truth after the last report
  double necessity_of_truth = 0.0;    ///< mean of 1 − the greatest possibility of another pattern; fuzzy only
  double ties = 0.0;                  ///< share of the runs that end in a tie that includes the truth
  std::size_t refused = 0;
};

/// The traces of one run, one a contestant in their order, and its truth.
struct RunTraces {
  std::size_t truth = 0;
  std::vector<Trace> traces;
};

/// Scores of the contestants over runs 0 … runs − 1; `trace(run)` may be called by any thread, `see(run, traces)` is
/// called by one, in the order of the runs.
std::vector<Score> score(const std::vector<Contestant>& contestants, std::size_t runs, int threads,
                         const std::function<RunTraces(std::size_t run)>& trace,
                         const std::function<void(std::size_t run, const RunTraces& traces)>& see);

/// Difference of the accuracies after the last report, a − b, paired by run.
Interval paired_difference(const Score& a, const Score& b);

/// "+1.25 ± 0.40", in percentage points.
std::string points(const Interval& difference);

/// A share as "97.5", in per cent.
std::string percent(double share);

}  // namespace sigmax::apps
