#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/core/relation.hpp>

#include "recognition_demo/contest.hpp"
#include "support/random.hpp"

namespace sigmax::apps {

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
  Relation<Random, Random> sensor(double hit) const;
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

struct EsmRun {
  std::size_t platform = 0;
  std::vector<Readings> reports;  ///< a reading of each sensor
};

/// p(emitter) of a platform that uses its emitters, in their order, with these shares.
std::vector<double> spread_over_emitters(const EsmWorld& world, std::size_t platform,
                                         const std::vector<double>& shares);

/// Shares of `size` emitters of which one dominates.
std::vector<double> dominant_shares(std::size_t size, std::size_t dominant, double share);

/// How often the platform uses each emitter, drawn.
std::vector<double> draw_usage(const EsmWorld& world, std::size_t platform, const Usage& usage, RandomStream& random);

/// A platform, its usage and its reports, drawn.
EsmRun draw_run(const EsmWorld& world, const EsmTruth& truth, std::size_t reports, RandomStream& random);

}  // namespace sigmax::apps
