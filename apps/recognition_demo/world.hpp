#pragma once

#include "recognition_demo/contest.hpp"
#include "shell/random.hpp"

namespace sigmax::apps {

/// One of `size` outcomes, all equally probable.
std::size_t draw_index(RandomStream& random, std::size_t size);

/// An outcome with these probabilities; they may miss a sum of one by rounding.
std::size_t draw(RandomStream& random, std::span<const double> probabilities);

/// The options of worlds, which are drawn at random.
struct DrawOptions {
  std::size_t runs;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
  OutputOptions output;
};
void add_draws(Subcommand app, DrawOptions& options, const std::string& command, std::size_t runs);

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

/// A run, and what each contestant made of it.
struct SeenRun {
  std::size_t condition, run;
  std::size_t truth;
  std::vector<Trace> traces;
};

/// What all runs together say of one contestant.
struct Score {
  std::string name;
  bool fuzzy = false;
  bool has_possibilities = false;
  std::vector<double> accuracy{};   ///< mean credit after 1, 2, … reports
  RunningMean minus_first{};        ///< credit after the last report, less that of the first contestant, by run
  double belief_in_truth = 0.0;     ///< mean probability or possibility of the truth after the last report
  double necessity_of_truth = 0.0;  ///< mean of 1 − the greatest possibility of another pattern; fuzzy only
  double ties = 0.0;                ///< share of the runs that end in a tie for the most likely
  std::size_t refused = 0;          ///< reports that were passed over
  std::size_t same_as = 0;          ///< the first contestant with the same credit at the end of every run
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
  /// How the page shows a run, if it shows any, and how many of each condition. Before them comes a view of all runs,
  /// to which `tell` adds its panels.
  std::function<View(const SeenRun& run)> view{};
  std::size_t runs_in_page = 0;
};

/// Draws all runs of all conditions, by threads or ranks, and publishes what the world tells of them.
void run_world(const World& world, const DrawOptions& options, ResultFiles& files);

/// Shares of right decisions after some numbers of reports, the belief in the truth, and each difference from the
/// first.
ResultTable scores_table(const Scores& scores, const std::string& what_is_counted = "reports");

/// The table in all its places, with what it cannot say, and curves.csv: report,classifier,accuracy.
void add_scores(Result& result, const Scores& scores, const std::string& what_is_counted = "reports");

/// Shares of right decisions over the reports, one curve a contestant.
LineChart accuracy_chart(const Scores& scores, const std::string& what_is_counted = "reports");

/// The columns of a file of beliefs at the end of runs, after others, and their cells.
std::vector<std::string> with_beliefs(std::vector<std::string> keys, const std::vector<Contestant>& contestants,
                                      const std::vector<std::string>& patterns);
std::vector<Cell> with_beliefs(std::vector<Cell> cells, const SeenRun& run);

}  // namespace sigmax::apps
