#include "recognition_demo/world.hpp"

#include <boost/math/distributions/beta.hpp>

#include <sigmax/core/transform.hpp>

namespace sigmax::apps {
namespace {

/// The logarithm of a draw from the gamma density of unit scale: Marsaglia and Tsang (2000). A shape below one is
/// raised by one and the draw shrunk by u^(1/shape), which underflows where its logarithm does not.
double draw_log_gamma(RandomStream& random, double shape) {
  if (shape < 1.0) {
    const double log_u = std::log(random.uniform());
    return draw_log_gamma(random, shape + 1.0) + log_u / shape;
  }
  const double d = shape - 1.0 / 3.0;
  const double c = 1.0 / std::sqrt(9.0 * d);
  for (;;) {
    const double x = random.normal();
    const double u = random.uniform();
    const double root = 1.0 + c * x;
    if (root <= 0.0) continue;
    const double v = root * root * root;
    if (std::log(u) < 0.5 * x * x + d - d * v + d * std::log(v)) return std::log(d * v);
  }
}

/// Shares of one, from the symmetric Dirichlet density with parameter `alpha` > 0.
std::vector<double> draw_dirichlet(RandomStream& random, std::size_t size, double alpha) {
  std::vector<double> shares(size);
  for (double& share : shares) share = draw_log_gamma(random, alpha);
  const double greatest = *std::ranges::max_element(shares);
  double sum = 0.0;
  for (double& share : shares) sum += share = std::exp(share - greatest);
  for (double& share : shares) share /= sum;
  return shares;
}

/// p(emitter) of a platform that uses its emitters, in their order, with these shares.
std::vector<double> spread_over_emitters(const EsmWorld& world, std::size_t platform,
                                         const std::vector<double>& shares) {
  std::vector<double> probabilities(world.emitter.size(), 0.0);
  for (std::size_t i = 0; i < shares.size(); ++i) probabilities[world.carried[platform][i]] = shares[i];
  return probabilities;
}

/// Shares of `size` emitters on a grid of equal probability under Dirichlet(α): sticks are broken at the quantiles.
std::vector<std::vector<double>> dirichlet_grid(std::size_t size, double alpha) {
  if (size == 1) return {{1.0}};
  const std::size_t nodes = size == 2 ? 32 : 16;
  const boost::math::beta_distribution<double> first(alpha, alpha * static_cast<double>(size - 1));
  std::vector<std::vector<double>> grid;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double share = boost::math::quantile(first, (static_cast<double>(i) + 0.5) / static_cast<double>(nodes));
    for (const auto& rest : dirichlet_grid(size - 1, alpha)) {
      auto& shares = grid.emplace_back(1, share);
      for (const double part : rest) shares.push_back((1.0 - share) * part);
    }
  }
  return grid;
}

/// All shares that a usage can take, equally probable.
std::vector<std::vector<double>> usage_grid(std::size_t size, const Usage& usage) {
  if (usage.kind == Usage::Kind::dirichlet) return dirichlet_grid(size, usage.parameter);
  if (usage.kind == Usage::Kind::equal) return {std::vector<double>(size, 1.0 / static_cast<double>(size))};
  std::vector grid(size, std::vector<double>(size, (1.0 - usage.parameter) / static_cast<double>(size - 1)));
  for (std::size_t i = 0; i < size; ++i) grid[i][i] = usage.parameter;
  return grid;
}

}  // namespace

Relation<Random, Random> EsmWorld::equal_usage() const {
  return {emitter, platform, each_below(platform.size(), [&](std::size_t c) {
            return spread_over_emitters(*this, c, usage_grid(carried[c].size(), {}).front());
          })};
}

Relation<Fuzzy, Fuzzy> EsmWorld::carries(double elsewhere) const {
  std::vector<std::vector<double>> rows(platform.size(), std::vector<double>(emitter.size(), elsewhere));
  for (std::size_t c = 0; c < rows.size(); ++c)
    for (const std::size_t f : carried[c]) rows[c][f] = 1.0;
  return {as_fuzzy(emitter), as_fuzzy(platform), rows};
}

