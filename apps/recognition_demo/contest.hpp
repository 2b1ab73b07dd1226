#pragma once

#include <cstddef>
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
  bool has_possibilities = true;  ///< anywhere: of the pattern, of the feature, or of the reading
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

/// Probability or possibility of every pattern after each report.
using Beliefs = std::vector<std::vector<double>>;
Beliefs beliefs_over(const Contestant& contestant, const std::vector<Readings>& reports);
Beliefs beliefs_over(const Contestant& contestant, const std::vector<GradedReport>& reports);

/// What all runs together say of one contestant.
struct Score {
  std::string name;
  bool fuzzy = false;
  bool has_possibilities = false;
  std::vector<double> accuracy{};   ///< mean credit after 1, 2, … reports
  RunningMean minus_first{};        ///< credit after the last report, less that of the first contestant, by run
  double belief_in_truth = 0.0;     ///< mean probability or possibility of the truth after the last report
  double necessity_of_truth = 0.0;  ///< mean of 1 − the greatest possibility of another pattern; fuzzy only
  double ties = 0.0;                ///< share of the runs that end in a tie that includes the truth
  std::size_t refused = 0;          ///< reports that were passed over
  std::size_t same_as = 0;          ///< the first contestant with the same credit at the end of every run
};

/// The traces of one run, one a contestant in their order, and its truth.
struct RunTraces {
  std::size_t truth = 0;
  std::vector<Trace> traces;
};

/// Follows the same reports by every contestant.
template <class Reports>
RunTraces follow_all(const std::vector<Contestant>& contestants, std::size_t truth, const Reports& reports) {
  RunTraces result{truth, {}};
  for (const Contestant& contestant : contestants) result.traces.push_back(follow(contestant, truth, reports));
  return result;
}

/// Adds up runs in their order; their number is all that it keeps of them.
class Scoreboard {
 public:
  explicit Scoreboard(const std::vector<Contestant>& contestants);

  void add(const RunTraces& run);

  /// Of the runs so far.
  std::vector<Score> scores() const;

 private:
  std::vector<Score> sums_;
  std::vector<std::vector<bool>> same_;  // by contestant, then by one before it
  std::size_t runs_ = 0;
};

}  // namespace sigmax::apps
