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
struct NamedClassifier {
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
  std::vector<NamedClassifier> contestants{};  ///< if they learn anew in every run
};

/// Who is compared, and a run by its number, which any thread draws.
struct Condition {
  std::vector<NamedClassifier> contestants;
  std::function<Drawn(std::size_t run)> draw;
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
};

/// Draws all runs of all conditions, by threads or ranks, and publishes what the world tells of them.
void run_world(const World& world, const DrawOptions& options, ResultFiles& files);

/// Shares of right decisions after some numbers of reports, the belief in the truth, and each difference from the
/// first.
ResultTable scores_table(const Scores& scores);

/// The table in all its places, with what it cannot say, shares of right decisions over the reports on the page, and
/// curves.csv: report,classifier,accuracy.
void add_scores(Result& result, const Scores& scores);

/// A synthetic world of electronic support measures: platforms carry emitters, a sensor reports which emitter it heard
/// and confuses them. T1{e1,e2}, T2{e2,e3}, T3{e1,e3,e4}, T4{e2,e4,e5}.
struct EsmWorld {
  RandomVariable platform{"platform", {"T1", "T2", "T3", "T4"}};
  RandomVariable emitter{"emitter", {"e1", "e2", "e3", "e4", "e5"}};
  RandomVariable reading{"reading", {"e1", "e2", "e3", "e4", "e5"}};
  std::vector<std::vector<std::size_t>> carried{{0, 1}, {1, 2}, {0, 2, 3}, {1, 3, 4}};

  /// p(emitter|platform) if each of its emitters is used equally often.
  Relation<Random, Random> equal_usage() const;

  /// π(emitter|platform): one for what it carries, `elsewhere` for the others.
  Relation<Fuzzy, Fuzzy> carries(double elsewhere = 0.0) const;

  /// p(reading|emitter): `hit` for the emitter itself, the rest spread evenly.
  Relation<Random, Random> sensor(double hit) const { return symmetric_sensor(reading, emitter, hit, 1.0 - hit); }
};

/// How often a platform uses each of its emitters in a run.
struct Usage {
  enum class Kind {
    equal,      ///< all equally often
    dirichlet,  ///< shares drawn from Dirichlet(parameter)
    dominant    ///< one of them, drawn, has the share `parameter`, the others the rest in equal parts
  };
  Kind kind = Kind::equal;
  double parameter = 0.0;
};

/// What really happens in a run; the classifiers need not know it.
struct EsmTruth {
  Usage usage{};
  double hit = 0.7;       ///< p(reading = emitter) of every sensor
  double unlisted = 0.0;  ///< probability that a report comes from an emitter that the platform does not carry
  /// Probability that in this run a second sensor hears another platform's emitter all the time.
  double astray = 0.0;
  std::size_t sensors = 1;
};

/// How often the platform uses each emitter, drawn.
std::vector<double> draw_usage(const EsmWorld& world, std::size_t platform, const Usage& usage, RandomStream& random);

/// A platform, its usage and its reports, drawn: a reading of each sensor.
Drawn draw_run(const EsmWorld& world, const EsmTruth& truth, std::size_t reports, RandomStream& random);

/// A classifier by what platforms use or carry and how a sensor reads it, or several alike: sigma inference, (41)–(43),
/// if all is random, max inference, (44)–(46), if all is fuzzy; sigma-max inference, (17) without β and (19), if a
/// random sensor reads what platforms may carry, and max-sigma inference, (18) without β and (20), the other way round.
template <Uncertainty Kind, Uncertainty Reading>
NamedClassifier read_by(std::string name, const Relation<Kind, Kind>& emitter_given_platform,
                        const Relation<Reading, Kind>& sensor, std::size_t sensors = 1) {
  const std::vector features(sensors, FeatureModel<Kind, Kind>{emitter_given_platform, sensor});
  return {std::move(name), Classifier<Kind, Kind>{uninformative(emitter_given_platform.from()), features}, std::nullopt,
          std::is_same_v<Kind, Fuzzy> || std::is_same_v<Reading, Fuzzy>};
}

/// Sigma inference that knows how usages are drawn and averages over them: its patterns are usages, a grid of equal
/// probability for Dirichlet(α). The reference: nothing can be better but by what the grid leaves out.
NamedClassifier usage_aware(const EsmWorld& world, const Usage& usage, const Relation<Random, Random>& sensor);

/// The names of the regimes: ways in which beliefs about the emitter world are wrong.
std::vector<std::string> regime_names();

/// Who does better in a regime, or in all of them: a table for each, and a verdict.
void run_regimes(const std::string& name_or_all, std::size_t reports, const DrawOptions& draws);

}  // namespace sigmax::apps