std::vector<double> draw_usage(const EsmWorld& world, std::size_t platform, const Usage& usage, RandomStream& random) {
  const std::size_t size = world.carried[platform].size();
  if (usage.kind == Usage::Kind::dirichlet)
    return spread_over_emitters(world, platform, draw_dirichlet(random, size, usage.parameter));
  const auto grid = usage_grid(size, usage);
  return spread_over_emitters(world, platform, grid[grid.size() == 1 ? 0 : random.index(grid.size())]);
}

Drawn draw_run(const EsmWorld& world, const EsmTruth& truth, std::size_t reports, RandomStream& random) {
  const auto sensor = world.sensor(truth.hit);
  const std::size_t platform = random.index(world.platform.size());
  std::vector<double> usage = draw_usage(world, platform, truth.usage, random);
  if (truth.unlisted > 0.0) {
    const auto& carried = world.carried[platform];
    const double each = truth.unlisted / static_cast<double>(usage.size() - carried.size());
    for (std::size_t f = 0; f < usage.size(); ++f)
      usage[f] = std::ranges::find(carried, f) == carried.end() ? each : (1.0 - truth.unlisted) * usage[f];
  }
  // A sensor that goes astray listens to another platform for the whole run.
  std::vector<double> heard_astray;
  if (truth.astray > 0.0 && random.uniform() < truth.astray) {
    const std::size_t step = 1 + random.index(world.platform.size() - 1);
    heard_astray = draw_usage(world, (platform + step) % world.platform.size(), truth.usage, random);
  }
  Drawn run{platform, {}};
  for (std::size_t k = 0; k < reports; ++k) {
    Readings report;
    for (std::size_t s = 0; s < truth.sensors; ++s) {
      const bool astray = s > 0 && !heard_astray.empty();
      const std::size_t emitter = random.draw(astray ? heard_astray : usage);
      report.push_back(random.draw(sensor.row(emitter)));
    }
    run.reports.push_back(std::move(report));
  }
  return run;
}

NamedClassifier usage_aware(const EsmWorld& world, const Usage& usage, const Relation<Random, Random>& sensor) {
  std::vector<std::vector<double>> usages, platforms;
  std::vector<double> prior;
  for (std::size_t c = 0; c < world.platform.size(); ++c) {
    const auto grid = usage_grid(world.carried[c].size(), usage);
    for (const auto& shares : grid) {
      usages.push_back(spread_over_emitters(world, c, shares));
      platforms.emplace_back(world.platform.size(), 0.0)[c] = 1.0;
      prior.push_back(1.0 / static_cast<double>(grid.size() * world.platform.size()));
    }
  }
  const RandomVariable variable{"usage", usages.size()};
  const std::vector features{FeatureModel<Random, Random>{{world.emitter, variable, usages}, sensor}};
  return {"sigma, averages over usages", Classifier{normalized(variable, prior), features},
          Relation<Random, Random>{world.platform, variable, platforms}, false};
}

