#pragma once

#include "recognition_demo/learning.hpp"
#include "shell/random.hpp"

namespace sigmax::apps {

/// The options of worlds, which are drawn at random.
struct DrawOptions {
  std::size_t runs = 20000;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  OutputOptions output;
};

/// One of the classifiers that are compared on the same reports.
struct Contestant {
  std::string name;
  AnyClassifier classifier;
  /// For a sigma classifier of something finer than the pattern: the pattern of each of its outcomes.
  std::optional<Relation<Random, Random>> pattern_given_state = std::nullopt;
  bool has_possibilities = true;  ///< anywhere: of the pattern, of the feature, or of the reading
};

/// One run: the true pattern, and the reports about it.
struct Drawn {
  std::size_t truth;
  std::vector<Readings> reports;
  std::vector<Contestant> contestants{};  ///< if they learn anew in every run
};

/// Who is compared, and a run by its number, which any thread draws.
struct Condition {
  std::vector<Contestant> contestants;
  std::function<Drawn(std::size_t run)> draw;
};

/// What a contestant made of one run.
struct Trace {
  /// After each report: 1 if the truth alone is the most likely pattern, 1/n if it is one of n, else 0.
  std::vector<double> credit;
  /// Probability or possibility of every pattern after the last report.
  std::vector<double> belief;
  /// Reports that would have excluded every pattern; the classifier passed over them.
  std::size_t refused = 0;
};

/// A run, and what each contestant made of it.
struct SeenRun {
  std::size_t condition, run;
  std::size_t truth;
  std::vector<Trace> traces;
};

/// What all runs together say of one contestant.
struct Score {
  std::string name;
  bool fuzzy, has_possibilities;
  std::vector<RunningMean> right{};  ///< credit after 1, 2, … reports
  RunningMean minus_first{};         ///< credit after the last report, less that of the first contestant, by run
  RunningMean belief_in_truth{};     ///< probability or possibility of the truth after the last report
  RunningMean necessity_of_truth{};  ///< 1 − the greatest possibility of another pattern
  RunningMean ties{};                ///< whether the run ends in a tie for the most likely
  std::size_t refused = 0;           ///< reports that were passed over

  double accuracy() const { return right.back().mean(); }
};
using Scores = std::vector<Score>;

/// A world that is simulated: what differs from one to the next.
///
///     World world{.title = "Which coin is it?", .conditions = {{contestants, draw}}};
///     world.tell = [&](const std::vector<Scores>& scores, Result& result) { add_scores(result, scores.front()); };
///     run_world(world, options, files);
struct World {
  std::string title;
  std::vector<Condition> conditions;
  std::function<void(const std::vector<Scores>& scores, Result& result)> tell{};  ///< the scores of each condition
  std::function<void(const SeenRun& run)> see{};                                  ///< every run, in order, if wanted
};

/// Draws all runs of all conditions, by threads or ranks, and publishes what the world tells of them.
void run_world(const World& world, const DrawOptions& options, ResultFiles& files);

/// Shares of right decisions after some numbers of reports, the belief in the truth, and each difference from the
/// first.
ResultTable scores_table(const Scores& scores);

/// The table in all its places, with what it cannot say, shares of right decisions over the reports on the page, and
/// curves.csv: report,classifier,accuracy.
void add_scores(Result& result, const Scores& scores);

}  // namespace sigmax::apps