namespace {

constexpr double sensor_hit = 0.7;

struct EsmOptions {
  std::optional<double> alpha;  ///< usage is drawn by the Dirichlet density, else equal
  std::string regime;           ///< the name of one, or all; else none
  std::size_t reports = 40;
  DrawOptions draws;
};

Usage usage_of(const EsmOptions& options) {
  return options.alpha ? Usage{Usage::Kind::dirichlet, *options.alpha} : Usage{};
}

std::vector<NamedClassifier> contestants(const EsmWorld& world, const EsmOptions& options) {
  const auto sensor = world.sensor(sensor_hit);
  const auto ratio = to_possibility(sensor, RatioScale{}), dubois_prade = to_possibility(sensor, DuboisPrade{});
  const auto usage = world.equal_usage();
  const auto carries = world.carries();
  std::vector<NamedClassifier> all = {
      read_by("sigma", usage, sensor),
      read_by("max, ratio scale", carries, with_fuzzy_condition(ratio)),
      read_by("max, Dubois-Prade", carries, with_fuzzy_condition(dubois_prade)),
      read_by("sigma-max", carries, with_fuzzy_condition(sensor)),
      read_by("max-sigma, ratio scale", usage, ratio),
      read_by("max-sigma, Dubois-Prade", usage, dubois_prade),
  };
  if (options.alpha) all.push_back(usage_aware(world, usage_of(options), sensor));
  return all;
}

std::string described_usage(const EsmOptions& options) {
  if (!options.alpha) return "equal for all emitters of a platform, as the classifiers assume";
  return fmt::format("Dirichlet({}) over the emitters of a platform, drawn for each run, unknown to the classifiers",
                     *options.alpha);
}

void tell(const EsmOptions& options, const Scores& scores, Result& result) {
  const DrawOptions& draws = options.draws;
  result.say(
      "Synthetic emitter world, not recorded data: 4 platforms carry 2 or 3 of 5 emitters, a sensor reports the true "
      "emitter with probability {}, each other with {:.3g}\nUsage: {}\n{} runs of {} reports, seed {}",
      sensor_hit, (1.0 - sensor_hit) / 4.0, described_usage(options), draws.runs, options.reports, draws.seed);
  result.facts("synthetic", true, "usage", options.alpha ? "dirichlet" : "uniform");
  if (options.alpha) result.fact({"alpha"}, *options.alpha);
  result.facts("probability_of_a_right_reading", sensor_hit, "runs", draws.runs, "reports", options.reports, "seed",
               draws.seed);
  result.page.verdict = {fmt::format("{} runs of {} reports, seed {}; usage: {}.", draws.runs, options.reports,
                                     draws.seed, described_usage(options))};
  add_scores(result, scores);
}

void run_esm(const EsmOptions& options) {
  const EsmWorld esm;
  const auto drawn = [&](std::size_t run) {
    RandomStream random(options.draws.seed, run);
    return draw_run(esm, {.usage = usage_of(options), .hit = sensor_hit}, options.reports, random);
  };
  World world{"Which platform is it?", {{contestants(esm, options), drawn}}};
  ResultFiles files(options.draws.output);
  world.tell = [&](const std::vector<Scores>& scores, Result& result) { tell(options, scores.front(), result); };
  run_world(world, options.draws, files);
}

}  // namespace

void add_esm(CLI::App& program, const std::string& command) {
  const auto options = std::make_shared<EsmOptions>();
  Subcommand app(program, "esm", "Which platform is it? A synthetic world of emitters, all classifiers.");
  const Option alpha = app.option("--alpha", options->alpha,
                                  "Usage of the emitters is drawn for each run by the Dirichlet density with this "
                                  "parameter, else equal; the smaller, the less equal")
                           .number_in(0.01, 1000.0);
  auto regimes = regime_names();
  regimes.emplace_back("all");
  const Option regime = app.option("--regime", options->regime,
                                   fmt::format("Where is max inference the better one? Beliefs that are wrong in one "
                                               "way, or in all: {}",
                                               fmt::join(regimes, ", ")))
                            .one_of(regimes)
                            .text("NAME");
  app.option("--reports", options->reports, "Reports in a run").in(1, 100000);
  app.option("--runs", options->draws.runs, "Simulated runs").in(2, 100000000);
  add_seed(app, options->draws.seed);
  add_threads(app, options->draws.threads);
  add_results(app, options->draws.output, command);
  app.run([options, alpha, regime] {
    if (regime.given() && alpha.given()) throw UsageError("--regime has usages of its own: leave out --alpha");
    if (regime.given())
      run_regimes(options->regime, options->reports, options->draws);
    else
      run_esm(*options);
  });
}

}  // namespace sigmax::apps
